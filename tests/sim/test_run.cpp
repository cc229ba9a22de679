// The run around the solver: stages, probes, frames, checkpoints, resume. The solver is the transparent one
// of fake_solver.h, so every expected number follows from free fall.

#include "sim/base/error.h"
#include "sim/io/run_folder.h"
#include "sim/io/series.h"
#include "sim/run/checkpoint_store.h"
#include "sim/run/run.h"
#include "tests/sim/ballistic_scene.h"
#include "tests/sim/fake_solver.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>
#include <thread>

using namespace sandglass;
using namespace sandglass::test;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

constexpr double stepSize = 1e-3;

RunOptions options(const fs::path& folder, FakeFaults faults = {}) {
  RunOptions o;
  o.folder = folder;
  o.solverFactory = [faults](const Scene& scene, const SolverOptions&) {
    return std::make_unique<FakeSolver>(scene, stepSize, faults);
  };
  return o;
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<FramePtr> allFrames(const fs::path& folder) {
  const auto source = openFrames(folder);
  std::vector<FramePtr> frames;
  for (std::size_t i = 0; i < source->size(); ++i)
    frames.push_back(source->load(i));
  return frames;
}

void requireSameRun(const fs::path& a, const fs::path& b) {
  const auto first = allFrames(a), second = allFrames(b);
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    requireEqual(*first[i], *second[i]);
  REQUIRE(contentOf(a / "series.csv") == contentOf(b / "series.csv"));
}

} // namespace

TEST_CASE("A run writes frames and series at the steps that the intervals name", "[run]") {
  const TemporaryFolder folder("run");
  Run run(ballisticScene(), options(folder / "r"));
  std::size_t saved = 0;
  std::vector<double> sampled;
  run.onSavedFrame = [&](const FramePtr&) { ++saved; };
  run.onSample = [&](const ProbeSample& s) {
    if (s.probe == "energy") sampled.push_back(s.time);
  };
  REQUIRE(run.execute() == RunOutcome::finished);

  // 0.3 s of fill, then 0.4 s of fall: frames each 50 ms, both ends included.
  const auto frames = allFrames(folder / "r");
  REQUIRE(frames.size() == 15);
  CHECK(saved == 15);
  for (std::size_t i = 0; i < frames.size(); ++i)
    CHECK(frames[i]->step == static_cast<std::int64_t>(50 * i));
  CHECK(frames.front()->stage == "bounce");
  CHECK(frames[6]->stage == "bounce"); // the state at 0.3 s, when the floor still stood
  CHECK(frames[7]->stage == "fall");
  CHECK(frames.back()->provenance.at("seed") == "7");
  CHECK(frames.back()->provenance.at("step_size") == "0.001 s");
  CHECK(frames.back()->provenance.contains("version"));
  // The energy probe each 20 ms of 0.7 s: 0, 20, ..., 700.
  REQUIRE(sampled.size() == 36);
  CHECK(sampled[1] == Approx(0.02).margin(1e-12));
  const auto series = readSeries(folder / "r" / "series.csv");
  CHECK(series.at("energy.total").value.size() == 36);
  CHECK(series.at("lost.rate").value.size() == 8); // each 100 ms
  CHECK(fs::exists(folder / "r" / "scene.toml"));
  CHECK(series.at("weight.force.z").value == std::vector<double>{0, -50, -100, -150, -200, -250, -300, -350,
                                                                 -400, -450, -500, -550, -600, -650, -700});
  CHECK(frames.front()->size() == 40);
  CHECK(frames[6]->size() == ballisticGrains); // it rained
  CHECK(frames[6]->walls.at(0).active);
  CHECK_FALSE(frames[7]->walls.at(0).active);
  CHECK(frames[7]->walls.at(0).shape->signedDistance(Vec3(3, 4, 5)) == 5); // made anew from the scene inside
  CHECK_THAT(contentOf(folder / "r" / "log.txt"), Contains("stage 'fall' begins at 0.3 s"));
  const RunSummary summary = run.summary();
  CHECK(summary.stagesDone == 2);
  CHECK(summary.steps == 700);
  CHECK(summary.frames == 15);
}

TEST_CASE("The flow-rate probe and the outlet agree on what left", "[run]") {
  const TemporaryFolder folder("flow");
  Scene scene = ballisticScene();
  Run run(scene, options(folder / "r"));
  run.execute();
  const auto lost = readSeries(folder / "r" / "series.csv").at("lost.mass").value;
  // From 0.7 m at rest it is 0.38 s to the floor and 0.43 s to the outlet: not all have left after 0.4 s.
  REQUIRE(run.summary().flow.grainsDischarged > 30);
  // What passed the plane 10 cm above the outlet left by the outlet or is between the two.
  const FramePtr last = allFrames(folder / "r").back();
  const auto between =
      std::count_if(last->position.begin(), last->position.end(), [](const Vec3& x) { return x.z() < -0.1; });
  const double passed =
      ballisticGrainMass() * static_cast<double>(run.summary().flow.grainsDischarged + between);
  CHECK(lost.back() == Approx(passed).epsilon(1e-12));
  const auto rate = readSeries(folder / "r" / "series.csv").at("lost.rate").value;
  double sum = 0;
  for (const double r : rate)
    sum += 0.1 * r;
  CHECK(sum == Approx(lost.back()).epsilon(1e-9));
}

TEST_CASE("Stages end by mass, by emptiness and by quiet", "[run]") {
  const double grain = ballisticGrainMass();
  Scene scene = ballisticScene();
  scene.stages[1].duration = 10;
  SECTION("mass discharged within the stage") {
    scene.stages[1].massDischarged = 19.5 * grain;
  }
  SECTION("empty") {
    scene.stages[1].untilEmpty = true;
  }
  SECTION("quiet for 0.25 s") {
    scene.stages[1].quietTime = 0.25;
  }
  Run run(scene, options({}));
  run.execute();
  const RunSummary summary = run.summary();
  if (scene.stages[1].massDischarged) {
    CHECK(summary.flow.massDischarged >= 19.5 * grain);
    CHECK(summary.grains > 0);
  } else {
    CHECK(summary.grains == 0);
  }
  // Decisions fall at whole multiples of 20 steps after the stage's start (step 300).
  CHECK((summary.steps - 300) % 20 == 0);
  if (scene.stages[1].quietTime)
    CHECK(summary.time - summary.flow.lastDischarge == Approx(0.25).margin(0.0201));
}

TEST_CASE("A stage of more steps than can be counted is refused", "[run]") {
  Scene scene = ballisticScene();
  SECTION("duration") {
    scene.stages[1].duration = 1e30;
  }
  SECTION("settled_after") {
    scene.stages[1].settledAfter = 1e30;
  }
  Run run(scene, options({}));
  CHECK_THROWS_WITH(run.execute(), Contains("stage.fall.until.") && Contains("1e+33 steps of 0.001 s"));
}

TEST_CASE("A run that is stopped and resumed leaves the same bits", "[run]") {
  const TemporaryFolder folder("resume");
  Run whole(ballisticScene(), options(folder / "whole"));
  whole.execute();

  int stops = 0;
  for (bool first = true;; first = false) {
    auto o = options(folder / "parts");
    o.resume = !first;
    Run part(ballisticScene(), o);
    part.onProgress = [&](const Progress&) {};
    int samples = 0;
    part.onSample = [&](const ProbeSample&) {
      if (++samples == 5) part.stop(); // somewhere in each stage, never at a scheduled checkpoint alone
    };
    if (part.execute() == RunOutcome::finished) break;
    ++stops;
    REQUIRE(stops < 100);
  }
  CHECK(stops >= 5);
  requireSameRun(folder / "whole", folder / "parts");
}

TEST_CASE("What a kill left beyond the checkpoint is dropped", "[run]") {
  const TemporaryFolder folder("torn-run");
  Run whole(ballisticScene(), options(folder / "whole"));
  whole.execute();
  fs::copy(folder / "whole", folder / "killed", fs::copy_options::recursive);
  // As if killed: newer checkpoints gone, the newest one torn, a half-written segment, a line cut short.
  auto checkpoints = checkpointFiles(folder / "killed");
  REQUIRE(checkpoints.size() > 8);
  for (std::size_t i = 8; i < checkpoints.size(); ++i)
    fs::remove(checkpoints[i]);
  fs::resize_file(checkpoints[7], 100);
  std::ofstream(folder / "killed" / "frames" / "00099.vtkhdf.part") << "half";
  std::ofstream(folder / "killed" / "series.csv", std::ios::app) << "0.71,71";
  auto o = options(folder / "killed");
  o.resume = true;
  std::string warnings;
  Run again(ballisticScene(), o, [&](LogLevel level, const std::string& message) {
    if (level == LogLevel::warning) warnings += message;
  });
  CHECK(again.execute() == RunOutcome::finished);
  CHECK_THAT(warnings, Contains("torn or damaged"));
  requireSameRun(folder / "whole", folder / "killed");
  CHECK_FALSE(fs::exists(folder / "killed" / "frames" / "00099.vtkhdf.part"));
}

TEST_CASE("Resuming a finished run changes nothing, and another scene is refused", "[run]") {
  const TemporaryFolder folder("finished");
  Run(ballisticScene(), options(folder / "r")).execute();
  const std::string before = contentOf(folder / "r" / "series.csv");
  auto o = options(folder / "r");
  CHECK_THROWS_WITH(Run(ballisticScene(), o).execute(), Contains("already holds a run"));
  o.resume = true;
  CHECK(Run(ballisticScene(), o).execute() == RunOutcome::finished);
  CHECK(contentOf(folder / "r" / "series.csv") == before);
  CHECK(allFrames(folder / "r").size() == 15);
  Scene other = ballisticScene();
  other.gravity.z() *= 2;
  CHECK_THROWS_WITH(Run(other, o).execute(), Contains("was made from another scene"));
}

TEST_CASE("Two runs cannot share a folder at a time", "[run]") {
  const TemporaryFolder folder("lock");
  Run first(ballisticScene(), options(folder / "r"));
  std::string refusal;
  first.onSample = [&](const ProbeSample&) {
    auto o = options(folder / "r");
    o.resume = true;
    try {
      if (refusal.empty()) Run(ballisticScene(), o).execute();
    } catch (const InputError& error) {
      refusal = error.what();
    }
  };
  CHECK(first.execute() == RunOutcome::finished);
  CHECK_THAT(refusal, Contains("another run is going on in this folder"));
}

TEST_CASE("Checkpoints: the two newest and at most twenty-one spaced ones stay", "[run]") {
  const TemporaryFolder folder("spaced");
  Scene scene = ballisticScene();
  scene.output.checkpointInterval = 0.01; // 70 of them in 0.7 s
  Run(scene, options(folder / "r")).execute();
  const auto files = checkpointFiles(folder / "r");
  CHECK(files.size() >= 11);
  CHECK(files.size() <= 23);
  CHECK(files.front().filename() == "000000000000.checkpoint");
  CHECK(files.back().filename() == "000000000700.checkpoint");
  CHECK(files[files.size() - 2].filename() == "000000000690.checkpoint");
}

TEST_CASE("A fault in the solver names the last good checkpoint and can be resumed", "[run]") {
  const TemporaryFolder folder("fault");
  FakeFaults faults;
  faults.failAt = 500;
  CHECK_THROWS_WITH(Run(ballisticScene(), options(folder / "r", faults)).execute(),
                    Contains("is not a number") && Contains("the last good checkpoint is") &&
                        Contains(".checkpoint"));
  CHECK_THAT(contentOf(folder / "r" / "log.txt"), Contains("error: at 0.5 s"));
  Run(ballisticScene(), options(folder / "whole")).execute();
  auto o = options(folder / "r");
  o.resume = true;
  CHECK(Run(ballisticScene(), o).execute() == RunOutcome::finished);
  requireSameRun(folder / "whole", folder / "r");
}

TEST_CASE("Energy that grows without a source stops the run", "[run]") {
  const TemporaryFolder folder("energy");
  FakeFaults faults;
  SECTION("fast: one per cent of speed a step") {
    faults.heatFrom = 120;
  }
  SECTION("slow: a leak of 0.02 % a step") {
    faults.heatFrom = 1;
    faults.heat = 1.0002;
  }
  Scene scene = ballisticScene();
  scene.stages[0].duration = 5;
  scene.stages.pop_back();
  CHECK_THROWS_WITH(Run(scene, options(folder / "r", faults)).execute(),
                    Contains("mechanical energy grew from") && Contains("reduce the time step") &&
                        Contains("last good checkpoint"));
  CHECK_NOTHROW(Run(scene, options({})).execute()); // the same without the fault
}

TEST_CASE("Pausing and single steps", "[run]") {
  Run run(ballisticScene(), options({}));
  run.pause(true);
  std::atomic<std::int64_t> step{-1};
  RunOptions o = options({});
  o.liveInterval = 1e-9;
  Run live(ballisticScene(), o);
  live.pause(true);
  live.onLiveFrame = [&](const FramePtr& frame) { step = frame->step; };
  std::thread worker([&] { live.execute(); });
  const auto wait = [&](std::int64_t wanted) {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(120); // a busy machine
    while (step != wanted && std::chrono::steady_clock::now() < limit)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return step.load();
  };
  CHECK(wait(0) == 0);
  live.stepOnce(1);
  CHECK(wait(1) == 1);
  live.stepOnce(50); // across rounds of 20 steps
  CHECK(wait(51) == 51);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(step == 51);
  live.stop();
  worker.join();
  CHECK(live.summary().steps == 51);
}
