// The real solver under a run: any step can be the last before a restart.

#include "sim/io/run_folder.h"
#include "sim/run/run.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;

TEST_CASE("Every step of a discharge can be saved and gone on from", "[run]") {
  const Scene scene = parseScene(smallHopper, "small hopper");
  const SolverOptions one{1};
  const auto solver = makeSolver(scene, one);
  solver->add(placeGrains(scene, "settle", solver->nextId(), {}));
  solver->removeWall("gate");
  while (solver->flow().grainsDischarged < 5)
    solver->advance(10); // falls through the open outlet
  const auto before = solver->flow().grainsDischarged;
  for (int k = 0; k < 400; ++k) {
    const Solver::State state = solver->save();
    const auto again = makeSolver(scene, one);
    again->load(state);
    INFO("step " << solver->step());
    REQUIRE(again->save() == state);
    again->advance(3);
    solver->advance(1);
    if (k % 40 == 0) { // the step alone, then a few
      solver->advance(2);
      requireEqual(*again->frame(), *solver->frame());
    }
  }
  CHECK(solver->flow().grainsDischarged > before); // lists were rebuilt without the grains that left
}

TEST_CASE("A discharge stopped at many odd steps leaves the bits of one that ran through", "[run]") {
  const TemporaryFolder folder("restart");
  // Probes at intervals that share no step with rain (20 steps), outlets or checkpoints for long.
  const Scene scene =
      parseScene(smallHopper, "small hopper",
                 {"probe.energy.interval=\"0.37 ms\"", "stage.settle.until.duration=\"20 ms\"",
                  "stage.discharge.until.duration=\"60 ms\""});
  RunOptions whole;
  whole.folder = folder / "whole";
  whole.threads = 1;
  Run(scene, whole).execute();

  RunOptions parts = whole;
  parts.folder = folder / "parts";
  parts.resume = true;
  int stops = 0;
  for (;; ++stops) {
    REQUIRE(stops < 100);
    parts.threads = 1 + stops % 3;
    Run part(scene, parts);
    int samples = 0;
    part.onSample = [&](const ProbeSample&) {
      if (++samples == 7 + stops % 5) part.stop();
    };
    if (part.execute() == RunOutcome::finished) break;
  }
  CHECK(stops > 15);
  RunOptions often = whole;
  often.folder = folder / "often";
  often.checkpointWallInterval = 0.01; // wherever that falls
  Run(scene, often).execute();
  const auto a = openFrames(whole.folder), b = openFrames(parts.folder), c = openFrames(often.folder);
  REQUIRE(a->size() == b->size());
  REQUIRE(a->size() == c->size());
  for (std::size_t i = 0; i < a->size(); ++i) {
    requireEqual(*a->load(i), *b->load(i));
    requireEqual(*a->load(i), *c->load(i));
  }
}
