// Sizes of 1:50 in one scene cost about what the fine grains cost alone: no search over all pairs, no lists
// that coarse grains make long.

#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/contact/pair_search.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

/// Distance tests of one search over n grains of radius 1 and n / 50000 of radius 50, a given number of fine
/// ones to a volume.
double distanceTests(int n) {
  const double side = 3.0 * std::cbrt(static_cast<double>(n));
  const Domain domain{Vec3(0, 0, 0), Vec3(side, side, side), {true, true, false}};
  GrainStore store;
  store.imaged = true;
  store.resize(n);
  for (int i = 0; i < n; ++i) {
    RandomStream random(31, RandomPurpose::test, i);
    store.place[i] = {random.uniform(0, side), random.uniform(0, side), random.uniform(0, side),
                      i % 50000 == 0 ? 50.0 : 1.0};
    store.motion[i].w = 1.0;
    store.id[i] = i;
  }
  Parallel parallel(2);
  CellGrid grid;
  AlignedVector<Quad> scratch;
  grid.sort(store, domain, 0.0, parallel, {}, scratch);
  store.reorder(grid.order(), parallel, scratch);
  GrainColumns columns;
  columns.grains = n;
  const ImageCodes codes(domain, 2.0 * grid.largestReach());
  const PairSearch search(grid, codes, columns, KernelWidth::plain);
  CHECK(grid.levels().size() > 1);
  return static_cast<double>(search.distanceTests());
}

} // namespace

TEST_CASE("sizes of 1:50 are searched in a time that grows with the number of grains, not its square") {
  const double few = distanceTests(100000), many = distanceTests(800000);
  CHECK(many / few == Approx(8.0).epsilon(0.15)); // 64 if each were held against each
  CHECK(many < 20 * 800000.0);
}

TEST_CASE("a coarse grain beside a fine bed does not make the lists of the fine ones longer") {
  // Touching fine grains, 2 mm, in a periodic block; 100 mm is the other species, of which one lies beyond.
  const auto listed = [](bool coarse) {
    SceneText t;
    t.lower = R"(["0", "0", "0"])";
    t.upper = R"(["0.2 m", "0.2 m", "0.3 m"])";
    t.periodic = R"(["x", "y"])";
    if (coarse)
      t.species += "[[species]]\nname = \"rock\"\nmaterial = \"glass\"\nsize = { distribution = \"single\", "
                   "diameter = \"100 mm\" }\n";
    DemSolver solver(t.scene(), {1});
    std::vector<GrainSeed> seeds;
    for (int k = 0; k < 8000; ++k)
      seeds.push_back(grain(k, 1.999e-3 * Vec3(k % 20 + 5, k / 20 % 20 + 5, k / 400 + 5)));
    if (coarse) {
      seeds.push_back(grain(8000, {0.1, 0.1, 0.2}, Vec3::Zero(), Vec3::Zero(), 0.05));
      seeds.back().species = 1;
    }
    solver.add(seeds);
    solver.advance(1);
    return static_cast<double>(solver.pairsListed());
  };
  CHECK(listed(true) == Approx(listed(false)).epsilon(0.02));
}
