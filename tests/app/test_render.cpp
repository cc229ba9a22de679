// sandglass render from a run on the disk, with no display: files, texts, choices, comparison, refusals.

#include "sim/io/run_folder.h"
#include "tests/app/program.h"
#include "tests/sim/temporary_folder.h"
#include "vis/renderer.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sys/wait.h>

using namespace sandglass;
using namespace sandglass::test;

namespace fs = std::filesystem;

namespace {

/// The two colliding grains of sample_runs, 3 ms in 61 frames.
const fs::path& run() {
  static const TemporaryFolder folder("render-run");
  static const fs::path path = [] {
    const Result made = program("run " SANDGLASS_SOURCE_DIR "/sample_runs/two_grains/scene.toml -o " +
                                (folder / "run").string());
    INFO(made.text);
    REQUIRE(made.code == 0);
    return folder / "run";
  }();
  return path;
}

std::string on(const std::string& options) {
  return "render " + run().string() + " --size 160x90 " + options;
}

std::size_t count(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

} // namespace

TEST_CASE("render writes one picture a frame, each knowing where it comes from") {
  const TemporaryFolder folder("render-all");
  const auto frames = openFrames(run());
  const Result drawn = program(on("--every 10 -o " + (folder / "out").string()));
  INFO(drawn.text);
  REQUIRE(drawn.code == 0);
  CHECK(count(folder / "out") == (frames->size() + 9) / 10);
  std::map<std::string, std::string> text;
  const vis::Image image = vis::readPng(folder / "out/frame_00020.png", &text);
  CHECK(image.width == 160);
  CHECK(image.height == 90);
  CHECK(text["source"] == run().string());
  CHECK(text["frame"] == "20");
  CHECK(std::stod(text["time"]) == frames->time(20));
  CHECK(text["scene"] == frames->load(20)->provenance.at("scene"));
  // The view in the picture draws the picture again.
  const vis::View view = vis::parseView(text["view"], "picture");
  CHECK(vis::Renderer().draw(*frames->load(20), view).rgba == image.rgba);
}

TEST_CASE("render draws the frames that are asked for") {
  const TemporaryFolder folder("render-choice");
  const auto drawn = [&](const std::string& options) {
    fs::remove_all(folder / "out");
    const Result result = program(on(options + " -o " + (folder / "out").string()));
    INFO(result.text);
    REQUIRE(result.code == 0);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "out"))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  };
  CHECK(drawn("--frames 3:5") ==
        std::vector<std::string>{"frame_00003.png", "frame_00004.png", "frame_00005.png"});
  CHECK(drawn("--frames 7") == std::vector<std::string>{"frame_00007.png"});
  CHECK(drawn("--frames :6 --every 3") ==
        std::vector<std::string>{"frame_00000.png", "frame_00003.png", "frame_00006.png"});
  CHECK(drawn("--at 0.00101") == std::vector<std::string>{"frame_00020.png"}); // 50 us a frame
}

TEST_CASE("both back ends write the same picture") {
  const TemporaryFolder folder("render-gl");
  REQUIRE(program(on("--frames 9 --gl osmesa -o " + (folder / "a").string())).code == 0);
  REQUIRE(program(on("--frames 9 --gl egl -o " + (folder / "b").string())).code == 0);
  CHECK(vis::readPng(folder / "a/frame_00009.png").rgba == vis::readPng(folder / "b/frame_00009.png").rgba);
}

TEST_CASE("render compares with a reference: 0 when alike, else 1 and a picture of the difference") {
  const TemporaryFolder folder("render-reference");
  REQUIRE(program(on("--frames 30 -o " + folder.path().string())).code == 0);
  const std::string reference = " --reference " + (folder / "frame_00030.png").string();
  const Result same = program(on("--frames 30" + reference));
  CHECK(same.code == 0);
  CHECK_THAT(same.text, Catch::Contains("0.0000 % of the pixels differ"));
  const Result other = program(on("--frames 30 --colour none -o " + (folder / "other").string() + reference));
  CHECK(other.code == 1);
  CHECK_THAT(other.text, Catch::Contains("difference.png"));
  CHECK(fs::exists(folder / "other/difference.png"));
  CHECK(program(on("--frames 30 --colour none --threshold 1 -o " + (folder / "other").string() + reference))
            .code == 0);
  CHECK(program(on("--frames 3:4" + reference)).code == 2);
}

TEST_CASE("render makes a film with all its frames") {
  const TemporaryFolder folder("render-film");
  const std::string film = (folder / "film.mp4").string();
  const Result made = program(on("--frames 0:14 --movie " + film));
  INFO(made.text);
  REQUIRE(made.code == 0);
  std::FILE* pipe = ::popen(
      ("ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 " + film).c_str(),
      "r");
  int frames = 0;
  REQUIRE(std::fscanf(pipe, "%d", &frames) == 1);
  ::pclose(pipe);
  CHECK(frames == 15);
}

TEST_CASE("what render cannot do is a sentence and exit code 2") {
  const TemporaryFolder folder("render-refusals");
  std::ofstream(folder / "view.toml") << "[camera]\npreset = \"side\"\nzoom = 2\n";
  struct Refusal {
    std::string options, sentence;
  };
  const Refusal refusals[] = {
      {"", "nothing to write"},
      {"-o OUT --clip 'q<3'", "--clip q<3: this is no clip plane"},
      {"-o OUT --clip 'x>3 kg'", "this is no clip plane"},
      {"-o OUT --camera side", "camera.preset is 'side'; it must be one of"},
      {"-o OUT --map jet", "colouring.map is 'jet'; it must be one of"},
      {"-o OUT --range 2:1", "--range 2:1: write frame, run, or LOW:HIGH"},
      {"-o OUT --size 12", "--size 12: write WIDTHxHEIGHT"},
      {"-o OUT --size 12x99999", "it must be a whole number from 16 to 16384"},
      {"-o OUT --frames 1000:", "has the frames 0 to 60"},
      {"-o OUT --frames a:b", "--frames a:b: write A:B"},
      {"-o OUT --colour charge", "there is no quantity 'charge'"},
      {"-o OUT --view none.toml", "none.toml: the view file cannot be read"},
      {"-o OUT --view VIEW", "view.toml:3: camera.zoom is not a known key"},
      {"-o OUT --reference none.png --at 0", "none.png: the picture cannot be read"},
  };
  for (const auto& [options, sentence] : refusals) {
    INFO(options);
    std::string given = options;
    if (const auto at = given.find("OUT"); at != std::string::npos)
      given.replace(at, 3, (folder / "out").string());
    if (const auto at = given.find("VIEW"); at != std::string::npos)
      given.replace(at, 4, (folder / "view.toml").string());
    const Result result = program("render " + run().string() + " " + given);
    CHECK(result.code == 2);
    CHECK_THAT(result.text, Catch::Contains(sentence));
  }
  CHECK(program("render " + (folder / "nothing").string() + " -o x").code == 2);
}
