// Adhesive contacts: the exact numbers of JKR (Johnson, Kendall, Roberts 1971) and DMT (1975), energy.

#include "tests/sim/physics/one_contact.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double W = 0.2, R = 0.5e-3;                    // J/m^2, m
constexpr double E = 20e6 / (2.0 * (1.0 - 0.25 * 0.25)); // Pa, effective modulus of the pair

SceneText adhesive(const std::string& law, double restitution = 1.0) {
  SceneText t;
  t.elasticity = "youngs_modulus = \"20 MPa\"\npoisson_ratio = 0.25";
  t.normal =
      fmt::format(R"({{ law = "{}", surface_energy = "{} J/m^2", restitution = {} }})", law, W, restitution);
  return t;
}

} // namespace

TEST_CASE("JKR: pull-off force 3/2 pi W R, torn at -3 a_t^2 / R with 5/9 of it") {
  const LawStack laws(adhesive("jkr").scene());
  const double at = std::cbrt(pi * W * R * R / (8 * E)), tear = 3 * at * at / R;
  CHECK(laws.range() == Approx(std::cbrt(2.0) * tear).epsilon(1e-6)); // at a wall: twice the radius
  OneContact c(laws);
  c.step(-0.5 * tear);
  CHECK(c.normal() == 0.0); // not yet touched
  c.step(1e-15);
  CHECK(c.normal() == Approx(-4.0 / 3.0 * pi * W * R).epsilon(1e-6)); // 8/9 of the pull-off force at once
  c.step(1e-6);
  double weakest = 0, last = 0;
  for (int k = 0; k <= 20000; ++k) {
    const double overlap = 1e-6 - (1e-6 + tear * (1 - 1e-9)) * k / 20000;
    c.step(overlap);
    weakest = std::min(weakest, c.normal());
    last = c.normal();
  }
  CHECK(-weakest == Approx(1.5 * pi * W * R).epsilon(1e-7));
  CHECK(-last == Approx(5.0 / 6.0 * pi * W * R).epsilon(1e-3));
  c.step(-tear * 1.0001);
  CHECK(c.normal() == 0.0);
  c.step(-0.5 * tear);
  CHECK(c.normal() == 0.0); // torn stays torn until touch
}

TEST_CASE("JKR: the contact radius at zero load is (9 pi W R^2 / 2 E)^(1/3), and force follows radius") {
  const LawStack laws(adhesive("jkr").scene());
  const double a0 = std::cbrt(9 * pi * W * R * R / (2 * E));
  OneContact c(laws);
  c.step(a0 * a0 / R - std::sqrt(2 * pi * W * a0 / E));
  CHECK(c.normal() == Approx(0.0).margin(1e-10 * pi * W * R));
  CHECK(c.b.stiffness[0] == Approx(2 * E * a0).epsilon(1e-12)); // which carries the radius
  for (const double share : {0.6, 1.0, 1.7, 4.0}) {
    const double a = share * a0, overlap = a * a / R - std::sqrt(2 * pi * W * a / E);
    OneContact d(laws);
    d.step(1e-9); // touched
    d.step(overlap);
    CHECK(d.normal() == Approx(4 * E * a * a * a / (3 * R) - std::sqrt(8 * pi * W * E * a * a * a))
                            .epsilon(1e-10)
                            .margin(1e-10 * pi * W * R));
  }
}

TEST_CASE("JKR: stored energy is the work of the force") {
  const LawStack laws(adhesive("jkr").scene());
  const double at = std::cbrt(pi * W * R * R / (8 * E)), tear = 3 * at * at / R;
  OneContact c(laws);
  c.step(2e-6);
  const double from = c.stored();
  double work = 0, before = c.normal();
  const int pieces = 20000;
  for (int k = 1; k <= pieces; ++k) {
    c.step(2e-6 - (2e-6 + 0.99 * tear) * k / pieces);
    work += 0.5 * (before + c.normal()) * (2e-6 + 0.99 * tear) / pieces;
    before = c.normal();
  }
  CHECK(from - c.stored() == Approx(work).epsilon(1e-6));
}

TEST_CASE("DMT: pull-off force 2 pi W R in contact, Hertz beyond it") {
  const LawStack laws(adhesive("dmt").scene());
  OneContact c(laws);
  c.step(1e-14);
  CHECK(c.normal() == Approx(-2 * pi * W * R).epsilon(1e-6));
  c.step(2e-6);
  CHECK(c.normal() ==
        Approx(4.0 / 3.0 * E * std::sqrt(R) * std::pow(2e-6, 1.5) - 2 * pi * W * R).epsilon(1e-12));
  CHECK(c.b.contactForce[0] == Approx(c.normal() + 2 * pi * W * R).epsilon(1e-12));
  c.step(-1e-9);
  CHECK(c.normal() == 0.0);
}

TEST_CASE("a slow grain sticks to another by JKR, a fast one leaves with the work of the neck missing") {
  // Loss of a JKR collision: stored energy at touch against that at the tear (Johnson, Pollock, J. Adhesion
  // Sci. Technol. 8, 1323 (1994): 7.09 (W^5 R^4 / E*^2)^(1/3)).
  const double loss = 7.09 * std::cbrt(std::pow(W, 5) * std::pow(R, 4) / (E * E));
  const double mass = 0.5 * 4.0 / 3.0 * pi * 1e-9 * 2500.0; // reduced
  const double sticking = std::sqrt(2 * loss / mass);
  SceneText t = adhesive("jkr");
  t.stepsPerContact = 400;
  for (const double share : {0.9, 1.5, 4.0}) {
    DemSolver solver(t.scene(), {1});
    const double v = 0.5 * share * sticking;
    solver.add({grain(0, {1.00001e-3, 0, 0}, {-v, 0, 0}), grain(1, {-1.00001e-3, 0, 0}, {v, 0, 0})});
    const double time = 40e-6 / v + 40 * 400 * solver.stepSize();
    solver.advance(std::lround(time / solver.stepSize()));
    const auto p = solver.present();
    const double gap = (p[0].position - p[1].position).norm() - 2e-3;
    INFO(share);
    if (share < 1) {
      CHECK(gap < 3 * std::pow(pi * W * R * R / (8 * E), 2.0 / 3.0) / R); // the neck holds
    } else {
      CHECK(gap > 0);
      const double left = mass * 0.5 * std::pow(p[0].velocity.x() - p[1].velocity.x(), 2);
      CHECK(mass * 0.5 * 4 * v * v - left == Approx(loss).epsilon(0.02));
    }
  }
}
