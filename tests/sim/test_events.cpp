// Changes while a run goes on: exact motion, and the same bits when the scene that was kept is run again.

#include "sim/base/error.h"
#include "sim/io/run_folder.h"
#include "sim/run/branch.h"
#include "sim/run/run.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <utility>

using namespace sandglass;
using namespace sandglass::test;

namespace {

const std::vector<std::string> shortStages{"stage.settle.until.duration=\"20 ms\"",
                                           "stage.discharge.until.duration=\"40 ms\"",
                                           "output.frame_interval=\"2 ms\""};

RunOptions into(const std::filesystem::path& folder) {
  RunOptions options;
  options.folder = folder;
  options.threads = 1;
  return options;
}

/// All but the name of the scene, which changed with its first event.
void requireSame(Frame a, Frame b) {
  a.provenance.erase("scene");
  b.provenance.erase("scene");
  requireEqual(a, b);
}

void requireSameFrames(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto first = openFrames(a), second = openFrames(b);
  REQUIRE(first->size() == second->size());
  for (std::size_t k = 0; k < first->size(); ++k)
    requireSame(*first->load(k), *second->load(k));
}

} // namespace

TEST_CASE("A grain whose gravity turns at a step moves on two exact parabolas", "[events]") {
  const Scene scene = parseScene(R"(
gravity = ["0", "0", "-10 m/s^2"]
[domain]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["1 m", "1 m", "1 m"]
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[contact]]
between = ["glass", "glass"]
normal = { law = "linear", collision_time = "5e-4 s", restitution = 0.9 }
[[species]]
name = "bead"
material = "glass"
size = { distribution = "single", diameter = "2 mm" }
[[fill]]
kind = "list"
species = "bead"
grains = [{ position = ["0", "0", "0"], velocity = ["1 m/s", "0", "0"] }]
[[stage]]
name = "fly"
until = { duration = "0.1 s" }
[[event]]
step = 5000
gravity = ["0", "6 m/s^2", "0"]
[accuracy]
time_step = "10 us"
)",
                                 "flight");
  Run run(scene, {});
  FramePtr last;
  run.onSavedFrame = [&](FramePtr frame) { last = std::move(frame); };
  run.execute();
  // The leapfrog is exact under constant acceleration: 0.05 s of each.
  REQUIRE(last->time == Approx(0.1).epsilon(1e-12));
  CHECK(last->position[0].x() == Approx(0.1).epsilon(1e-12));
  CHECK(last->position[0].y() == Approx(0.5 * 6 * 0.05 * 0.05).epsilon(1e-12));
  CHECK(last->position[0].z() == Approx(-0.5 * 10 * 0.05 * 0.05 - 10 * 0.05 * 0.05).epsilon(1e-12));
}

TEST_CASE("A run changed while it went on leaves a scene that gives the same bits again", "[events]") {
  const TemporaryFolder folder("events");
  const Scene scene = parseScene(smallHopper, "small hopper", shortStages);
  int changes = 0;
  {
    Run run(scene, into(folder / "live"));
    int frames = 0;
    run.onSavedFrame =
        [&](FramePtr) { // in the run's thread, between two groups of steps, as a window's would
          switch (++frames) {
          case 4:
            run.change({.gravity = Vec3(0, 2, -7)});
            break;
          case 7:
            run.change({.drag = 5.0, .removeWalls = {"gate"}});
            break;
          case 9:
            run.change({.endStage = true});
            break;
          case 15: // after the frame from which a run branches below
            run.change({.gravity = Vec3(1, 0, 3)});
            break;
          default:
            break;
          }
        };
    run.onChanged = [&](const EventSpec& event) {
      ++changes;
      CHECK(event.step > 0);
    };
    run.execute();
  }
  REQUIRE(changes == 4);
  const Scene kept = readScene((folder / "live" / "scene.toml").string());
  REQUIRE(kept.events.size() == 4);
  REQUIRE(kept.events[0].gravity == Vec3(0, 2, -7));
  REQUIRE(kept.events[2].endStage);
  Run(kept, into(folder / "again")).execute();
  requireSameFrames(folder / "live", folder / "again");

  SECTION("and stopped at many places as well") {
    auto parts = into(folder / "parts");
    parts.resume = true;
    int stops = 0;
    for (;; ++stops) {
      REQUIRE(stops < 100);
      Run part(kept, parts);
      int samples = 0;
      part.onSample = [&](const ProbeSample&) {
        if (++samples == 5 + stops % 4) part.stop();
      };
      if (part.execute() == RunOutcome::finished) break;
    }
    CHECK(stops > 3);
    requireSameFrames(folder / "live", folder / "parts");
  }
  SECTION("and branches that change nothing go the same way") {
    const auto original = openFrames(folder / "live");
    const FramePtr frame = original->load(10);
    const Branch branch = branchRun(folder / "live", frame->step, folder / "branch");
    REQUIRE(branch.step == frame->step);
    for (const auto& event : branch.scene.events)
      CHECK(event.step < frame->step);
    auto options = into(folder / "branch");
    options.resume = true;
    options.pauseAt = branch.step;
    options.liveInterval = 1e-9;
    Run run(branch.scene, options);
    bool reached = false;
    run.onLiveFrame = [&](FramePtr now) {
      if (now->step != branch.step) return;
      run.pause(false); // the frame is offered as the step is reached, and again once the run has paused
      if (std::exchange(reached, true)) return;
      // Paused there, before the later changes, which are made again by hand.
      for (const auto& event : kept.events)
        if (event.step == branch.step) run.change(event);
    };
    run.execute();
    REQUIRE(reached);
    // The same up to the branch; the changes after it are gone.
    const auto branched = openFrames(folder / "branch");
    for (std::size_t k = 0; k <= 10; ++k)
      requireSame(*original->load(k), *branched->load(k));
    REQUIRE_FALSE(sameBits(branched->load(branched->size() - 1)->position,
                           original->load(original->size() - 1)->position));
  }
}
