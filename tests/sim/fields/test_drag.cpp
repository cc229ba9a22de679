// One grain in a fluid, against formulas.
#include "sim/fields/field.h"
#include "sim/fields/field_registry.h"
#include "tests/sim/fields/vortex_case.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

std::string dragTable(const std::string& rest) {
  return "[[field]]\nname = \"air\"\nkind = \"drag\"\n" + rest + "\n";
}

const std::string linear = "linear_coefficient = \"1.55e-4 kg/(m*s)\"\n",
                  quadratic = "quadratic_coefficient = \"0.22 kg/m^3\"\n";

Vec3 forceOn(const VortexCase& setup, const Vec3& velocity) {
  Scene scene = setup.scene();
  scene.output.quantities = {"force"};
  DemSolver solver(scene);
  solver.add({setup.bead(0, Vec3(0.01, 0.02, 0.03), velocity)});
  solver.advance(0);
  return solver.frame()->vector(quantity::force)[0];
}

Parameters defaultsOf(const std::string& kind, std::map<std::string, ParameterValue> values) {
  Parameters p;
  for (const ParameterSpec& spec : findField(kind)->parameters)
    if (spec.fallback) p.set(spec.name, *spec.fallback);
  for (auto& [name, value] : values)
    p.set(name, value);
  return p;
}

/// Velocity of a flow at a place and time.
Vec3 flowAt(const std::string& kind, const Parameters& p, const Vec3& place, double time = 0) {
  FieldBlock b{};
  b.size = 1;
  b.time = time;
  for (int i = 0; i < FieldBlock::capacity; ++i) {
    b.x[i] = place.x();
    b.y[i] = place.y();
    b.z[i] = place.z();
  }
  findField(kind)->make(p)->apply(b, 1.0);
  return {b.flowX[0], b.flowY[0], b.flowZ[0]};
}

} // namespace

// m v' = -c1 v - c2 v^2.
TEST_CASE("a grain in still air slows down as its law of drag says", "[fields]") {
  VortexCase setup;
  setup.radius = 2e-3;
  setup.density = 20; // light, so that the drag does much within a second
  setup.timeStep = 1e-4;
  const double D = 4e-3, m = setup.mass(), c1 = perDiameter * D, c2 = perSquare * D * D, v0 = 3, t = 1;
  const auto speed = [&](const std::string& table) {
    setup.fields = dragTable(table);
    return after(setup, {setup.bead(0, Vec3::Zero(), Vec3(v0, 0, 0))}, t)[0].velocity.x();
  };
  CHECK(speed("law = \"linear\"\n" + linear) == Approx(v0 * std::exp(-c1 * t / m)).epsilon(1e-3));
  CHECK(speed("law = \"quadratic\"\n" + quadratic) == Approx(v0 / (1 + t * c2 * v0 / m)).epsilon(1e-3));
  CHECK(speed("law = \"both\"\n" + linear + quadratic) ==
        Approx(c1 / c2 / ((1 + c1 / (c2 * v0)) * std::exp(c1 * t / m) - 1)).epsilon(1e-3));
  // The same coefficients from the properties of the fluid.
  const double viscosity = perDiameter / (3 * std::numbers::pi),
               fluid = perSquare * 8 / (0.47 * std::numbers::pi);
  CHECK(speed(fmt::format("law = \"both\"\nviscosity = \"{} Pa*s\"\nquadratic_coefficient = \"0.22 kg/m^3\"",
                          viscosity)) ==
        Approx(speed("law = \"both\"\n" + linear + quadratic)).epsilon(1e-12));
  CHECK(speed(fmt::format("law = \"quadratic\"\ndensity = \"{} kg/m^3\"", fluid)) ==
        Approx(speed("law = \"quadratic\"\n" + quadratic)).epsilon(1e-12));
}

// The correction 1 + 0.15 Re^0.687 and Newton's 0.44, at Reynolds numbers on both sides of 1000.
TEST_CASE("Schiller and Naumann's drag by hand", "[fields]") {
  VortexCase setup;
  const double eta = 1.8e-5, rho = 1.2, D = 2 * setup.radius;
  setup.fields = dragTable(
      fmt::format("law = \"schiller_naumann\"\nviscosity = \"{} Pa*s\"\ndensity = \"{} kg/m^3\"", eta, rho));
  for (const double re : {0.01, 1.0, 100.0, 999.0}) {
    const double v = re * eta / (rho * D);
    CHECK(-forceOn(setup, Vec3(v, 0, 0)).x() ==
          Approx(3 * std::numbers::pi * eta * D * v * (1 + 0.15 * std::pow(re, 0.687))).epsilon(1e-6));
  }
  const double v = 3000 * eta / (rho * D);
  CHECK(-forceOn(setup, Vec3(0, 0, v)).z() ==
        Approx(0.44 * 0.5 * rho * std::numbers::pi / 4 * D * D * v * v).epsilon(1e-6));
}

// the quotient of the two parts is 1419 v D (0.22 / 1.55e-4 = 1419.35).
TEST_CASE("quadratic over linear drag at the speeds of the thesis", "[fields]") {
  for (const auto& [r, v, expected] : {std::tuple{2e-3, 1.188, 6.74},
                                       {2e-3, 4.101, 23.3},
                                       {2e-3, 5.901, 33.5},
                                       {6e-3, 1.143, 19.5},
                                       {6e-3, 3.316, 56.5},
                                       {6e-3, 5.881, 100.2}}) {
    VortexCase setup;
    setup.radius = r;
    setup.fields = dragTable("law = \"quadratic\"\n" + quadratic);
    const double square = -forceOn(setup, Vec3(v, 0, 0)).x();
    setup.fields = dragTable("law = \"linear\"\n" + linear);
    const double plain = -forceOn(setup, Vec3(v, 0, 0)).x();
    CHECK(square / plain == Approx(0.22 / 1.55e-4 * v * 2 * r).epsilon(1e-6));
    CHECK(square / plain == Approx(expected).epsilon(5e-3)); // three digits are given
  }
}

// and the negative case: speeds taken component by component are anisotropic.
TEST_CASE("drag is the same in all directions, unless it is told to be wrong", "[fields]") {
  VortexCase setup;
  setup.timeStep = 1e-9; // so that forces are those at the velocity given
  const auto strength = [&](const std::string& more, double angle) {
    setup.fields = dragTable("law = \"quadratic\"\n" + quadratic + more);
    return forceOn(setup, 2.0 * Vec3(std::cos(angle), std::sin(angle), 0)).norm();
  };
  const double straight = strength("", 0);
  for (double angle = 0.1; angle < 6; angle += 0.37)
    CHECK(strength("", angle) == Approx(straight).epsilon(1e-12));
  CHECK(strength("speed = \"componentwise\"\n", std::numbers::pi / 4) ==
        Approx(straight / std::sqrt(2.0)).epsilon(1e-9));
  // Across and along the axis: what does not count is left alone.
  const Vec3 v(1, 2, 3);
  setup.fields = dragTable("law = \"linear\"\nacts = \"across\"\n" + linear);
  const Vec3 across = forceOn(setup, v);
  setup.fields = dragTable("law = \"linear\"\nacts = \"along\"\n" + linear);
  const Vec3 along = forceOn(setup, v);
  CHECK(across.z() == Approx(0).margin(1e-18));
  CHECK(std::hypot(along.x(), along.y()) == Approx(0).margin(1e-18));
  setup.fields = dragTable("law = \"linear\"\n" + linear);
  CHECK((across + along - forceOn(setup, v)).norm() < 1e-9 * along.norm());
}

// lift 100 (c1 v + c2 v^2) exp(-beta (z - z0)) against the weight.
TEST_CASE("a lone grain hovers and swings in the wind as computed", "[fields]") {
  VortexCase setup;
  setup.gravity = thesisGravity;
  setup.timeStep = 1e-4;
  const double beta = 25, z0 = -0.2 / 1.5, wind = 8;
  setup.fields =
      "[[field]]\nname = \"up\"\nkind = \"wind\"\nvelocity = [\"0\", \"0\", \"8 m/s\"]\n" +
      dragTable("law = \"both\"\nacts = \"along\"\nstrength = 100\ndecay = \"25 1/m\"\nreference = "
                "\"-0.13333333333333333 m\"\n" +
                linear + quadratic);
  // Heights computed apart, for the true mass (2, 3, 4, 5, 6 mm).
  const double heights[] = {-0.0554, -0.0719, -0.0836, -0.0926, -0.1000};
  for (int k = 0; k < 5; ++k) {
    setup.radius = (2 + k) * 1e-3;
    const double D = 2 * setup.radius, c1 = perDiameter * D, c2 = perSquare * D * D;
    const double rest =
        z0 + std::log(100 * (c1 * wind + c2 * wind * wind) / (setup.mass() * thesisGravity)) / beta;
    CHECK(rest == Approx(heights[k]).margin(6e-5));
    CHECK(after(setup, {setup.bead(0, Vec3(0.01, 0, rest + 0.01))}, 12.0)[0].position.z() ==
          Approx(rest).margin(2e-4));
  }
  // Small swings: damping rate of the velocity, and the period 2 pi / sqrt(beta g - gamma^2 / 4).
  const double D = 2 * setup.radius, c1 = perDiameter * D, c2 = perSquare * D * D;
  const double gamma = thesisGravity * (c1 + 2 * c2 * wind) / (c1 * wind + c2 * wind * wind);
  CHECK(gamma == Approx(2.43).epsilon(5e-3));
  const double rest = heights[4],
               period = 2 * std::numbers::pi / std::sqrt(beta * thesisGravity - gamma * gamma / 4);
  CHECK(period == Approx(0.4026).epsilon(2e-3));
  DemSolver solver(setup.scene());
  const double level =
      z0 + std::log(100 * (c1 * wind + c2 * wind * wind) / (setup.mass() * thesisGravity)) / beta;
  CHECK(level == Approx(rest).margin(6e-5));
  solver.add({setup.bead(0, Vec3(0, 0, level + 5e-4))});
  std::vector<double> crossings, tops;
  double before = 5e-4, older = 5e-4;
  for (int step = 0; step < 20000; ++step) {
    solver.advance(1);
    const double now = solver.present()[0].position.z() - level;
    if (before > 0 && now <= 0) crossings.push_back((step + before / (before - now)) * setup.timeStep);
    if (before > older && before >= now) tops.push_back(before);
    older = before;
    before = now;
  }
  REQUIRE(crossings.size() >= 4);
  REQUIRE(tops.size() >= 3);
  CHECK((crossings[3] - crossings[0]) / 3 == Approx(period).epsilon(0.01));
  CHECK(tops[2] / tops[0] == Approx(std::exp(-gamma * period)).epsilon(0.01));
}

// and with steps that a plain first-order decay would not survive.
TEST_CASE("a spinning grain is slowed by the fluid, however small it is", "[fields]") {
  VortexCase setup;
  setup.friction = R"({ law = "rice", slip_rate = "0 1/s", friction = 0 })"; // so that grains turn
  setup.timeStep = 1e-4;
  setup.fields = "[[field]]\nname = \"spin\"\nkind = \"spin_drag\"\ncoefficient = \"6e-8 N*m*s\"\n";
  const double rates[] = {149.2, 19.65, 4.663, 1.528, 0.614}; // computed apart, for 0.75 of the mass
  for (int k = 0; k < 5; ++k) {
    setup.radius = (2 + k) * 1e-3;
    setup.density = 7500;
    const double rate = 6e-8 / setup.inertia();
    CHECK(rate == Approx(rates[k]).epsilon(2e-3));
    const double t = 2e-2;
    const double spin =
        after(setup, {setup.bead(0, Vec3::Zero(), Vec3::Zero(), Vec3(0, 100, 0))}, t)[0].spin.y();
    // The start is half a step back by a velocity Verlet kick, the rest is exact.
    CHECK(spin ==
          Approx(100 * std::exp(-rate * t)).epsilon(rate * setup.timeStep * rate * setup.timeStep + 1e-9));
  }
  setup.radius = 0.2e-3; // the decay rate is 1.5e7 / s: a plain step would multiply spins by -1500
  const double spin =
      after(setup, {setup.bead(0, Vec3::Zero(), Vec3::Zero(), Vec3(0, 100, 0))}, 1e-2)[0].spin.y();
  CHECK(std::abs(spin) < 1e-9);
  // Stokes: 8 pi eta r^3 over 2/5 m r^2.
  setup.radius = 1e-3;
  setup.density = 10;
  setup.timeStep = 5e-5;
  setup.fields = "[[field]]\nname = \"spin\"\nkind = \"spin_drag\"\nviscosity = \"1e-4 Pa*s\"\n";
  const double rate = 8 * std::numbers::pi * 1e-4 * 1e-9 / setup.inertia();
  CHECK(after(setup, {setup.bead(0, Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, 5))}, 0.01)[0].spin.z() ==
        Approx(5 * std::exp(-rate * 0.01)).epsilon(1e-4));
}

TEST_CASE("a mote in a thick fluid falls at the speed at which forces balance", "[fields]") {
  VortexCase setup;
  setup.radius = 1e-4;
  setup.gravity = thesisGravity;
  setup.youngsModulus = 10; // nobody is there to be touched
  setup.timeStep = 1e-3;    // hundreds of relaxation times
  setup.fields = dragTable("law = \"linear\"\nviscosity = \"10 Pa*s\"\n");
  const double terminal = setup.mass() * thesisGravity / (6 * std::numbers::pi * 10 * setup.radius);
  CHECK(setup.mass() / (6 * std::numbers::pi * 10 * setup.radius) < 1e-2 * setup.timeStep);
  CHECK(-after(setup, {setup.bead(0, Vec3::Zero())}, 0.1)[0].velocity.z() == Approx(terminal).epsilon(1e-6));
}

TEST_CASE("vortices and winds by their formulas", "[fields]") {
  const Vec3 point(0.1, 0, 0), place(0.1, 0.3, 0.7);
  const double w = 5;
  CHECK((flowAt("solid_body_vortex",
                defaultsOf("solid_body_vortex", {{"point", point}, {"angular_velocity", w}}), place) -
         Vec3(-w * 0.3, 0, 0))
            .norm() < 1e-15);
  const Parameters rankine = defaultsOf("rankine_vortex", {{"angular_velocity", w}, {"core_radius", 0.1}});
  CHECK(flowAt("rankine_vortex", rankine, Vec3(0.05, 0, 0)).y() == Approx(w * 0.05));
  CHECK(flowAt("rankine_vortex", rankine, Vec3(0.4, 0, 0)).y() == Approx(w * 0.01 / 0.4));
  const Parameters lamb = defaultsOf(
      "lamb_oseen_vortex", {{"circulation", 2.0}, {"core_radius", 0.1}, {"kinematic_viscosity", 1e-3}});
  for (const double r : {1e-6, 1e-3, 0.01, 0.1, 0.5})
    for (const double t : {0.0, 3.0}) {
      const double a2 = 0.01 + 4e-3 * t;
      CHECK(flowAt("lamb_oseen_vortex", lamb, Vec3(0, r, 0), t).x() ==
            Approx(2.0 / (2 * std::numbers::pi * r) * std::expm1(-r * r / a2)).epsilon(1e-11));
    }
  const Parameters wind =
      defaultsOf("wind", {{"velocity", Vec3(0, 0, 8)}, {"decay", 25.0}, {"reference", -0.1}});
  CHECK(flowAt("wind", wind, Vec3(1, 1, 0.02)).z() == Approx(8 * std::exp(-25 * 0.12)).epsilon(1e-13));
}
