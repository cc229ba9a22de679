// Drag, rest, recycling, rain at a rate: with the transparent solver where numbers follow from free fall,
// with the real one where contacts and restarts matter.

#include "sim/io/run_folder.h"
#include "sim/io/series.h"
#include "sim/run/recycling.h"
#include "sim/run/run.h"
#include "tests/sim/ballistic_scene.h"
#include "tests/sim/fake_solver.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <set>

using namespace sandglass;
using namespace sandglass::test;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

constexpr double stepSize = 1e-3;

RunOptions fakeOptions(const fs::path& folder) {
  RunOptions o;
  o.folder = folder;
  o.solverFactory = [](const Scene& scene, const SolverOptions&) {
    return std::make_unique<FakeSolver>(scene, stepSize);
  };
  return o;
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// One grain that flies through empty space at 1 m/s.
Scene flight(const std::vector<std::string>& overrides) {
  std::string text = ballisticText;
  const auto fills = text.find("[[fill]]"), stages = text.find("[[stage]]");
  text.replace(
      fills, stages - fills,
      "[[fill]]\nkind = \"list\"\ngrains = [{ species = \"bead\", position = [\"0\", \"0\", \"0.5 m\"], "
      "velocity = [\"1 m/s\", \"0\", \"0\"] }]\n\n");
  std::vector<std::string> all{"gravity=[\"0\", \"0\", \"0\"]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return parseScene(text, "flight", all);
}

} // namespace

TEST_CASE("drag is the exact exponential and ends with its stage", "[flow]") {
  const Scene scene = flight({});
  const auto solver = makeSolver(scene, {1});
  solver->add(placeGrains(scene, "bounce", 0, {}));
  solver->setDrag(3.0);
  solver->advance(700);
  // v = v0 exp(-3 t); each of 700 factors rounds to half a unit in the last place.
  CHECK(solver->greatestSpeed() == Approx(std::exp(-3.0 * solver->time())).epsilon(1e-12));
  solver->setDrag(0);
  const double kept = solver->greatestSpeed();
  solver->advance(100);
  CHECK(solver->greatestSpeed() == kept);

  Run run(flight({"stage.bounce.drag=2 1/s"}), fakeOptions({}));
  FramePtr last;
  run.onSavedFrame = [&](const FramePtr& frame) { last = frame; };
  run.execute(); // 0.3 s with drag, 0.4 s without
  CHECK(last->vector(quantity::velocity)[0].x() == Approx(std::exp(-0.6)).epsilon(1e-12));
}

TEST_CASE("a bed is at rest when the slowest condition holds", "[flow]") {
  // 1 m/s that decays at 1/s; looked at each 200 steps = 0.2 s. Mass 10.472 g.
  const auto settlesAt = [](const std::vector<std::string>& until) {
    std::vector<std::string> overrides{"stage.bounce.drag=1 1/s", "stage.bounce.until.duration=3 s",
                                       "stage.fall.until.duration=10 ms"};
    for (const auto& condition : until)
      overrides.push_back("stage.bounce.until." + condition);
    Run run(flight(overrides), fakeOptions({}));
    run.execute();
    return run.summary().stageStarts.at(1);
  };
  CHECK(settlesAt({"settled_speed=0.5 m/s"}) == Approx(0.8)); // ln 2 = 0.693 s
  // m v^2 / 2 < 1 mJ: v < 0.437 m/s after 0.828 s.
  CHECK(settlesAt({"settled=1 mJ"}) == Approx(1.0));
  CHECK(settlesAt({"settled=1 mJ", "settled_speed=0.5 m/s"}) == Approx(1.0));
  CHECK(settlesAt({"settled=1 mJ", "settled_speed=0.2 m/s"}) == Approx(1.8)); // ln 5 = 1.609 s
  CHECK(settlesAt({"settled_speed=0.5 m/s", "settled_after=1.3 s"}) == Approx(1.4));
}

TEST_CASE("grains that fall out come back over the bed and count their lives", "[flow]") {
  const TemporaryFolder folder("recycle");
  const Scene scene =
      parseScene(ballisticText, "ballistic",
                 {"outlet.below.recycle.lower=[\"-0.5 m\", \"-0.5 m\", \"0.2 m\"]",
                  "outlet.below.recycle.upper=[\"0.5 m\", \"0.5 m\", \"0.9 m\"]",
                  "outlet.below.recycle.velocity=[\"0\", \"0\", \"-1 m/s\"]", "outlet.below.record=true",
                  "stage.fall.until.duration=20 s", "stage.fall.until.recirculations=3"});
  Run run(scene, fakeOptions(folder / "r"));
  REQUIRE(run.execute() == RunOutcome::finished);
  const RunSummary s = run.summary();
  CHECK(s.flow.grainsEntered == ballisticGrains);
  CHECK(s.flow.grainsRecycled >= 3 * ballisticGrains); // looked at each 20 steps
  CHECK(s.flow.grainsRecycled < 4 * ballisticGrains);
  CHECK(s.time < 3); // 0.4 m at 1 m/s and faster takes at most 0.22 s, four times
  const auto waiting = static_cast<std::int64_t>(ballisticGrains) - static_cast<std::int64_t>(s.grains);
  CHECK(waiting >= 0);
  CHECK(s.flow.grainsEntered + s.flow.grainsRecycled - s.flow.grainsDischarged ==
        static_cast<std::int64_t>(s.grains));
  CHECK(s.flow.massRecycled == Approx(static_cast<double>(s.flow.grainsRecycled) * ballisticGrainMass()));

  // A row for each passage: every id in every life once, in the order of time.
  const auto rows = readSeries(folder / "r" / "discharged.csv");
  const auto& ids = rows.at("id").value;
  REQUIRE(static_cast<std::int64_t>(ids.size()) == s.flow.grainsDischarged);
  std::set<std::pair<double, double>> seen;
  for (std::size_t i = 0; i < ids.size(); ++i)
    CHECK(seen.insert({ids[i], rows.at("life").value[i]}).second);
  CHECK(rows.at("z").value[0] < -0.2);
  CHECK(rows.at("diameter").value[0] == 0.02);
  const auto& times = rows.at("id").time;
  CHECK(std::is_sorted(times.begin(), times.end()));

  // The plane of the probe lies 10 cm above the outlet: what has passed it in all lives has left or is
  // between.
  const auto lost = readSeries(folder / "r" / "series.csv").at("lost.mass").value.back();
  const auto source = openFrames(folder / "r");
  const FramePtr last = source->load(source->size() - 1);
  const auto between =
      std::count_if(last->position.begin(), last->position.end(), [](const Vec3& x) { return x.z() < -0.1; });
  CHECK(lost / ballisticGrainMass() ==
        Approx(static_cast<double>(s.flow.grainsDischarged + between)).epsilon(1e-9));
}

TEST_CASE("grains that rained into an empty stage are counted when they go round", "[flow]") {
  std::string text = ballisticText;
  const auto first = text.find("[[fill]]");
  text.erase(first, text.find("[[fill]]", first + 1) - first);
  const Scene scene = parseScene(text, "ballistic",
                                 {"outlet.below.recycle.lower=[\"-0.5 m\", \"-0.5 m\", \"0.2 m\"]",
                                  "outlet.below.recycle.upper=[\"0.5 m\", \"0.5 m\", \"0.9 m\"]",
                                  "stage.bounce.remove_walls=[\"floor\"]", "stage.bounce.until.duration=20 s",
                                  "stage.bounce.until.recirculations=3", "stage.fall.remove_walls=[]",
                                  "stage.fall.until.duration=1 ms"});
  Run run(scene, fakeOptions({}));
  REQUIRE(run.execute() == RunOutcome::finished);
  CHECK(run.summary().flow.grainsEntered == 10);
  CHECK(run.summary().flow.grainsRecycled >= 30);
  CHECK(run.summary().flow.grainsRecycled < 40);
  CHECK(run.summary().time < 5);
}

TEST_CASE("a place is the lowest free one over the bed, whoever asks first", "[flow]") {
  const Scene scene = parseScene(ballisticText, "ballistic",
                                 {"outlet.below.recycle.lower=[\"-5 cm\", \"-5 cm\", \"20 cm\"]",
                                  "outlet.below.recycle.upper=[\"5 cm\", \"5 cm\", \"40 cm\"]"});
  const auto leaving = [](std::int64_t id) {
    LeftGrain left;
    left.grain.id = id;
    left.grain.radius = 0.01;
    left.grain.life = 4;
    return left;
  };
  FakeSolver empty(scene, stepSize);
  Recycling alone(scene);
  alone.left(leaving(3));
  const auto first = alone.due(empty, "fall");
  REQUIRE(first.size() == 1);
  CHECK(alone.waiting() == 0);
  CHECK(first[0].position.z() == Approx(0.21)); // on the bottom of the box
  CHECK(first[0].life == 5);

  // Behind another one it gets the same level place, and rests on what is below it.
  Recycling behind(scene);
  for (const std::int64_t id : {7, 3})
    behind.left(leaving(id));
  const auto both = behind.due(empty, "fall");
  REQUIRE(both.size() == 2);
  CHECK(both[1].position.head<2>() == first[0].position.head<2>());

  // A pile under its place: it comes to rest on top. A grain that falls far enough above does not matter.
  FakeSolver bed(scene, stepSize);
  std::vector<GrainSeed> pile(3);
  for (std::size_t k = 0; k < pile.size(); ++k) {
    pile[k].radius = 0.01;
    pile[k].position = first[0].position + Vec3(0, 0, std::vector<double>{0.01, 0.045, 0.11}[k]);
  }
  bed.add(pile);
  Recycling above(scene);
  above.left(leaving(3));
  // Blocked: 0.20 to 0.24, 0.235 to 0.275, and 0.30 to 0.34, of which 0.025 is free below.
  CHECK(above.due(bed, "fall").at(0).position.z() == Approx(0.275).epsilon(1e-6));
  GrainSeed boulder;
  boulder.radius = 0.3;
  boulder.position = Vec3(0, 0, 0.3);
  bed.add({boulder});
  above.left(leaving(3));
  CHECK(above.due(bed, "fall").empty());
  CHECK(above.waiting() == 1);
  Recycling restored(scene);
  restored.load(above.save());
  CHECK(restored.waiting() == 1);
  CHECK(restored.save() == above.save());
}

TEST_CASE("a recycling hopper stopped at odd steps leaves the bits of one that ran through", "[flow]") {
  const TemporaryFolder folder("recycle-restart");
  const Scene scene =
      parseScene(smallHopper, "small hopper",
                 {"outlet.below.recycle.lower=[\"-1.5 cm\", \"1 cm\", \"-0.4 cm\"]",
                  "outlet.below.recycle.upper=[\"1.5 cm\", \"7 cm\", \"0.4 cm\"]", "outlet.below.record=true",
                  "output.quantities=[\"velocity\", \"spin\", \"residence_time\", \"life\"]",
                  "probe.energy.interval=\"0.37 ms\"", "stage.settle.until.duration=\"20 ms\"",
                  "stage.settle.drag=\"20 1/s\"", "stage.discharge.until.duration=\"90 ms\""});
  RunOptions whole;
  whole.folder = folder / "whole";
  whole.threads = 3;
  Run through(scene, whole);
  through.execute();
  const RunSummary s = through.summary();
  CHECK(s.flow.grainsRecycled > 20);
  RunOptions parts = whole;
  parts.folder = folder / "parts";
  parts.resume = true;
  int stops = 0;
  for (;; ++stops) {
    REQUIRE(stops < 100);
    parts.threads = 1 + stops % 2;
    Run part(scene, parts);
    int samples = 0;
    part.onSample = [&](const ProbeSample&) {
      if (++samples == 17 + stops % 5) part.stop();
    };
    if (part.execute() == RunOutcome::finished) break;
  }
  CHECK(stops > 10);
  for (const char* file : {"series.csv", "discharged.csv"})
    CHECK(contentOf(folder / "whole" / file) == contentOf(folder / "parts" / file));
  const auto a = openFrames(whole.folder), b = openFrames(parts.folder);
  REQUIRE(a->size() == b->size());
  for (std::size_t i = 0; i < a->size(); ++i)
    requireEqual(*a->load(i), *b->load(i));

  // A grain's residence time began when it entered or came back.
  const FramePtr last = a->load(a->size() - 1);
  const auto& life = last->scalar(quantity::life);
  const auto& residence = last->scalar(quantity::residenceTime);
  double lives = 0;
  for (std::size_t i = 0; i < life.size(); ++i) {
    lives += life[i];
    if (last->id[i] < 250) CHECK((life[i] > 0 || residence[i] == Approx(last->time)));
    if (life[i] > 0) CHECK(residence[i] < last->time - 0.02); // nothing leaves before the gate opens
  }
  CHECK(lives <= static_cast<double>(s.flow.grainsRecycled));
  CHECK(lives > 0);
}

TEST_CASE("a wall is weighed at steps at which grains come and leave", "[flow]") {
  // One grain rests on the floor, another comes, flies and leaves: the floor carries the first one's weight.
  const Scene scene =
      flight({"gravity=[\"0\", \"0\", \"-9.81 m/s^2\"]", "outlet.below.point=[\"0.4 m\", \"0\", \"0\"]",
              "outlet.below.normal=[1, 0, 0]"});
  const auto solver = makeSolver(scene, {1});
  GrainSeed resting;
  resting.radius = 0.01;
  resting.position = Vec3(0, 0, 0.01);
  solver->add({resting});
  solver->setDrag(100);
  while (solver->time() < 0.5)
    solver->advance(100);
  solver->setDrag(0);
  const double weight = ballisticGrainMass() * 9.81;
  const auto carried = [&] { return -solver->walls().at(0).force.z(); };
  REQUIRE(carried() == Approx(weight).epsilon(1e-6));
  GrainSeed flying;
  flying.id = solver->nextId();
  flying.radius = 0.01;
  flying.position = Vec3(0.3, 0, 0.3);
  flying.velocity = Vec3(1, 0, 0);
  solver->add({flying});
  solver->advance(0);
  CHECK(carried() == Approx(weight).epsilon(1e-6));
  for (int k = 0; k < 2000 && solver->flow().grainsDischarged == 0; ++k) {
    solver->advance(1);
    CHECK(carried() == Approx(weight).epsilon(1e-6));
  }
  CHECK(solver->flow().grainsDischarged == 1);
}

TEST_CASE("rain without a number lasts as long as its stage, and lagging rain is told", "[flow]") {
  std::string text = ballisticText;
  const auto at = text.find("number = 10\n");
  text.erase(at, 12);
  const Scene scene = parseScene(text, "ballistic");
  CHECK(expectedGrains(scene) == 55); // 40, and 50 a second for 0.3 s
  std::string log;
  Run run(scene, fakeOptions({}), [&](LogLevel level, const std::string& line) {
    if (level == LogLevel::warning) log += line;
  });
  run.execute();
  CHECK(run.summary().flow.grainsEntered == 55);
  CHECK(log.empty());

  // 50 a second for 0.1 s are 5 of the 10 grains asked for.
  Run brief(ballisticScene({"stage.bounce.until.duration=0.1 s"}), fakeOptions({}),
            [&](LogLevel level, const std::string& line) {
              if (level == LogLevel::warning) log += line;
            });
  brief.execute();
  CHECK_THAT(log, Contains("stage 'bounce', rain: the stage ended when 5 of its 10 grains had come"));
}
