// The same bits for any number of threads and across save and load in beds so large that threads really share
// them: below 4096 grains all pairs stand in one chunk, which one thread works through. Every law, every kind
// of wall, every knob.

#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/contact/pair_list.h"
#include "sim/walls/wall_registry.h"
#include "tests/sim/physics/every_law.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr int layers = 24;                         ///< of 20 x 20 grains: 9600, four chunks
constexpr double spacing = 1.999e-3, side = 40e-3; ///< touching; periodic across

/// Of a block of touching grains, stirred, in a box that is periodic across.
Scene block(SceneText t) {
  t.gravity = R"(["1 m/s^2", "0", "-9.81 m/s^2"])";
  t.lower = R"(["0", "0", "-60 mm"])";
  t.upper = R"(["40 mm", "40 mm", "60 mm"])";
  t.periodic = R"(["x", "y"])";
  t.stepsPerContact = 25;
  std::string text = t.text();
  text.replace(text.find("[\"2 mm\", \"2 mm\", \"2 mm\"]"), 24,
               "[\"20 mm\", \"20 mm\", \"5 mm\"]"); // clear of walls
  return parseScene(text, "block");
}

std::vector<GrainSeed> touching() {
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 400 * layers; ++k) {
    RandomStream random(19, RandomPurpose::test, k);
    const Vec3 place(spacing * (k % 20 + 0.5), spacing * (k / 20 % 20 + 0.5), spacing * (k / 400) - 20e-3);
    seeds.push_back(
        grain(k, place + 1e-6 * random.direction(), 0.3 * random.direction(), 50 * random.direction()));
  }
  return seeds;
}

/// The state after `steps`; begun by a solver of other threads and handed over after `saveAt` of them.
Solver::State after(const Scene& scene, const std::vector<GrainSeed>& seeds, int threads, int steps,
                    int saveAt = 0) {
  auto solver = std::make_unique<DemSolver>(scene, SolverOptions{saveAt > 0 ? 2 : threads});
  solver->add(seeds);
  if (saveAt > 0) {
    solver->advance(saveAt);
    const auto saved = solver->save();
    solver = std::make_unique<DemSolver>(scene, SolverOptions{threads});
    solver->load(saved);
  }
  solver->advance(steps - saveAt);
  return solver->save();
}

void sameBits(const Scene& scene, const std::vector<GrainSeed>& seeds, int steps) {
  const auto expected = after(scene, seeds, 1, steps);
  CHECK(after(scene, seeds, 3, steps) == expected);
  CHECK(after(scene, seeds, 7, steps, steps / 3) == expected);
}

} // namespace

TEST_CASE("the beds of these tests are shared between threads") {
  const auto seeds = touching();
  GrainStore store;
  store.imaged = true;
  store.resize(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Vec3& x = seeds[i].position;
    store.place[i] = {x.x(), x.y(), x.z(), seeds[i].radius};
    store.motion[i].w = 1.0;
    store.id[i] = seeds[i].id;
  }
  PairList list(block({}).domain, 0, 0, false);
  Parallel parallel(3);
  list.build(store, 1e-5, parallel);
  CHECK(list.chunks() >= 4);
}

TEST_CASE("threads that share a bed give the same bits, and so does a restart, with every law") {
  for (const LawKind& kind : lawKinds())
    for (const int variant : {0, 1}) {
      INFO(kind.name << " variant " << variant);
      sameBits(block(sceneWith(kind, variant)), touching(), 45);
    }
}

TEST_CASE("threads that share a bed give the same bits, and so does a restart, with every knob") {
  for (const char* knob :
       {"precision = \"mixed\"\n", "arithmetic = \"fast\"\n", "integrator = \"semi_implicit\"\n",
        "stiffness_scale = 0.1\n", "skin = 0.2\n", "precision = \"mixed\"\narithmetic = \"fast\"\n"})
    for (const bool hertz : {false, true}) {
      INFO(knob << " Hertz " << hertz);
      SceneText t;
      t.elasticity = "youngs_modulus = \"20 MPa\"\npoisson_ratio = 0.25";
      if (hertz) t.normal = R"({ law = "hertz", restitution = 0.8 })";
      t.tangential =
          hertz ? R"({ law = "mindlin", friction = 0.4 })" : R"({ law = "spring", friction = 0.4 })";
      t.accuracy = knob;
      sameBits(block(t), touching(), 100);
    }
}

TEST_CASE("threads that share a bed give the same bits, and so does a restart, at walls of every kind") {
  // Around or across the middle of 20 layers; grains that would touch or lie beyond are left out.
  const std::map<std::string, std::string> shapes{
      {"plane", R"(point = ["0", "0", "-8 mm"]
normal = [0.1, 0, 1])"},
      {"rectangle", R"(centre = ["20 mm", "20 mm", "0"]
normal = [0.2, 0.1, 1]
along = [1, 0, 0]
length = "30 mm"
breadth = "25 mm")"},
      {"box", R"(lower = ["3 mm", "2 mm", "-18 mm"]
upper = ["38 mm", "37 mm", "15 mm"])"},
      {"cylinder", R"(base = ["20 mm", "20 mm", "-18 mm"]
radius = "19 mm"
height = "35 mm"
ends = "both")"},
      {"cone", R"(apex = ["20 mm", "20 mm", "-25 mm"]
half_angle = "40 deg"
height = "50 mm")"},
      {"frustum", R"(base = ["20 mm", "20 mm", "-18 mm"]
lower_radius = "16 mm"
upper_radius = "19.5 mm"
height = "40 mm"
ends = "bottom")"},
      {"wedge", R"(centre = ["20 mm", "20 mm", "-15 mm"]
up = [0, 0, 1]
along = [0, 1, 0]
outlet = "16 mm"
width = "38 mm"
half_angle = "50 deg"
height = "60 mm"
lip = "3 mm")"},
      {"cone_hopper", R"(base = ["20 mm", "20 mm", "-16 mm"]
outlet = "20 mm"
width = "39 mm"
half_angle = "30 deg"
height = "60 mm"
lip = "3 mm")"},
      {"disc", R"(centre = ["20 mm", "20 mm", "0"]
normal = [0, 0.3, 1]
radius = "18 mm"
hole = "4 mm")"},
      {"oblique_cone", R"(base = ["18 mm", "20 mm", "-15 mm"]
lower_radius = "12 mm"
upper_radius = "19 mm"
height = "20 mm"
offset = ["2 mm", "0", "0"]
bin = "30 mm"
chute = "4 mm")"},
      {"mesh",
       R"(points = [["2 mm", "2 mm", "-6 mm"], ["38 mm", "2 mm", "-4 mm"], ["38 mm", "38 mm", "-8 mm"],
["2 mm", "38 mm", "-4 mm"], ["20 mm", "20 mm", "2 mm"]]
corners = [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4])"},
  };
  for (const WallKind& kind : wallKinds())
    for (const bool moving : {false, true}) {
      INFO(kind.name << " moving " << moving);
      REQUIRE(shapes.contains(kind.name)); // a new kind needs its line here
      SceneText t;
      t.tangential = R"({ law = "spring", friction = 0.4 })";
      t.rolling = R"({ law = "constant_torque", coefficient = 0.05 })";
      t.walls = "[[wall]]\nname = \"wall\"\nkind = \"" + kind.name + "\"\nmaterial = \"wall\"\n" +
                shapes.at(kind.name) + "\n";
      if (moving)
        t.walls +=
            R"(motion = { kind = "oscillate", amplitude = ["0.2 mm", "0", "0.1 mm"], frequency = "300 1/s" }
[[probe]]
name = "load"
kind = "wall_force"
wall = "wall"
interval = "1 ms"
)";
      const Scene scene = block(t);
      std::vector<GrainSeed> seeds;
      const DemSolver empty(scene, {1});
      for (const GrainSeed& s : touching()) {
        WallShape::Touches touches;
        const auto wall = empty.walls().at(0);
        wall.shape->touches(s.position, 1.0e-3, touches);
        if (touches.count == 0 && wall.shape->signedDistance(s.position) > 0.0) seeds.push_back(s);
      }
      CHECK(seeds.size() > 4096);
      sameBits(scene, seeds, 60);
      DemSolver solver(scene, {2});
      solver.add(seeds);
      solver.advance(60);
      CHECK(solver.walls().at(0).force.norm() > 0.0);
    }
}

TEST_CASE("threads that share a wedge give the same bits, and so does a restart") {
  SceneText t;
  t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  t.lower = R"(["-70 mm", "-70 mm", "-20 mm"])";
  t.upper = R"(["70 mm", "70 mm", "60 mm"])";
  t.tangential = R"({ law = "spring", friction = 0.4 })";
  t.stepsPerContact = 25;
  t.accuracy = "[wedge]\nangle = \"90 deg\"\n";
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 31 * 31 * 14; ++k) {
    RandomStream random(23, RandomPurpose::test, k);
    const Vec3 place(spacing * (k % 31 + 0.5), spacing * (k / 31 % 31 + 0.5), spacing * (k / 961));
    if (std::hypot(place.x(), place.y()) < 61e-3)
      seeds.push_back(
          grain(k, place + 1e-6 * random.direction(), 0.3 * random.direction(), 50 * random.direction()));
  }
  REQUIRE(seeds.size() > 8000);
  sameBits(t.scene(), seeds, 100);
}
