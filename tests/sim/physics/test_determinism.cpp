// The same bits whatever the number of threads, and across save and load.

#include "sim/base/random.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>
#define XXH_INLINE_ALL // header only
#include <xxhash.h>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr const char* linear = R"({ law = "linear", stiffness = "500 N/m", restitution = 0.8 })";

/// A thin periodic slab (2.5 diameters deep) filled over a floor: pairs meet through several images.
SceneText slabText(const char* normal, bool mixed) {
  SceneText t;
  t.gravity = R"(["0", "-9.81 m/s^2", "0"])";
  t.lower = R"(["-15 mm", "-5 mm", "0 mm"])";
  t.upper = R"(["15 mm", "200 mm", "5 mm"])";
  t.periodic = R"(["x", "z"])";
  t.elasticity = "youngs_modulus = \"20 MPa\"\npoisson_ratio = 0.25";
  t.normal = normal;
  t.tangential = R"({ law = "spring", friction = 0.5, damping_ratio = 0.2 })";
  if (mixed)
    t.accuracy = "precision = \"mixed\"\n";
  else
    t.rolling = R"({ law = "elastic_plastic", coefficient = 0.1 })";
  t.stepsPerContact = 25;
  t.walls = "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
            "\"0 m\"]\nnormal = [0, 1, 0]\n";
  return t;
}

std::unique_ptr<DemSolver> filled(const SceneText& text, int threads) {
  auto solver = std::make_unique<DemSolver>(text.scene(), SolverOptions{threads});
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 1800; ++k) {
    RandomStream random(3, RandomPurpose::test, k);
    const Vec3 place(-14e-3 + 2.1e-3 * (k % 14), 1.2e-3 + 2.1e-3 * (k / 28), 0.1e-3 + 2.3e-3 * (k / 14 % 2));
    seeds.push_back(grain(k, place + 0.05e-3 * random.direction(), 0.3 * random.direction()));
  }
  solver->add(seeds);
  return solver;
}

std::unique_ptr<DemSolver> slab(int threads, const char* normal = linear, bool mixed = false) {
  return filled(slabText(normal, mixed), threads);
}

std::string bits(const DemSolver& solver) {
  std::string all;
  const auto put = [&](const Vec3& v) {
    all.append(reinterpret_cast<const char*>(v.data()), sizeof(double) * 3);
  };
  for (const GrainSeed& s : solver.present()) {
    put(s.position);
    put(s.velocity);
    put(s.spin);
  }
  return all;
}

} // namespace

TEST_CASE("1, 2, 3 and 7 threads give the same bits") {
  for (const char* normal : {linear, R"({ law = "hertz", restitution = 0.8 })"}) {
    auto reference = slab(1, normal);
    reference->advance(3000);
    REQUIRE(reference->rebuilds() > 10);
    const std::string expected = bits(*reference);
    for (int threads : {2, 3, 7}) {
      auto solver = slab(threads, normal);
      solver->advance(3000);
      CHECK(bits(*solver) == expected);
    }
  }
  auto reference = slab(1, linear, true);
  reference->advance(3000);
  for (int threads : {2, 7}) {
    auto solver = slab(threads, linear, true);
    solver->advance(3000);
    CHECK(bits(*solver) == bits(*reference));
  }
}

TEST_CASE("save and load at any step goes on with the same bits") {
  const bool mixed = GENERATE(false, true);
  auto straight = slab(2, linear, mixed);
  straight->advance(3000);
  const std::string expected = bits(*straight);
  const double energy = straight->energies().total();
  for (int at : {1, 777, 1500}) {
    auto first = slab(2, linear, mixed);
    first->advance(at);
    const Solver::State state = first->save();
    auto second = slab(3, linear, mixed);
    second->load(state);
    second->advance(3000 - at);
    CHECK(bits(*second) == expected);
    CHECK(second->energies().total() == energy);
    CHECK(second->step() == 3000);
  }
}

TEST_CASE("a run that is loaded goes as fast as one that was not interrupted") {
  if (bestKernelWidth() == KernelWidth::plain) return; // has no loops of their own
  // A dashpot by its rate: a loop of its own only where all grains have the mass that the scene promises.
  SceneText text = slabText(linear, false);
  text.tangential = R"({ law = "spring", friction = 0.5, damping_rate = "100 1/s" })";
  text.rolling = SceneText().rolling;
  const auto first = filled(text, 1);
  first->advance(10);
  CHECK(first->hasOwnLoop());
  DemSolver second(text.scene(), SolverOptions{1});
  second.load(first->save());
  CHECK(second.hasOwnLoop());
}

TEST_CASE("a known scene gives the known bits") {
  // Changing these is a visible, explained edit: it means that every run of every user changes.
  const auto hash = [](const char* normal) {
    auto solver = slab(1, normal);
    solver->advance(1000);
    const std::string all = bits(*solver);
    return fmt::format("{:016x}", XXH3_64bits(all.data(), all.size()));
  };
  CHECK(hash(linear) == "5513eff0b8b0da09");
  CHECK(hash(R"({ law = "hertz", restitution = 0.8 })") == "c970b26f3cab1318");
}
