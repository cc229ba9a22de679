// A run killed at any moment loses the time since its last checkpoint and nothing else: kill -9 a hundred
// times at random moments, each time everything that is closed opens, and the resumed run ends with the bits
// of one that nobody disturbed. Moments are counted in checkpoints, not in seconds, so that they lie all over
// the run on a machine of any speed and load.

#include "sim/base/random.h"
#include "sim/io/run_folder.h"
#include "sim/io/series.h"
#include "sim/run/checkpoint_store.h"
#include "tests/app/started_program.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sys/wait.h>
#include <thread>

using namespace sandglass;
using namespace sandglass::test;

namespace fs = std::filesystem;

namespace {

/// Starts `sandglass run` and returns its process id.
pid_t start(const fs::path& scene, const fs::path& folder, int threads) {
  return startProgram(
      {"run", scene.string(), "-o", folder.string(), "--resume", "--threads", std::to_string(threads)});
}

/// Kills it some time after it has written `checkpoints` more.
int killRunAfter(pid_t child, const fs::path& folder, std::size_t checkpoints, double part) {
  const auto newest = [&] {
    const auto files = checkpointFiles(folder);
    return files.empty() ? fs::path() : files.back();
  };
  std::size_t seen = 0;
  fs::path last = newest();
  return killAfter(child, checkpoints, part, std::chrono::microseconds(200), [&] {
    if (const fs::path now = newest(); now != last) ++seen, last = now;
    return seen >= checkpoints;
  });
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<FramePtr> framesOf(const fs::path& folder) {
  std::vector<FramePtr> frames;
  if (!fs::exists(folder / "frames")) return frames;
  const auto source = openFrames(folder);
  for (std::size_t i = 0; i < source->size(); ++i)
    frames.push_back(source->load(i));
  return frames;
}

void requireSame(const std::vector<FramePtr>& whole, const fs::path& folder, const fs::path& wholeFolder) {
  const auto frames = framesOf(folder);
  REQUIRE(frames.size() == whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
    requireEqual(*frames[i], *whole[i]);
  REQUIRE(contentOf(folder / "series.csv") == contentOf(wholeFolder / "series.csv"));
}

} // namespace

TEST_CASE("A run killed at any moment goes on with the same bits", "[app]") {
  const TemporaryFolder folder("kill");
  std::ofstream(folder / "scene.toml") << smallHopper;

  int status = 0;
  waitpid(start(folder / "scene.toml", folder / "whole", 1), &status, 0);
  REQUIRE(status == 0);
  const auto whole = framesOf(folder / "whole");
  REQUIRE(whole.size() == 21);                                // 140 ms each 7 ms, both ends
  REQUIRE(whole.back()->size() < whole.front()->size() + 90); // it rained, and some have left

  int kills = 0, finished = 0, withCheckpoint = 0;
  for (std::uint64_t trial = 0; kills < 100; ++trial) {
    RandomStream random(2024, RandomPurpose::test, trial);
    const pid_t child = start(folder / "scene.toml", folder / "killed", 1 + static_cast<int>(trial % 3));
    status = killRunAfter(child, folder / "killed", static_cast<std::size_t>(random.uniform(0, 6)),
                          random.uniform());
    INFO("trial " << trial);
    std::size_t frames = 0;
    if (fs::exists(folder / "killed" / "frames")) {
      const auto source = openFrames(folder / "killed"); // every closed segment opens
      frames = source->size();
      for (std::size_t i = frames - std::min<std::size_t>(frames, 3); i < frames; ++i)
        requireEqual(*source->load(i), *whole.at(i));
    }
    const auto checkpoints = checkpointFiles(folder / "killed");
    for (const auto& file : checkpoints)
      REQUIRE_FALSE(readCheckpoint(file).empty());
    CHECK((frames <= 1 || !checkpoints.empty())); // the first frame comes before the first checkpoint
    if (fs::exists(folder / "killed" / "series.csv")) readSeries(folder / "killed" / "series.csv");
    if (WIFSIGNALED(status)) {
      ++kills;
      withCheckpoint += checkpoints.empty() ? 0 : 1;
      continue;
    }
    REQUIRE(WEXITSTATUS(status) == 0);
    requireSame(whole, folder / "killed", folder / "whole");
    fs::remove_all(folder / "killed");
    ++finished;
  }
  waitpid(start(folder / "scene.toml", folder / "killed", 2), &status, 0);
  REQUIRE(status == 0);
  requireSame(whole, folder / "killed", folder / "whole");
  CHECK(withCheckpoint > 50); // most kills fell into the run, not into its first moments
  INFO("kills " << kills << ", runs that ended in between " << finished);
  CHECK(finished > 0);
}

TEST_CASE("SIGTERM ends a run with a checkpoint and exit code 1", "[app]") {
  const TemporaryFolder folder("term");
  std::ofstream(folder / "scene.toml") << smallHopper;
  // A run that does not end by itself while the test looks for its checkpoints.
  const pid_t child = startProgram({"run", (folder / "scene.toml").string(), "-o", (folder / "run").string(),
                                    "--threads", "1", "--set", "stage.discharge.until.duration=\"1000 s\""});
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (checkpointFiles(folder / "run").size() < 2 && std::chrono::steady_clock::now() < limit)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 1);
  REQUIRE(checkpointFiles(folder / "run").size() >= 2);
  const auto frames = framesOf(folder / "run");
  REQUIRE(frames.size() >= 2);
  CHECK(frames.back()->time < 1000);
}
