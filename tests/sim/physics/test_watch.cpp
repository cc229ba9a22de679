// The solver refuses or stops with a sentence; it never goes on with a wrong answer.

#include "sim/base/error.h"
#include "sim/solvers/dem/step_rule.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

TEST_CASE("a time step above the stable limit is refused") {
  SceneText t;
  t.stepsPerContact = 50;
  Scene scene = t.scene();
  const double collision = DemSolver(scene).stepSize() * 50;
  scene.accuracy.timeStep = collision / 4.9;
  CHECK_THROWS_WITH(DemSolver(scene), Catch::Contains("above the stable limit"));
  scene.accuracy.timeStep = collision / 5.1;
  CHECK_NOTHROW(DemSolver(scene));
  CHECK_THAT(chooseStep(scene, LawStack(scene)).rule,
             Catch::StartsWith("given by time_step, whatever level and steps_per_contact say: 5.1 steps"));
}

TEST_CASE("a collision that takes no time, or for ever, is refused with its pair") {
  const auto refusal = [](const std::string& normal, double density, double diameter) {
    SceneText t;
    t.normal = normal;
    t.elasticity = "youngs_modulus = \"1e7 Pa\"\npoisson_ratio = 0.3";
    Scene scene = t.scene();
    for (Material& m : scene.materials)
      m.density = density;
    for (Species& s : scene.species)
      s.size.parameters.set("diameter", diameter);
    try {
      DemSolver solver(scene);
    } catch (const InputError& e) {
      return e.sentences().front();
    }
    return std::string();
  };
  const auto expect = [](const std::string& said, const std::string& time) {
    CHECK_THAT(said, Catch::Contains("a collision of glass on glass takes " + time + " s") &&
                         Catch::Contains("no time step follows; check the diameters, the density"));
  };
  const std::string hertz = R"({ law = "hertz", restitution = 0.9 })",
                    linear = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.9 })";
  CHECK(refusal(hertz, 2500, 2e-3).empty());
  expect(refusal(linear, 2500, 1e-300), "0");
  expect(refusal(linear, 1e-323, 2e-3), "0");
  expect(refusal(hertz, 1e300, 2e-3), "inf");
  expect(refusal(R"({ law = "linear", collision_time = "1e-300 s", restitution = 0.9 })", 2500, 2e-3), "0");
}

TEST_CASE(
    "just below the stable limit a dense lattice at rest stays bounded, beyond the estimate it does not") {
  // Why the limit is where it is: a block of touching grains with friction, stirred a little, in a periodic
  // box.
  const auto grows = [](double stepsPerContact) {
    SceneText t;
    t.lower = R"(["0 m", "0 m", "0 m"])";
    t.upper = R"(["8 mm", "8 mm", "8 mm"])";
    t.periodic = R"(["x", "y", "z"])";
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
    t.tangential = R"({ law = "spring", friction = 10.0 })";
    Scene scene = t.scene();
    const double collision = DemSolver(scene).stepSize() * 50;
    scene.accuracy.maximumOverlap = 1e9;
    scene.accuracy.timeStep = collision / 50; // built with a legal step; then run with the one in question
    DemSolver solver(scene, {1});
    solver.overrideStep(collision / stepsPerContact);
    std::vector<GrainSeed> seeds; // fcc, twelve contacts each, 2 % overlap
    const double a = 8e-3 / 3, r = 0.5 * a / std::sqrt(2.0) * 1.02;
    int id = 0;
    for (int k = 0; k < 27; ++k)
      for (const Vec3& basis : {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)}) {
        const Vec3 cell(k % 3, k / 3 % 3, k / 9);
        const double wiggle = 1e-7 * ((id * 37) % 11 - 5);
        seeds.push_back(grain(id++, a * (cell + basis) + Vec3(wiggle, -wiggle, 0.5 * wiggle), Vec3::Zero(),
                              Vec3::Zero(), r));
      }
    solver.add(seeds);
    try {
      solver.advance(400);
    } catch (const RunError&) {
      return true;
    }
    const Energies e = solver.energies();
    return !(e.translational + e.rotational < 1e-7); // the wiggle itself carries 1e-8 J
  };
  CHECK_FALSE(grows(5.05));
  CHECK_FALSE(grows(4.0));
  CHECK(grows(3.5)); // the estimate in step_rule.h says t_c / 3.9
}

TEST_CASE("deep overlap, runaway speed, escape and not-a-number stop the run with a sentence") {
  SceneText t;
  t.maximumOverlap = 0.1;
  {
    DemSolver solver(t.scene(), {2});
    solver.add({grain(7, {0.9e-3, 0, 0}), grain(3, {-0.9e-3, 0, 0})}); // 0.2 mm of 1 mm
    CHECK_THROWS_WITH(solver.advance(1), Catch::Contains("grain 3 and grain 7 overlap by 20 %"));
  }
  {
    DemSolver solver(t.scene(), {2});
    solver.add({grain(5, {0, 0, 0}, {1e4, 0, 0})});
    CHECK_THROWS_WITH(solver.advance(1),
                      Catch::Contains("grain 5 moves") && Catch::Contains("lower time_step"));
  }
  {
    DemSolver solver(t.scene(), {2});
    solver.add({grain(5, {0.99, 0, 0}, {1, 0, 0})});
    CHECK_THROWS_WITH(solver.advance(100000), Catch::Contains("grain 5 left the domain: x"));
  }
  {
    DemSolver solver(t.scene(), {2});
    solver.add(
        {grain(5, {0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}), grain(6, {0.1, 0, 0})});
    CHECK_THROWS_WITH(solver.advance(1), Catch::Contains("grain 5 is not a number"));
  }
  // Through a box wall a grain would come out on the other side; a plane pushes it back from any depth.
  t.maximumOverlap = 3;
  const auto fall = [&](const std::string& wall) {
    t.walls = "[[wall]]\nname = \"floor\"\nmaterial = \"wall\"\n" + wall;
    DemSolver solver(t.scene(), {1});
    solver.add({grain(5, {0, 0, 1.1e-3}, {0, 0, -20})});
    while (solver.present()[0].position.z() > -5e-3 && solver.present()[0].velocity.z() < 0)
      solver.advance(1);
    return solver.present()[0].velocity.z();
  };
  CHECK(fall("kind = \"plane\"\npoint = [\"0 m\", \"0 m\", \"0 m\"]\nnormal = [0, 0, 1]\n") > 0);
  CHECK_THROWS_WITH(fall("kind = \"box\"\nlower = [\"-5 mm\", \"-5 mm\", \"0 m\"]\n"
                         "upper = [\"5 mm\", \"5 mm\", \"10 mm\"]\n"),
                    Catch::Contains("overlaps the wall 'floor' by more than 90 %"));
}

TEST_CASE("a fast listed grain shortens the step of a Hertzian scene") {
  SceneText t;
  t.elasticity = "youngs_modulus = \"50 MPa\"\npoisson_ratio = 0.25";
  t.normal = R"({ law = "hertz", restitution = 0.8 })";
  Scene slow = t.scene(), fast = slow;
  fast.fills.at(0).how.parameters.set("velocities", std::vector<Vec3>{Vec3(20, 0, 0)});
  // Collision time goes with speed^(-1/5); two grains may meet at twice 20 m/s instead of 1 mm/s.
  CHECK(DemSolver(fast).stepSize() == Approx(DemSolver(slow).stepSize() * std::pow(1e-3 / 40.0, 0.2)));
}

TEST_CASE("a dashpot or friction faster than the collision shortens the step, and no energy comes of it") {
  SceneText t;
  t.elasticity = "youngs_modulus = \"50 MPa\"\npoisson_ratio = 0.25";
  t.stepsPerContact = 10;
  SECTION("a viscoelastic dissipation time") {
    t.normal = R"({ law = "hertz", dissipation_time = "1 ms" })";
  }
  SECTION("a Hertzian dashpot by its rate") {
    t.normal = "{ law = \"hertz\", damping_rate = \"1e10 1/(m*s)\" }";
  }
  SECTION("incremental friction with a stiffness of its own") {
    t.tangential = R"({ law = "walton", friction = 0.5, stiffness = "1e7 N/m" })";
    // Ten steps in 2 pi sqrt(2/7 m / K0), m the reduced mass.
    CHECK(DemSolver(t.scene()).stepSize() == Approx(0.1 *
                                                    std::sqrt(2.0 / 7.0 * 0.5 * 2500.0 * 1e-9 / 1e7 * 4.0 /
                                                              3.0 * std::pow(std::numbers::pi, 3)) *
                                                    2.0));
  }
  const auto meet = [&](double stepsPerContact) {
    t.stepsPerContact = stepsPerContact;
    const Scene scene = t.scene();
    DemSolver solver(scene, {1});
    solver.add({grain(0, {-1e-3, 0, 0}, {0.1, 0.05, 0}, {0, 0, 100}),
                grain(1, {1.00001e-3, 0, 0}, {-0.1, 0, 0}, {50, 0, 0})});
    const double before = solver.energies().total();
    solver.advance(std::llround(2e-4 / solver.stepSize()));
    const Energies after = solver.energies();
    CHECK(after.total() < before);
    return after;
  };
  const Energies coarse = meet(10), fine = meet(200);
  CHECK(coarse.rotational == Approx(fine.rotational).epsilon(0.01));
  CHECK(coarse.total() == Approx(fine.total()).epsilon(0.01));
}
