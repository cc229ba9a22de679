// Changes while a run goes on: exact motion, and the same bits when the scene that was kept is run again.

#include "sim/base/error.h"
#include "sim/io/run_folder.h"
#include "sim/run/branch.h"
#include "sim/run/run.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
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

/// A scene of glass beads of 2 mm: `head` holds the keys above all tables and the domain, `laws` those of the
/// contact, `rest` walls, fills, stages and what else there is.
std::string beadScene(const std::string& head, const std::string& laws, const std::string& rest) {
  return head + R"(
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[species]]
name = "bead"
material = "glass"
size = { distribution = "single", diameter = "2 mm" }
[[contact]]
between = ["glass", "glass"]
)" + laws +
         rest;
}

/// One bead with 1 m/s along x, 0.1 s under a gravity that turns half way.
const std::string flight = beadScene(R"(
gravity = ["0", "0", "-10 m/s^2"]
[domain]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["1 m", "1 m", "1 m"]
)",
                                     R"(
normal = { law = "linear", collision_time = "5e-4 s", restitution = 0.9 }
)",
                                     R"(
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
)");

/// Beads on a plate that goes up and down, in a box that is periodic to the sides.
const std::string shaker = beadScene(R"(
title = "Shaker"
seed = 5
[domain]
lower = ["0", "0", "-2 mm"]
upper = ["12 mm", "12 mm", "40 mm"]
periodic = ["x", "y"]
)",
                                     R"(
normal = { law = "linear", collision_time = "5e-4 s", restitution = 0.8 }
tangential = { law = "spring", friction = 0.3, stiffness_ratio = 0.2857142857142857 }
)",
                                     R"(
[[wall]]
name = "plate"
kind = "plane"
material = "glass"
point = ["0", "0", "0"]
normal = ["0", "0", "1"]
motion = { kind = "oscillate", amplitude = ["0", "0", "1 mm"], frequency = "25 Hz" }
[[fill]]
kind = "lattice"
species = "bead"
lower = ["0", "0", "1 mm"]
upper = ["12 mm", "12 mm", "9 mm"]
structure = "sc"
spacing = "2.4 mm"
velocity_spread = ["0.05 m/s", "0.05 m/s", "0.05 m/s"]
[[stage]]
name = "shake"
until = { duration = "0.1 s" }
[output]
frame_interval = "5 ms"
checkpoint_interval = "7 ms"
)");

} // namespace

TEST_CASE("A grain whose gravity turns at a step moves on two exact parabolas", "[events]") {
  const Scene scene = parseScene(flight, "flight");
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

TEST_CASE("A wall's motion goes on from where it is at the pace of an event", "[events]") {
  const Scene scene =
      parseScene(shaker, "shaker",
                 {"accuracy.time_step=\"20 us\"", "event=[{step=500,pace_walls=[\"plate\"],pace=0.0},"
                                                  "{step=1000,pace_walls=[\"plate\"],pace=2.0}]"});
  Run run(scene, {});
  int seen = 0;
  run.onSavedFrame = [&](FramePtr frame) {
    // 25 Hz with the clock of the wall: as the time up to 10 ms, held there to 20 ms, then twice as fast.
    const double t = frame->time, clock = t < 0.01 ? t : t < 0.02 ? 0.01 : 0.01 + 2 * (t - 0.02);
    const double phase = 2 * std::numbers::pi * 25 * clock;
    const FrameWall& plate = frame->walls.at(0);
    CHECK(plate.translation.z() == Approx(1e-3 * std::sin(phase)).margin(1e-12));
    const double pace = t < 0.01 - 1e-9 ? 1 : t < 0.02 - 1e-9 ? 0 : 2;
    CHECK(plate.velocity.z() ==
          Approx(pace * 1e-3 * 2 * std::numbers::pi * 25 * std::cos(phase)).margin(1e-9));
    ++seen;
  };
  run.execute();
  CHECK(seen == 21);
}

TEST_CASE("The pace of a wall changed while a run went on gives the same bits again", "[events]") {
  const TemporaryFolder folder("pace");
  const Scene scene = parseScene(shaker, "shaker");
  {
    Run run(scene, into(folder / "live"));
    int frames = 0;
    run.onSavedFrame = [&](FramePtr) {
      if (++frames == 5) run.change({.paceWalls = {"plate"}, .pace = 3.0});
      if (frames == 9) run.change({.paceWalls = {"plate"}, .pace = 0.0});
      if (frames == 13) run.change({.paceWalls = {"plate"}, .pace = 0.7});
    };
    run.execute();
  }
  const Scene kept = readScene((folder / "live" / "scene.toml").string());
  REQUIRE(kept.events.size() == 3);
  REQUIRE(kept.events[0].pace == 3.0);
  auto options = into(folder / "again");
  options.threads = 2;
  Run(kept, options).execute();
  requireSameFrames(folder / "live", folder / "again");
  auto parts = into(folder / "parts");
  parts.resume = true;
  int stops = 0;
  for (;; ++stops) {
    REQUIRE(stops < 100);
    Run part(kept, parts);
    int frames = 0;
    part.onSavedFrame = [&](FramePtr) {
      if (++frames == 2 + stops % 3) part.stop();
    };
    if (part.execute() == RunOutcome::finished) break;
  }
  CHECK(stops > 3);
  requireSameFrames(folder / "live", folder / "parts");
}

TEST_CASE("A pace that cannot be is refused with a sentence", "[events]") {
  Run run(parseScene(shaker, "shaker"), {});
  CHECK_THROWS_WITH(run.change({.paceWalls = {"lid"}, .pace = 1.0}),
                    Catch::Contains("no wall 'lid' with a motion"));
  CHECK_THROWS_WITH(run.change({.paceWalls = {"plate"}, .pace = -1.0}), Catch::Contains("from 0 to 100"));
  CHECK_THROWS_WITH(run.change({.paceWalls = {"plate"}}), Catch::Contains("from 0 to 100"));
  CHECK_THROWS_WITH(parseScene(shaker, "shaker", {"event=[{step=5,pace_walls=[\"plate\"]}]"}),
                    Catch::Contains("give both or neither"));
}
