// The plain kernel is the oracle of the vector kernels: whole runs, bit for bit.

#include "sim/base/random.h"
#include "sim/grains/seeding.h"
#include "sim/solvers/dem/dem_solver.h"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace sandglass;

namespace {

/// Unequal grains of two materials fall on a floor in a periodic box: every path through the kernels.
Scene mixture(const std::string& tangential, const std::string& rolling) {
  return parseScene(
      R"(
title = "mixture"
gravity = ["1 m/s^2", "0", "-9.81 m/s^2"]
[domain]
lower = ["0", "0", "-1 mm"]
upper = ["12 mm", "12 mm", "60 mm"]
periodic = ["x", "y"]
[[material]]
name = "light"
density = "1000 kg/m^3"
[[material]]
name = "heavy"
density = "3000 kg/m^3"
)" +
          [&] {
            std::string contacts;
            for (const char* pair : {R"("light", "light")", R"("light", "heavy")", R"("heavy", "heavy")"})
              contacts += std::string("[[contact]]\nbetween = [") + pair + "]\n" +
                          R"(normal = { law = "linear", stiffness = "400 N/m", restitution = 0.7 })" +
                          "\ntangential = " + tangential + "\nrolling = " + rolling + "\n";
            return contacts;
          }() +
          R"(
[[species]]
name = "a"
material = "light"
size = { distribution = "single", diameter = "2 mm" }
[[species]]
name = "b"
material = "heavy"
size = { distribution = "single", diameter = "1.4 mm" }
[[wall]]
name = "floor"
kind = "plane"
material = "heavy"
point = ["0", "0", "0"]
normal = [0, 0, 1]
[[fill]]
kind = "list"
grains = [{ position = ["2 mm", "2 mm", "50 mm"], species = "a" }]
[[stage]]
name = "run"
until = { duration = "1 s" }
)",
      "test");
}

std::vector<GrainSeed> afterRun(const Scene& scene, const char* kernel) {
  setenv("SANDGLASS_KERNEL", kernel, 1);
  DemSolver solver(scene, {1});
  unsetenv("SANDGLASS_KERNEL");
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 500; ++k) {
    RandomStream random(3, RandomPurpose::test, k);
    GrainSeed s;
    s.id = k;
    s.species = k % 2;
    s.radius = k % 2 ? 0.7e-3 : 1e-3;
    s.position = 2.2e-3 * Vec3(k % 5 + 0.5, k / 5 % 5 + 0.5, k / 25 + 0.6);
    s.velocity = 0.3 * random.direction();
    s.spin = 50.0 * random.direction();
    seeds.push_back(s);
  }
  solver.add(seeds);
  solver.advance(4000);
  return solver.present();
}

} // namespace

TEST_CASE("vector kernels give the plain kernel's bits over whole runs") {
  const auto [tangential, rolling] = GENERATE(table<std::string, std::string>(
      {{R"({ law = "none" })", R"({ law = "none" })"},
       {R"({ law = "spring", friction = 0.4 })", R"({ law = "none" })"},
       {R"({ law = "spring", friction = 0.4, arm = "radius", damping_ratio = 0.5 })", R"({ law = "none" })"},
       {R"({ law = "spring", friction = 0.4 })", R"({ law = "elastic_plastic", coefficient = 0.1 })"}}));
  CAPTURE(tangential, rolling);
  const Scene scene = mixture(tangential, rolling);
  const auto expected = afterRun(scene, "plain");
  for (const char* kernel : {"avx2", "avx512"}) { // a narrower processor takes its widest for the last
    const auto found = afterRun(scene, kernel);
    REQUIRE(found.size() == expected.size());
    int same = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      same += found[i].position == expected[i].position && found[i].velocity == expected[i].velocity &&
              found[i].spin == expected[i].spin;
    CHECK(same == static_cast<int>(expected.size()));
  }
}
