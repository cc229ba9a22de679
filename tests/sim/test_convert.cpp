// CSV and merged VTKHDF from a run's folder.

#include "sim/base/error.h"
#include "sim/io/table_export.h"
#include "sim/run/run.h"
#include "tests/sim/ballistic_scene.h"
#include "tests/sim/fake_solver.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace sandglass;
using namespace sandglass::test;
using Catch::Contains;

namespace {

/// A run of several segments: one a checkpoint.
std::unique_ptr<FrameSource> smallRun(const std::filesystem::path& folder) {
  RunOptions options;
  options.folder = folder;
  options.solverFactory = [](const Scene& scene, const SolverOptions&) {
    return std::make_unique<FakeSolver>(scene, 1e-3);
  };
  Run(ballisticScene(), options).execute();
  return openFrames(folder);
}

} // namespace

TEST_CASE("Merging segments keeps every frame bit for bit", "[io]") {
  const TemporaryFolder folder("merge");
  const auto run = smallRun(folder / "r");
  REQUIRE(run->size() == 15);
  const Scene scene = ballisticScene();
  exportVtkhdf(*run, writeScene(scene), false, folder / "all.vtkhdf");
  const auto merged = openFrames(folder / "all.vtkhdf");
  REQUIRE(merged->size() == 15);
  for (std::size_t i = 0; i < run->size(); ++i)
    requireEqual(*merged->load(i), *run->load(i));
}

TEST_CASE("CSV: the numbers of a frame, read back to the same bits", "[io]") {
  const TemporaryFolder folder("csv");
  const auto run = smallRun(folder / "r");
  const FramePtr frame = run->load(3);
  exportCsv(*run, 3, 4, folder / "f.csv");
  std::ifstream in(folder / "f.csv");
  std::string line;
  while (std::getline(in, line) && line.starts_with("# ")) {
  }
  CHECK(line == "time,step,id,x,y,z,radius,velocity.x,velocity.y,velocity.z");
  for (std::size_t i = 0; i < frame->size(); ++i) {
    REQUIRE(std::getline(in, line));
    std::vector<double> cells;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');)
      cells.push_back(std::stod(word));
    const Vec3 &x = frame->position[i], &v = frame->vector(quantity::velocity)[i];
    REQUIRE(cells == std::vector<double>{frame->time, static_cast<double>(frame->step),
                                         static_cast<double>(frame->id[i]), x[0], x[1], x[2],
                                         frame->scalar(quantity::radius)[i], v[0], v[1], v[2]});
  }
  CHECK_FALSE(std::getline(in, line));
}

TEST_CASE("Opening what is not a run says what is wrong", "[io]") {
  const TemporaryFolder folder("open");
  std::ofstream(folder / "notes.txt") << "hello";
  CHECK_THROWS_WITH(openFrames(folder / "absent"), Contains("there is no such file or folder"));
  CHECK_THROWS_WITH(openFrames(folder.path()), Contains("has no frames/"));
  CHECK_THROWS_WITH(openFrames(folder / "notes.txt"), Contains("notes.txt: byte 0: found"));
  const auto run = smallRun(folder / "r");
  CHECK_THROWS_WITH(run->load(15), Contains("frame 15 was asked for and there are 15"));
  std::filesystem::create_directories(folder / "empty" / "frames");
  CHECK(openFrames(folder / "empty")->size() == 0);
}

TEST_CASE("A source finds the frames that a run going on has written since", "[io]") {
  const TemporaryFolder folder("refresh");
  const auto whole = smallRun(folder / "r");
  const auto moved = folder / "later.vtkhdf";
  std::filesystem::path final;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "r" / "frames"))
    if (final.empty() || entry.path().filename() > final.filename()) final = entry.path();
  std::filesystem::rename(final, moved);
  const auto source = openFrames(folder / "r");
  const std::size_t before = source->size();
  REQUIRE(before < 15);
  CHECK_FALSE(source->refresh());
  std::filesystem::rename(moved, final);
  CHECK(source->refresh());
  REQUIRE(source->size() == 15);
  requireEqual(*source->load(14), *whole->load(14));
}
