// What head-on collisions give back, integrated with the laws, against closed forms and expansions.

#include "sim/contact/head_on.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;
const double mass = 0.5 * 4.0 / 3.0 * pi * 1e-9 * 2500.0, radius = 0.5e-3; // reduced, of the usual grains
constexpr double modulus = 50e6 / (2.0 * (1.0 - 0.0625));

double restitution(const std::string& normal, double speed) {
  SceneText t;
  t.elasticity = "youngs_modulus = \"50 MPa\"\npoisson_ratio = 0.25";
  t.normal = normal;
  const LawStack laws(t.scene());
  return headOnRestitution(laws, 0, mass, radius, speed);
}

} // namespace

TEST_CASE("a linear dashpot by its rate gives exp(-rate t_c / 2), and what the clamp leaves") {
  // e = exp(-pi z / sqrt(1 - z^2)) free; exp(-z t) with tan-form t when cut at zero force (Schwager, Poeschel
  // 2007), z = rate / (2 omega).
  const double omega = std::sqrt(1000 / mass);
  for (const double z : {0.05, 0.2, 0.5}) {
    const double rate = 2 * z * omega, w = std::sqrt(1 - z * z);
    const auto law = [&](bool clamp) {
      return fmt::format(
          R"({{ law = "linear", stiffness = "1000 N/m", damping_rate = "{:.17g} 1/s", clamp_attraction = {} }})",
          rate, clamp);
    };
    CHECK(restitution(law(false), 0.1) == Approx(std::exp(-pi * z / w)).epsilon(2e-3));
    const double t = std::atan2(2 * z * w, 2 * z * z - 1) / w;
    CHECK(restitution(law(true), 0.1) == Approx(std::exp(-z * t)).epsilon(2e-3));
  }
}

TEST_CASE("collision_time with damping_rate takes that long") {
  SceneText t;
  t.normal = R"({ law = "linear", collision_time = "1 ms", damping_rate = "800 1/s" })";
  const LawStack laws(t.scene());
  CHECK(laws.entries()[0].law->collisionTime(0, mass, radius, 1.0) == Approx(1e-3).epsilon(1e-12));
}

TEST_CASE("Tsuji's restitution is the same at every speed, and higher once its attraction is cut off") {
  for (const double v : {0.01, 1.0}) {
    CHECK(restitution(R"({ law = "hertz", restitution = 0.6 })", v) == Approx(0.6).epsilon(3e-3));
    const double clamped = restitution(R"({ law = "hertz", restitution = 0.6, clamp_attraction = true })", v);
    CHECK(clamped > 0.62);
    CHECK(clamped < 0.8);
  }
}

TEST_CASE("a viscoelastic sphere's restitution follows the expansion in its speed, in both conventions") {
  // Schwager, Poeschel, PRE 57, 650 (1998); Ramirez, Poeschel, Brilliantov, Schwager, PRE 60, 4465 (1999):
  // e = 1 - C1 x + C2 x^2 - C3 x^3 + C4 x^4, x = 3/2 A (rho/m)^(2/5) v^(1/5), with no attraction left in.
  const double rho = 4.0 / 3.0 * modulus * std::sqrt(radius);
  const double C1 =
      std::tgamma(0.6) * std::sqrt(pi) / (std::pow(2, 0.2) * std::pow(5, 0.4) * std::tgamma(2.1));
  CHECK(C1 == Approx(1.15344).epsilon(1e-5));
  const double C2 = 0.6 * C1 * C1;
  for (const double v : {0.01, 0.1, 1.0}) {
    const double A = 2e-6, x = 1.5 * A * std::pow(rho / mass, 0.4) * std::pow(v, 0.2);
    const double expected = 1 - C1 * x + C2 * x * x; // the next term is -0.48 x^3
    REQUIRE(x < 0.1);
    INFO("x " << x);
    const double e = restitution(fmt::format(R"({{ law = "hertz", dissipation_time = "{} s" }})", A), v);
    CHECK(1 - e == Approx(1 - expected).margin(0.6 * x * x * x + 2e-4));
    CHECK(1 - e > 0.9 * C1 * x * (1 - C2 / C1 * x));
    const double same = restitution(
        fmt::format(
            R"({{ law = "hertz", dissipation_time = "{} s", dissipation_convention = "kuwabara_kono" }})",
            1.5 * A),
        v);
    CHECK(same == Approx(e).epsilon(1e-12));
  }
}

TEST_CASE("a Hertzian dashpot by rate: force over rate is m sqrt(R d) v") {
  SceneText t;
  t.elasticity = "youngs_modulus = \"50 MPa\"\npoisson_ratio = 0.25";
  t.normal = "{ law = \"hertz\", damping_rate = \"3e5 1/(m*s)\" }";
  const LawStack laws(t.scene());
  ContactBlock b{};
  b.size = 1;
  b.overlap[0] = 1e-5;
  b.effectiveRadius[0] = radius;
  b.effectiveMass[0] = mass;
  b.vn[0] = -0.2;
  laws.apply(b, false);
  CHECK(b.normalForce[0] == Approx(4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(1e-5, 1.5) +
                                   3e5 * mass * std::sqrt(radius * 1e-5) * 0.2)
                                .epsilon(1e-12));
}

TEST_CASE("the report of a scene names the restitution with and without the clamp") {
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", damping_rate = "2000 1/s" })";
  const auto lines = restitutionReport(t.scene(), 0.1);
  REQUIRE(lines.size() == 2);
  CHECK_THAT(lines[0], Catch::Contains("glass on glass") && Catch::Contains("attraction cut off"));
  CHECK_THAT(lines[1], Catch::Contains("glass on wall"));
}

TEST_CASE("the report says what the step of a run makes of restitution, as the solver does") {
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.1 })";
  const LawStack laws(t.scene());
  for (const double share : {0.125, 0.04, 0.004}) { // of a collision
    const double step = share * laws.entries()[0].law->collisionTime(0, mass, radius, 0.2);
    const auto [least, most] = restitutionAtStep(laws, 0, mass, radius, 0.2, step);
    CAPTURE(share, least, most);
    SceneText run = t;
    run.stepsPerContact = 1.0 / share;
    for (const double phase : {0.1, 0.4, 0.8}) { // two grains in the program itself
      DemSolver solver(run.scene(), {1});
      const double gap = 0.1 * solver.stepSize() * (3 + phase);
      solver.add({grain(0, {1e-3 + gap, 0, 0}, {-0.1, 0, 0}), grain(1, {-1e-3 - gap, 0, 0}, {0.1, 0, 0})});
      solver.advance(static_cast<int>(40.0 / share));
      const double e = solver.present()[0].velocity.x() / 0.1;
      CHECK(e ==
            Approx(headOnRestitution(laws, 0, mass, radius, 0.2, solver.stepSize(), phase)).margin(1e-9));
      CHECK(e > least - 0.01 * (most - least) - 0.1 * share);
      CHECK(e < most + 0.01 * (most - least) + 0.1 * share);
    }
    CHECK(std::max(most - 0.1, 0.1 - least) > 0.5 * 0.02 * share / 0.04); // first order
  }
  const auto coarse = restitutionReport(t.scene(), 0.2, 0.2 * 2.3e-4),
             none = restitutionReport(t.scene(), 0.2);
  CHECK_THAT(coarse[0], Catch::Contains("with the step of this scene") && Catch::Contains("a smaller step"));
  CHECK_THAT(none[0], !Catch::Contains("with the step"));
}
