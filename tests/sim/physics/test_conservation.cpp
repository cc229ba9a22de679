// What must not change: energy without damping, momentum and angular momentum in free pair motion.

#include "sim/base/random.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::testing;

TEST_CASE("an undamped box of 50 spheres keeps its energy over 1e5 steps") {
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  t.walls = "[[wall]]\nname = \"box\"\nkind = \"box\"\nmaterial = \"wall\"\nlower = [\"-6 mm\", \"-6 mm\", "
            "\"-6 mm\"]\nupper = [\"6 mm\", "
            "\"6 mm\", \"6 mm\"]\n";
  t.stepsPerContact = 50;
  DemSolver solver(t.scene(), {1});
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 50; ++k) {
    RandomStream random(7, RandomPurpose::test, k);
    const Vec3 place(-4e-3 + 2.5e-3 * (k % 4), -4e-3 + 2.5e-3 * (k / 4 % 4), -4e-3 + 2.5e-3 * (k / 16));
    seeds.push_back(grain(k, place, 0.2 * random.direction()));
  }
  solver.add(seeds);
  const double start = solver.energies().total();
  double worst = 0.0;
  for (int k = 0; k < 100; ++k) {
    solver.advance(1000);
    worst = std::max(worst, std::abs(solver.energies().total() - start) / start);
  }
  CHECK(worst < 1e-3);
}

TEST_CASE("momentum and angular momentum of a free cluster are kept to round-off") {
  for (const char* rolling : {R"({ law = "none" })", R"({ law = "elastic_plastic", coefficient = 0.2 })"}) {
    SceneText t;
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.6 })";
    t.tangential = R"({ law = "spring", friction = 0.4, damping_ratio = 0.3 })";
    t.rolling = rolling;
    t.firstDiameter = ", diameter = \"2 mm\"";
    t.species = "[[species]]\nname = \"bead\"\nmaterial = \"glass\"\nsize = { distribution = \"uniform\", "
                "smallest = \"1.2 mm\", largest = \"2 mm\" }\n";
    DemSolver solver(t.scene(), {2});
    std::vector<GrainSeed> seeds;
    for (int k = 0; k < 30; ++k) {
      RandomStream random(11, RandomPurpose::test, k);
      // A shrinking, spinning ball of grains of unequal size.
      const Vec3 place = 2.1e-3 * Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1.5);
      seeds.push_back(grain(k, place, -40.0 * place + 0.05 * random.direction(), 50.0 * random.direction(),
                            0.6e-3 + 0.4e-3 * random.uniform()));
    }
    solver.add(seeds);
    const auto sums = [&](Vec3& p, Vec3& l, double& scaleP, double& scaleL) {
      p = l = Vec3::Zero();
      scaleP = scaleL = 0.0;
      for (const GrainSeed& s : solver.present()) {
        const double m = 4.0 / 3.0 * M_PI * std::pow(s.radius, 3) * 2500.0, I = 0.4 * m * s.radius * s.radius;
        p += m * s.velocity;
        const Vec3 one = s.position.cross(m * s.velocity) + I * s.spin;
        l += one;
        scaleP += m * s.velocity.norm();
        scaleL += one.norm();
      }
    };
    Vec3 p0, l0, p1, l1;
    double sp, sl, sp1, sl1;
    sums(p0, l0, sp, sl);
    const double energy = solver.energies().total();
    solver.advance(20000);
    sums(p1, l1, sp1, sl1);
    CHECK(solver.energies().total() < 0.8 * energy); // they did collide
    CHECK((p1 - p0).norm() < 1e-12 * sp);
    CHECK((l1 - l0).norm() < 1e-10 * sl);
  }
}
