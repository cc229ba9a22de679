// The plain kernel is the oracle of the vector kernels: whole runs, bit for bit.

#include "sim/base/random.h"
#include "sim/grains/seeding.h"
#include "sim/solvers/dem/dem_solver.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

using namespace sandglass;

namespace {

/// Grains of species a (2 mm) and b fall on a floor of b's material in a periodic box.
Scene falling(const std::string& materials, const std::string& a, const std::string& b, double diameterOfB,
              const std::string& accuracy = "", const std::string& floor = "") {
  return parseScene(fmt::format(R"(
title = "falling"
gravity = ["1 m/s^2", "0", "-9.81 m/s^2"]
[domain]
lower = ["0", "0", "-1 mm"]
upper = ["12 mm", "12 mm", "60 mm"]
periodic = ["x", "y"]
{}
{}
[[species]]
name = "a"
material = "{}"
size = {{ distribution = "single", diameter = "2 mm" }}
[[species]]
name = "b"
material = "{}"
size = {{ distribution = "single", diameter = "{} mm" }}
[[wall]]
name = "floor"
kind = "plane"
material = "{}"
point = ["0", "0", "0"]
normal = [0, 0, 1]
[[fill]]
kind = "list"
grains = [{{ position = ["2 mm", "2 mm", "50 mm"], species = "a" }}]
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
)",
                                accuracy, materials, a, b, diameterOfB, floor.empty() ? b : floor),
                    "test");
}

/// Unequal grains of two materials: every path through the kernels. Laws have `#` for a number that differs
/// from one pair of materials to the next.
Scene mixture(const std::string& tangential, const std::string& rolling,
              const std::string& normal = R"({ law = "linear", stiffness = "400 N/m", restitution = 0.# })",
              bool ownFloor = false) {
  std::string materials = R"(
[[material]]
name = "light"
density = "1000 kg/m^3"
youngs_modulus = "5e6 Pa"
poisson_ratio = 0.3
[[material]]
name = "heavy"
density = "3000 kg/m^3"
youngs_modulus = "9e6 Pa"
poisson_ratio = 0.2
)";
  std::vector<const char*> pairs{R"("light", "light")", R"("light", "heavy")", R"("heavy", "heavy")"};
  if (ownFloor) {
    materials += "[[material]]\nname = \"floor\"\nyoungs_modulus = \"9e6 Pa\"\npoisson_ratio = 0.2\n";
    pairs.insert(pairs.end(), {R"("light", "floor")", R"("heavy", "floor")"});
  }
  char number = '4';
  for (const char* pair : pairs) {
    std::string laws =
        "normal = " + normal + "\ntangential = " + tangential + "\nrolling = " + rolling + "\n";
    std::replace(laws.begin(), laws.end(), '#', number++);
    materials += std::string("[[contact]]\nbetween = [") + pair + "]\n" + laws;
  }
  return falling(materials, "light", "heavy", 1.4, "", ownFloor ? "floor" : "heavy");
}

/// Grains of one material: what the loops of their own (fused_laws.h) are for.
Scene single(const std::string& normal, const std::string& tangential, double diameterOfB,
             const std::string& accuracy = "", const std::string& rolling = R"({ law = "none" })") {
  return falling(R"(
[[material]]
name = "glass"
density = "2000 kg/m^3"
youngs_modulus = "5e6 Pa"
poisson_ratio = 0.3
[[contact]]
between = ["glass", "glass"]
normal = )" + normal +
                     "\ntangential = " + tangential + "\nrolling = " + rolling,
                 "glass", "glass", diameterOfB, accuracy.empty() ? "" : "[accuracy]\n" + accuracy);
}

const std::string ratedLaw = R"({ law = "linear", stiffness = "400 N/m", damping_rate = "100 1/s" })";
const std::string linearLaw = R"({ law = "linear", stiffness = "400 N/m", restitution = 0.7 })",
                  hertzLaw = R"({ law = "hertz", restitution = 0.7 })";

std::vector<GrainSeed> seedsOf(const Scene& scene) {
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 500; ++k) {
    RandomStream random(3, RandomPurpose::test, k);
    GrainSeed s;
    s.id = k;
    s.species = k % 2;
    s.radius = 0.5 * scene.species[k % 2].size.parameters.number("diameter");
    s.position = 2.2e-3 * Vec3(k % 5 + 0.5, k / 5 % 5 + 0.5, k / 25 + 0.6);
    s.velocity = 0.3 * random.direction();
    s.spin = 50.0 * random.direction();
    seeds.push_back(s);
  }
  return seeds;
}

std::vector<GrainSeed> afterRun(const Scene& scene, const char* kernel, int steps = 4000) {
  setenv("SANDGLASS_KERNEL", kernel, 1);
  DemSolver solver(scene, {1});
  unsetenv("SANDGLASS_KERNEL");
  solver.add(seedsOf(scene));
  solver.advance(steps);
  return solver.present();
}

bool hasOwnLoop(const Scene& scene) {
  if (bestKernelWidth() == KernelWidth::plain) return true; // has none to find
  DemSolver solver(scene, {1});
  solver.add(seedsOf(scene));
  solver.advance(1);
  return solver.hasOwnLoop();
}

void compareKernels(const Scene& scene, int steps = 4000) {
  const auto expected = afterRun(scene, "plain", steps);
  for (const char* kernel : {"avx2", "avx512"}) { // a narrower processor takes its widest for the last
    CAPTURE(kernel);
    const auto found = afterRun(scene, kernel, steps);
    REQUIRE(found.size() == expected.size());
    int same = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      same += found[i].position == expected[i].position && found[i].velocity == expected[i].velocity &&
              found[i].spin == expected[i].spin;
    CHECK(same == static_cast<int>(expected.size()));
  }
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
  compareKernels(scene);
}

TEST_CASE("loops of their own give the plain kernel's bits over whole runs") {
  struct Case {
    std::string normal, tangential;
    double second;
  };
  const std::string spring = R"({ law = "spring", friction = 0.4)";
  const std::vector<Case> cases{{linearLaw, R"({ law = "none" })", 2},
                                {linearLaw, R"({ law = "none" })", 1.4},
                                {linearLaw, spring + " }", 2},
                                {linearLaw, spring + R"(, rotation = "project", arm = "radius" })", 2},
                                {linearLaw, spring + R"(, rotation = "project", arm = "radius" })", 1.4},
                                {ratedLaw, spring + R"(, rotation = "project", arm = "radius" })", 2},
                                {ratedLaw, spring + " }", 1.4},
                                {linearLaw, spring + ", damping_ratio = 0.5 }", 2},
                                {linearLaw, spring + " }", 1.4},
                                {linearLaw, spring + R"(, rotation = "project" })", 1.4},
                                {linearLaw, spring + R"(, damping_ratio = 0.5, arm = "radius" })", 1.4},
                                {hertzLaw, R"({ law = "mindlin", friction = 0.4 })", 2},
                                {hertzLaw, R"({ law = "mindlin", friction = 0.4 })", 1.4}};
  for (const Case& c : cases) {
    CAPTURE(c.normal, c.tangential, c.second);
    compareKernels(single(c.normal, c.tangential, c.second));
  }
}

TEST_CASE("loops with rolling resistance give the plain kernel's bits over whole runs") {
  const std::string spring = R"({ law = "spring", friction = 0.4)",
                    mindlin = R"({ law = "mindlin", friction = 0.4 })";
  const std::vector<std::pair<std::string, std::string>> below{
      {linearLaw, spring + " }"},
      {linearLaw, spring + R"(, damping_ratio = 0.5, arm = "radius" })"},
      {hertzLaw, mindlin}};
  const auto rolling = GENERATE(as<std::string>{}, R"({ law = "elastic_plastic", coefficient = 0.1 })",
                                R"({ law = "elastic_plastic", length = "0.03 mm", damping = 0.0 })",
                                R"({ law = "constant_torque", coefficient = 0.1 })",
                                R"({ law = "constant_torque", length = "0.03 mm" })");
  for (const auto& [normal, tangential] : below)
    for (const double second : {2.0, 1.4}) {
      CAPTURE(normal, tangential, second, rolling);
      const Scene scene = single(normal, tangential, second, "", rolling);
      CHECK(hasOwnLoop(scene));
      compareKernels(scene, 2000);
    }
}

TEST_CASE("loops for grains of several materials give the plain kernel's bits over whole runs") {
  const std::string none = R"({ law = "none" })", spring = R"({ law = "spring", friction = 0.#)",
                    linear = R"({ law = "linear", stiffness = "#00 N/m", restitution = 0.# })",
                    rate = R"({ law = "linear", stiffness = "#00 N/m", damping_rate = "#0 1/s" })",
                    hertz = R"({ law = "hertz", restitution = 0.# })",
                    mindlin = R"({ law = "mindlin", friction = 0.# })",
                    elastic = R"({ law = "elastic_plastic", coefficient = 0.#, damping = 0.# })",
                    constant = R"({ law = "constant_torque", length = "0.0# mm" })";
  const std::vector<std::array<std::string, 3>> cases{{linear, none, none},
                                                      {linear, spring + " }", none},
                                                      {rate, spring + ", damping_ratio = 0.# }", none},
                                                      {hertz, mindlin, none},
                                                      {linear, spring + R"(, arm = "radius" })", elastic},
                                                      {hertz, mindlin, elastic},
                                                      {rate, spring + " }", constant}};
  for (const auto& [normal, tangential, rolling] : cases)
    for (const bool ownFloor : {false, true}) { // then each pair of materials has one reduced mass
      CAPTURE(normal, tangential, rolling, ownFloor);
      const Scene scene = mixture(tangential, rolling, normal, ownFloor);
      CHECK(hasOwnLoop(scene));
      compareKernels(scene, 2000);
    }
}

TEST_CASE("mixed precision has the same bits at every width over whole runs") {
  const std::string spring = R"({ law = "spring", friction = 0.4)";
  const std::vector<std::tuple<std::string, std::string, double>> cases{
      {linearLaw, R"({ law = "none" })", 2},
      {linearLaw, spring + " }", 1.4},
      {linearLaw, spring + R"(, rotation = "project", arm = "radius" })", 2},
      {linearLaw, spring + ", damping_ratio = 0.5 }", 1.4},
      {linearLaw, spring + R"(, damping_rate = "100 1/s" })", 1.4},
      {hertzLaw, R"({ law = "none" })", 2},
      {hertzLaw, spring + R"(, rotation = "project", damping_ratio = 0.5 })", 2},
      {hertzLaw, R"({ law = "mindlin", friction = 0.4 })", 2}};
  for (const auto& [normal, tangential, second] : cases) {
    CAPTURE(normal, tangential, second);
    compareKernels(single(normal, tangential, second, "precision = \"mixed\""));
  }
}

TEST_CASE("fast arithmetic errs by some units in the last place") {
  // Two units in a distance of 2 mm are 1e-18 m; 400 N/m turn them into 4e-16 N, which a grain of 5 mg gets
  // as 1e-10 m/s^2: beside accelerations of several m/s^2 that is 1e-10 of them, with some contacts a grain.
  const std::string spring = R"({ law = "spring", friction = 0.4 })",
                    mindlin = R"({ law = "mindlin", friction = 0.4 })";
  for (const auto& [normal, tangential] : {std::pair{linearLaw, spring}, std::pair{hertzLaw, mindlin}}) {
    const Scene exact = single(normal, tangential, 2),
                fast = single(normal, tangential, 2, "arithmetic = \"fast\"");
    const double dt = DemSolver(exact, {1}).stepSize();
    const auto start = afterRun(exact, "avx512", static_cast<int>(0.15 / dt)); // they lie on the floor
    const auto after = [&](const Scene& scene) {
      DemSolver solver(scene, {1});
      solver.add(start);
      solver.advance(1);
      return solver.present();
    };
    const auto expected = after(exact), found = after(fast);
    REQUIRE(found.size() == expected.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
      worst = std::max(worst, (found[i].velocity - expected[i].velocity).norm() / dt);
    CAPTURE(worst);
    CHECK(worst < 1e-9);
    if (bestKernelWidth() == KernelWidth::avx512) CHECK(worst > 0.0); // else both are exact
  }
}
