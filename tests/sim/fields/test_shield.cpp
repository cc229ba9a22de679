// who shields whom, by hand and by brute force.
#include "sim/base/random.h"
#include "sim/fields/shield_counts.h"
#include "tests/sim/fields/vortex_case.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

std::vector<Vec3> forces(const std::vector<Vec3>& places) {
  VortexCase setup;
  setup.timeStep = 1e-12; // velocities half a step before count
  setup.fields = R"toml(
[[field]]
name = "up"
kind = "wind"
velocity = ["0", "0", "8 m/s"]
[[field]]
name = "lift"
kind = "drag"
law = "linear"
linear_coefficient = "1.55e-4 kg/(m*s)"
[[field]]
name = "shield"
kind = "shield"
ratio = 0.5
)toml";
  Scene scene = setup.scene();
  scene.output.quantities = {"force"};
  DemSolver solver(scene);
  std::vector<GrainSeed> seeds;
  for (std::size_t k = 0; k < places.size(); ++k)
    seeds.push_back(setup.bead(static_cast<std::int64_t>(k), places[k]));
  solver.add(seeds);
  solver.advance(0);
  return solver.frame()->vector(quantity::force);
}

} // namespace

TEST_CASE("a stack of four feels 1, 1/2, 1/4 and 1/8", "[fields]") {
  const auto f = forces({Vec3(0, 0, 0.3), Vec3(0, 0, 0), Vec3(0, 0, 0.1), Vec3(0, 0, 0.2)});
  const double alone = forces({Vec3(0, 0, 0)})[0].z();
  CHECK(alone > 0);
  CHECK(f[1].z() == Approx(alone).epsilon(1e-12));
  CHECK(f[2].z() == Approx(alone / 2).epsilon(1e-12));
  CHECK(f[3].z() == Approx(alone / 4).epsilon(1e-12));
  CHECK(f[0].z() == Approx(alone / 8).epsilon(1e-12));
}

TEST_CASE("a shield ends two radii aside, and nobody above shields", "[fields]") {
  const double d = 12e-3, alone = forces({Vec3(0, 0, 0)})[0].z();
  const auto upper = [&](double dx, double dy) {
    return forces({Vec3(0, 0, 0), Vec3(dx, dy, 0.1)})[1].z() / alone;
  };
  CHECK(upper(d * (1 - 1e-12), 0) == Approx(0.5).epsilon(1e-12));
  CHECK(upper(d * (1 + 1e-12), 0) == Approx(1).epsilon(1e-12));
  CHECK(upper(0, -d * (1 - 1e-12)) == Approx(0.5).epsilon(1e-12));
  CHECK(upper(0, -d * (1 + 1e-12)) == Approx(1).epsilon(1e-12));
  CHECK(upper(0.99 * d, 0.99 * d) == Approx(0.5).epsilon(1e-12)); // squares, not discs
  CHECK(forces({Vec3(0, 0, 0), Vec3(0, 0, 0.1)})[0].z() == Approx(alone).epsilon(1e-12));
}

TEST_CASE("shield counts are those of all pairs, with any number of threads and while grains move",
          "[fields]") {
  for (const int threads : {1, 3}) {
    Parallel parallel(threads);
    GrainStore grains;
    grains.keep(false, false);
    const int n = 700;
    grains.resize(n);
    RandomStream random(7, RandomPurpose::test, 1);
    for (int i = 0; i < n; ++i) {
      grains.place[i] = {random.uniform(-0.06, 0.06), random.uniform(-0.06, 0.06), random.uniform(-0.2, 0.3),
                         random.uniform(1e-3, 4e-3)};
      grains.listed[i] = {grains.place[i].x, grains.place[i].y, grains.place[i].z, random.uniform(0, 2e-3)};
    }
    ShieldCounts counts;
    counts.list(grains, parallel);
    for (int round = 0; round < 5; ++round) {
      counts.count(grains, parallel);
      for (int i = 0; i < n; ++i) {
        int expected = 0;
        const Quad p = grains.place[i];
        for (int j = 0; j < n; ++j) {
          const Quad q = grains.place[j];
          expected +=
              j != i && std::abs(p.x - q.x) < p.w + q.w && std::abs(p.y - q.y) < p.w + q.w && q.z < p.z;
        }
        REQUIRE(counts.of(i) == expected);
      }
      for (int i = 0; i < n; ++i) { // anywhere they may go before they are listed anew
        const Vec3 away = random.direction() * grains.listed[i].w * random.uniform(0, 1);
        const Quad l = grains.listed[i];
        grains.place[i] = {l.x + away.x(), l.y + away.y(), l.z + away.z(), grains.place[i].w};
      }
    }
    CHECK(counts.doubts() > 0);
    CHECK(counts.doubts() < static_cast<std::size_t>(n) * 60); // and not all pairs are asked
  }
}
