// The knob accuracy.stiffness_scale: what it must leave alone, and the error that it makes. Collision time
// and greatest overlap of one impact follow from energy: linear springs k^(-1/2) both, Hertz k^(-2/5) both.

#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

struct Impact {
  double step = 0, restitution = 0, overlap = 0;
};

Impact impact(const SceneText& text, double scale) {
  Scene scene = text.scene();
  scene.accuracy.stiffnessScale = scale;
  DemSolver solver(scene, {1});
  solver.add({grain(0, {1.001e-3, 0, 0}, {-0.1, 0, 0}), grain(1, {-1.001e-3, 0, 0}, {0.1, 0, 0})});
  Impact found;
  found.step = solver.stepSize();
  for (int k = 0; k < 100000; ++k) {
    solver.advance(1);
    const auto p = solver.present();
    const double overlap = 2e-3 - (p[0].position.x() - p[1].position.x());
    found.overlap = std::max(found.overlap, overlap);
    if (overlap <= 0 && found.overlap > 0) {
      found.restitution = p[0].velocity.x() / 0.1;
      break;
    }
  }
  return found;
}

} // namespace

TEST_CASE("softer contacts keep restitution, and steps and overlaps grow as the knob says") {
  struct Expected {
    const char* normal;
    double power;
  };
  const auto expected =
      GENERATE(Expected{R"({ law = "linear", stiffness = "4000 N/m", restitution = 0.8 })", 0.5},
               Expected{R"({ law = "linear", collision_time = "1e-4 s", restitution = 0.8 })", 0.5},
               Expected{R"({ law = "linear", stiffness = "4000 N/m", damping_rate = "2000 s^-1" })", 0.5},
               Expected{R"({ law = "walton_braun", stiffness = "4000 N/m", restitution = 0.8 })", 0.5},
               Expected{R"({ law = "hertz", restitution = 0.8 })", 0.4});
  CAPTURE(expected.normal);
  SceneText text;
  text.normal = expected.normal;
  text.stepsPerContact = 200;
  text.elasticity = "youngs_modulus = \"1e7 Pa\"\npoisson_ratio = 0.3";
  const Impact stiff = impact(text, 1.0), soft = impact(text, 0.0625);
  const double ratio = std::pow(16.0, expected.power);
  CHECK(soft.step / stiff.step == Approx(ratio).epsilon(1e-6));
  CHECK(soft.overlap / stiff.overlap == Approx(ratio).epsilon(1e-3));
  CHECK(soft.restitution == Approx(stiff.restitution).epsilon(3e-3));
}

TEST_CASE("a softer bed sinks by its weight over the stiffness") {
  // The documented error at rest: overlap m g / k under one grain.
  SceneText text;
  text.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  text.walls =
      "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
      "\"0 m\"]\nnormal = [0, 0, 1]\n";
  text.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.3 })";
  const double mass = 2500 * 4.0 / 3.0 * 3.14159265358979 * 1e-9;
  for (const double scale : {1.0, 0.1}) {
    Scene scene = text.scene();
    scene.accuracy.stiffnessScale = scale;
    DemSolver solver(scene, {1});
    solver.add({grain(0, {0, 0, 1e-3})});
    solver.advance(20000);
    CHECK(1e-3 - solver.present()[0].position.z() == Approx(mass * 9.81 / (1000 * scale)).epsilon(1e-6));
  }
}
