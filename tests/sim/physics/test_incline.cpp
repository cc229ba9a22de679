// A sphere on a plane: sliding into rolling, rolling and sliding down a slope, resting on it. Exact answers
// of rigid-body mechanics; the contact's finite stiffness enters below the tolerances.

#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double g = 9.81, radius = 1e-3;

/// Plane z = 0 with gravity tilted by `slope` towards +x; the sphere starts at its resting overlap.
std::unique_ptr<DemSolver> onSlope(double slope, double friction, double rollingCoefficient,
                                   const Vec3& velocity) {
  SceneText t;
  t.gravity = fmt::format(R"(["{} m/s^2", "0", "{} m/s^2"])", g * std::sin(slope), -g * std::cos(slope));
  t.lower = R"(["-10 m", "-1 m", "-1 m"])";
  t.upper = R"(["10 m", "1 m", "1 m"])";
  t.tangential = fmt::format(
      R"({{ law = "spring", friction = {}, stiffness_ratio = 0.2857, damping_ratio = 0.5 }})", friction);
  if (rollingCoefficient > 0.0)
    t.rolling = fmt::format(R"({{ law = "elastic_plastic", coefficient = {} }})", rollingCoefficient);
  t.walls = "[[wall]]\nname = \"slope\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
            "\"0 m\"]\nnormal = [0, 0, 1]\n";
  auto solver = std::make_unique<DemSolver>(t.scene(), SolverOptions{1});
  const double mass = 4.0 / 3.0 * std::numbers::pi * 1e-9 * 2500.0;
  solver->add({grain(0, {0, 0, radius - mass * g * std::cos(slope) / 1000.0}, velocity)});
  return solver;
}

void runFor(DemSolver& solver, double seconds) {
  solver.advance(static_cast<std::int64_t>(std::round(seconds / solver.stepSize())));
}

} // namespace

TEST_CASE("a sliding sphere ends rolling at 5/7 of its speed") {
  const double v0 = 0.1;
  const auto solver = onSlope(0.0, 0.3, 0.0, {v0, 0, 0});
  runFor(*solver, 2.0 * v0 / (7.0 * 0.3 * g) * 4.0); // rolling sets in at 2 v0 / (7 mu g)
  const GrainSeed s = solver->present()[0];
  CHECK(s.velocity.x() == Approx(5.0 / 7.0 * v0).epsilon(1e-3));
  CHECK(s.spin.y() * radius == Approx(5.0 / 7.0 * v0).epsilon(1e-3));
  CHECK(std::abs(s.velocity.y()) < 1e-12);
}

TEST_CASE("a sphere rolls down a slope with 5/7 g sin while friction can hold it, else slides") {
  const double mu = 0.2;
  for (const double slope : {0.1, 0.3, 0.55, 0.65, 0.9}) { // tan = 3.5 mu = 0.7 at 0.6107
    const auto solver = onSlope(slope, mu, 0.0, Vec3::Zero());
    runFor(*solver, 0.02);
    const double t0 = solver->time(), v0 = solver->present()[0].velocity.x();
    runFor(*solver, 0.1);
    const double a = (solver->present()[0].velocity.x() - v0) / (solver->time() - t0);
    const bool rolls = std::tan(slope) <= 3.5 * mu;
    const double expected =
        rolls ? 5.0 / 7.0 * g * std::sin(slope) : g * (std::sin(slope) - mu * std::cos(slope));
    INFO("slope " << slope << (rolls ? " rolls" : " slides"));
    CHECK(a == Approx(expected).epsilon(5e-3));
  }
}

TEST_CASE("rolling friction holds a sphere while tan(slope) < mu_r, and not above") {
  const double rolling = 0.1;
  const auto rests = onSlope(std::atan(0.09), 0.5, rolling, Vec3::Zero());
  runFor(*rests, 0.5);
  CHECK(rests->present()[0].velocity.norm() < 1e-6);
  CHECK(std::abs(rests->present()[0].position.x()) < 0.1 * radius);
  const auto rolls = onSlope(std::atan(0.12), 0.5, rolling, Vec3::Zero());
  runFor(*rolls, 0.5);
  // Above the limit the couple is mu_r R N: a = 5/7 g (sin - mu_r cos).
  const double slope = std::atan(0.12);
  const double v = rolls->present()[0].velocity.x();
  CHECK(v == Approx(5.0 / 7.0 * g * (std::sin(slope) - rolling * std::cos(slope)) * 0.5).epsilon(0.05));
}
