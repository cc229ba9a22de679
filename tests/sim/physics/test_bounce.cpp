// One bounce: restitution, duration, convergence. Expected numbers are the law's own closed forms
// (Schaefer, Dippel, Wolf 1996; Antypov, Elliott 2011).

#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

struct Bounce {
  double restitution = 0, duration = 0;
};

/// Two grains head on at speed v each, or one against a plane.
Bounce bounce(const SceneText& text, double v, bool wall, double gap = 1e-6) {
  SceneText t = text;
  if (wall)
    t.walls = "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
              "\"0 m\"]\nnormal = "
              "[1, 0, 0]\n";
  DemSolver solver(t.scene(), {1});
  if (wall)
    solver.add({grain(0, {1e-3 + gap, 0, 0}, {-v, 0, 0})});
  else
    solver.add({grain(0, {1e-3 + gap, 0, 0}, {-v, 0, 0}), grain(1, {-1e-3 - gap, 0, 0}, {v, 0, 0})});
  Bounce b;
  std::int64_t touching = 0;
  for (int k = 0; k < 100000; ++k) {
    solver.advance(1);
    const auto p = solver.present();
    const double overlap = wall ? 1e-3 - p[0].position.x() : 2e-3 - (p[0].position.x() - p[1].position.x());
    if (overlap > 0) ++touching;
    if (overlap <= 0 && touching > 0) {
      b.restitution = p[0].velocity.x() / v;
      break;
    }
  }
  b.duration = static_cast<double>(touching) * solver.stepSize();
  return b;
}

std::string linear(double e, bool clamp = false) {
  return fmt::format(
      R"({{ law = "linear", stiffness = "1000 N/m", restitution = {}, clamp_attraction = {} }})", e, clamp);
}

} // namespace

TEST_CASE("a linear contact gives back the restitution asked for, at 50 steps per contact") {
  for (const bool wall : {false, true})
    for (const double e : {1.0, 0.95, 0.9}) {
      SceneText t;
      t.normal = linear(e);
      CHECK(bounce(t, 0.1, wall).restitution == Approx(e).epsilon(0.01));
    }
  SceneText t;
  t.normal = linear(0.4);
  CHECK(bounce(t, 0.1, false).restitution == Approx(0.4).epsilon(0.03));
  CHECK(bounce(t, 0.1, true).restitution == Approx(0.4).epsilon(0.03));
}

TEST_CASE("restitution converges with the step") {
  double before = 1.0;
  for (const double steps : {25.0, 100.0, 400.0, 1600.0}) {
    SceneText t;
    t.normal = linear(0.4);
    t.stepsPerContact = steps;
    const double error = std::abs(bounce(t, 0.1, false).restitution - 0.4) / 0.4;
    CHECK(error < 0.7 * before); // first order, with the jitter of the last step of a contact
    before = error;
  }
  CHECK(before < 1e-3);
}

TEST_CASE("what steps per contact cost: the documented error of one bounce, wherever between steps the touch "
          "falls") {
  // docs/performance.md, the row of accuracy.steps_per_contact.
  const std::string latching = R"({ law = "walton_braun", stiffness = "1000 N/m", restitution = 0.9 })",
                    hertz = R"({ law = "hertz", restitution = 0.9 })";
  const auto worst = [&](const std::string& normal, double e, double steps) {
    SceneText t;
    t.elasticity = "youngs_modulus = \"50 MPa\"\npoisson_ratio = 0.25";
    t.normal = normal;
    // Without a filling in motion the step of a Hertzian scene is that of an impact at 1 mm/s.
    t.stepsPerContact = steps * (normal == hertz ? std::pow(0.2 / 1e-3, 0.2) : 1.0);
    const double way = 0.1 * DemSolver(t.scene()).stepSize();
    double most = 0.0;
    for (int k = 0; k < 16; ++k)
      most =
          std::max(most, std::abs(bounce(t, 0.1, false, (3 + (k + 0.5) / 16) * way).restitution / e - 1.0));
    return most;
  };
  // Forces that begin at zero.
  for (const auto& [normal, e] : {std::pair{linear(1.0), 1.0}, {latching, 0.9}, {hertz, 0.9}}) {
    CAPTURE(normal);
    const double coarse = worst(normal, e, 25), fine = worst(normal, e, 100);
    CHECK(coarse < 0.003);
    CHECK(fine < 0.5e-3);
    CHECK(coarse > 4 * fine);
  }
  // A linear dashpot begins with a blow: first order.
  for (const auto& [e, share] : {std::pair{0.9, 0.01}, {0.5, 0.04}}) {
    CAPTURE(e);
    const double coarse = worst(linear(e), e, 25), fine = worst(linear(e), e, 100);
    CHECK(coarse < share);
    CHECK(fine < 0.4 * coarse);
    CHECK(fine > 0.1 * coarse);
  }
}

TEST_CASE("with the attraction cut off, the matched dashpot still gives the restitution asked for") {
  for (const double e : {0.9, 0.6, 0.3}) {
    SceneText t;
    t.normal = linear(e, true);
    t.stepsPerContact = 400;
    // The grains part with the springs still loaded by up to the dashpot's share, so the last bit of motion
    // is measured at zero overlap, after free flight.
    CHECK(bounce(t, 0.1, false).restitution == Approx(e).epsilon(0.01));
  }
}

TEST_CASE("a collision lasts pi / sqrt(k/m - (gamma/2m)^2)") {
  const double mass = 4.0 / 3.0 * std::numbers::pi * 1e-9 * 2500.0;
  for (const double e : {0.9, 0.4}) {
    SceneText t;
    t.normal = linear(e);
    t.stepsPerContact = 500;
    const double l = std::log(e);
    const double pi = std::numbers::pi;
    for (const bool wall : {false, true}) {
      const double m = wall ? mass : 0.5 * mass;
      // omega0^2 = k/m, zeta^2 = l^2 / (pi^2 + l^2)
      const double expected = pi / std::sqrt(1000.0 / m * (1.0 - l * l / (pi * pi + l * l)));
      CHECK(bounce(t, 0.1, wall).duration == Approx(expected).epsilon(0.005));
    }
  }
}

TEST_CASE("collision_time sets the stiffness so that the mean pair takes that long") {
  SceneText t;
  t.normal = R"({ law = "linear", collision_time = "5.23e-4 s", restitution = 0.94 })";
  t.stepsPerContact = 500;
  const Bounce b = bounce(t, 0.2, false);
  CHECK(b.duration == Approx(5.23e-4).epsilon(0.005));
  CHECK(b.restitution == Approx(0.94).epsilon(0.002));
}

TEST_CASE("a Hertzian contact has the same restitution at every speed, and Hertz's duration") {
  SceneText t;
  t.elasticity = "youngs_modulus = \"50 MPa\"\npoisson_ratio = 0.25";
  t.normal = R"({ law = "hertz", restitution = 0.8 })";
  t.stepsPerContact = 1000; // of the fastest impact that the scene can have
  for (const double v : {0.05, 0.5})
    CHECK(bounce(t, v, false).restitution == Approx(0.8).epsilon(0.01));
  t.normal = R"({ law = "hertz", restitution = 1.0 })";
  const double m = 0.5 * 4.0 / 3.0 * std::numbers::pi * 1e-9 * 2500.0, R = 0.5e-3, v = 0.5 * 2;
  const double E = 50e6 / (2.0 * (1.0 - 0.0625));
  // Maximum overlap (15 m v^2 / (16 sqrt(R) E))^(2/5); duration 2.9432655 times that over v.
  const double deepest = std::pow(15.0 * m * v * v / (16.0 * std::sqrt(R) * E), 0.4);
  CHECK(bounce(t, 0.5, false).duration == Approx(2.9432655 * deepest / v).epsilon(0.01));
}
