// Cones, straight and oblique, and discs: distances against brute force, and the mirror of a bounce.

#include "sim/base/random.h"
#include "tests/sim/physics/bench_scenes.h"
#include "tests/sim/physics/wall_harness.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;

double nearestOf(const WallShape& wall, const Vec3& x) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto t = touchesOf(wall, x, 100.0);
  for (int k = 0; k < t.count; ++k)
    nearest = std::min(nearest, t.at[k].distance);
  return nearest;
}

} // namespace

TEST_CASE("V12: the distance to a cone's wall agrees with brute force to 1e-12") {
  // Roy's cone: half angle 30 degrees, wall radius (7 - z) tan 30 with z downwards, here turned upside down.
  const double angle = pi / 6, height = 7.0;
  const auto cone = makeWall("cone", {{"apex", Vec3(0, 0, 0)}, {"half_angle", angle}, {"height", height}});
  for (int k = 0; k < 40; ++k) {
    RandomStream random(1, RandomPurpose::test, k);
    const double z = 1.0 + 5.0 * random.uniform(), rho = z * std::tan(angle) * std::sqrt(random.uniform()),
                 phi = 2 * pi * k / 40.0;
    const Vec3 x(rho * std::cos(phi), rho * std::sin(phi), z);
    // Brute force: over all heights and azimuths of the surface.
    const double brute = smallest(
        [&](double s) {
          const double r = s * std::tan(angle);
          return smallest([&](double p) { return (Vec3(r * std::cos(p), r * std::sin(p), s) - x).norm(); },
                          phi - 0.5, phi + 0.5, 20);
        },
        0.0, height, 60);
    CHECK(std::abs(nearestOf(*cone, x) - brute) < 1e-12);
    // The source's closed form: PB = (R(z) - rho) cos(angle).
    CHECK(std::abs(nearestOf(*cone, x) - (z * std::tan(angle) - rho) * std::cos(angle)) < 1e-12);
  }
}

TEST_CASE(
    "V12: a sphere leaves a cone's wall as light a mirror, in half a period of its spring, at any azimuth") {
  // 30 degrees, K = 1000 N/m, m = 0.1 kg, radius 5 cm: contact time pi sqrt(m/K) = 0.0314 s. Slow enough that
  // the overlap v sqrt(m/K) stays under 1 % of the radius.
  const double angle = pi / 6, K = 1000.0, m = 0.1, R = 0.05, v = 0.045;
  const double density = m / (4.0 / 3.0 * pi * R * R * R);
  for (const double azimuth : {0.0, 37.0, 90.0, 123.0, 180.0, 251.0, 301.0}) {
    SceneText t;
    t.lower = R"(["-9 m", "-9 m", "-1 m"])";
    t.upper = R"(["9 m", "9 m", "9 m"])";
    t.species =
        "[[species]]\nname = \"bead\"\nmaterial = \"glass\"\nsize = { distribution = \"single\", diameter = "
        "\"10 cm\" }\n";
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1 })";
    t.stepsPerContact = 1000;
    t.walls =
        "[[wall]]\nname = \"cone\"\nkind = \"cone\"\nmaterial = \"wall\"\napex = [\"0\", \"0\", \"0\"]\n"
        "half_angle = \"30 deg\"\nheight = \"7 m\"\n";
    std::string text = t.text();
    text.replace(text.find("\"2500 kg/m^3\""), 13, fmt::format("\"{:.17g} kg/m^3\"", density));
    text.replace(text.find("[\"2 mm\", \"2 mm\", \"2 mm\"]"), 24, "[\"0\", \"0\", \"5 m\"]");
    DemSolver solver(parseScene(text, "cone"), {1});
    const double phi = azimuth * pi / 180;
    const Vec3 radial(std::cos(phi), std::sin(phi), 0), around(-std::sin(phi), std::cos(phi), 0);
    const Vec3 n = -std::cos(angle) * radial + std::sin(angle) * Vec3::UnitZ(); // into the cone
    const Vec3 down = -std::sin(angle) * radial - std::cos(angle) * Vec3::UnitZ();
    const Vec3 wallPoint = 4.0 * (std::tan(angle) * radial + Vec3::UnitZ());
    const Vec3 in = v * (-n + 0.3 * around + 0.5 * down);
    solver.add({grain(0, wallPoint + (R + 1e-6) * n, in, Vec3::Zero(), R)});
    int touching = 0;
    while (solver.time() < 0.06) {
      solver.advance(1);
      touching += solver.walls()[0].force.norm() > 0 ? 1 : 0;
    }
    const Vec3 out = solver.present()[0].velocity;
    CHECK((out - (in - 2 * in.dot(n) * n)).norm() < 0.005 * v);
    CHECK(std::abs((out - in).dot(down)) < 1e-3 * v); // along the wall nothing happens but its curvature
    CHECK(touching * solver.stepSize() == Approx(pi * std::sqrt(m / K)).epsilon(0.002));
  }
}

TEST_CASE("V13: a sphere at rest on a floor sinks in by mg/K, and springs back from it unhurt") {
  // K = 1000 N/m, m = 0.1 kg: 9.8e-4 m at 9.8 m/s^2.
  const double K = 1000.0, R = 0.05;
  SceneText t;
  t.gravity = R"(["0", "0", "-9.8 m/s^2"])";
  t.species =
      "[[species]]\nname = \"bead\"\nmaterial = \"glass\"\nsize = { distribution = \"single\", diameter = "
      "\"10 cm\" }\n";
  t.walls =
      "[[wall]]\nname = \"floor\"\nkind = \"disc\"\nmaterial = \"wall\"\ncentre = [\"0\", \"0\", \"0\"]\n"
      "radius = \"50 cm\"\n";
  for (const bool damped : {true, false}) {
    t.normal =
        fmt::format(R"({{ law = "linear", stiffness = "1000 N/m", restitution = {} }})", damped ? 0.2 : 1);
    std::string text = t.text();
    text.replace(text.find("\"2500 kg/m^3\""), 13,
                 fmt::format("\"{:.17g} kg/m^3\"", 0.1 / (4.0 / 3.0 * pi * R * R * R)));
    text.replace(text.find("[\"2 mm\", \"2 mm\", \"2 mm\"]"), 24, "[\"0\", \"0\", \"50 cm\"]");
    DemSolver solver(parseScene(text, "floor"), {1});
    solver.add({grain(0, {0.1, 0.2, R + (damped ? 0.0 : 0.01)}, Vec3::Zero(), Vec3::Zero(), R)});
    if (damped) {
      solver.advance(static_cast<std::int64_t>(2.0 / solver.stepSize()));
      CHECK(R - solver.present()[0].position.z() == Approx(0.1 * 9.8 / K).epsilon(1e-3));
      continue;
    }
    double highest = 0; // of the bounce after the first
    bool fell = false;
    while (solver.time() < 0.25) {
      solver.advance(1);
      const double z = solver.present()[0].position.z();
      fell = fell || z < R;
      if (fell && z > R) highest = std::max(highest, z);
    }
    CHECK(highest == Approx(R + 0.01).epsilon(1e-4));
  }
}

TEST_CASE("the distance to an oblique cone agrees with brute force to 1e-12") {
  // A hopper with its outlet under the rim: the axis leans by half the difference of the diameters.
  const double low = 0.02, high = 0.1, height = 0.15;
  const Vec3 offset(0.05, -0.06, 0);
  const auto cone = makeWall("oblique_cone", {{"base", Vec3(0.01, 0.02, 0.03)},
                                              {"lower_radius", low},
                                              {"upper_radius", high},
                                              {"height", height},
                                              {"offset", offset}});
  for (int k = 0; k < 60; ++k) {
    RandomStream random(2, RandomPurpose::test, k);
    const double s = -0.1 + 1.2 * random.uniform(), phi = 2 * pi * random.uniform(),
                 share = 0.3 + 0.9 * random.uniform(); // also from outside
    const auto surface = [&](double along, double angle, double part) {
      return Vec3(Vec3(0.01, 0.02, 0.03) + along * (height * Vec3::UnitZ() + offset) +
                  part * (low + along * (high - low)) * Vec3(std::cos(angle), std::sin(angle), 0));
    };
    const Vec3 x = surface(s, phi, share);
    const double brute = smallest(
        [&](double along) {
          return smallest([&](double angle) { return (surface(along, angle, 1.0) - x).norm(); }, phi - pi,
                          phi + pi, 40);
        },
        0.0, 1.0, 60);
    CAPTURE(k, s, phi, share);
    CHECK(std::abs(nearestOf(*cone, x) - brute) < 1e-12);
    CHECK(std::abs(std::abs(cone->signedDistance(x)) - brute) < 1e-12);
    if (s > 0.01 && s < 0.99) CHECK((cone->signedDistance(x) < 0) == (share > 1));
    // The normal leads from the wall's point to the grain.
    const auto t = touchesOf(*cone, x, 1.0001 * brute);
    REQUIRE(t.count >= 1);
    const Vec3 foot = x - t.at[0].distance * t.at[0].normal;
    CHECK(std::abs(nearestOf(*cone, foot + 1e-7 * t.at[0].normal)) < 1.0001e-7);
  }
}

TEST_CASE("an oblique cone that does not lean is a frustum, and its tubes meet it without a seam") {
  const auto oblique = makeWall("oblique_cone", {{"base", Vec3(0, 0, 0)},
                                                 {"lower_radius", 0.02},
                                                 {"upper_radius", 0.08},
                                                 {"height", 0.1},
                                                 {"offset", Vec3(0, 0, 0.3)},
                                                 {"bin", 0.1},
                                                 {"chute", 0.03}});
  const auto straight = makeWall("cone_hopper", {{"base", Vec3(0, 0, 0)},
                                                 {"outlet", 0.04},
                                                 {"width", 0.16},
                                                 {"half_angle", std::atan(0.6)},
                                                 {"height", 0.2},
                                                 {"lip", 0.03}});
  for (int k = 0; k < 400; ++k) {
    RandomStream random(3, RandomPurpose::test, k);
    const Vec3 x(0.08 * (2 * random.uniform() - 1), 0.08 * (2 * random.uniform() - 1),
                 -0.03 + 0.22 * random.uniform());
    const auto a = touchesOf(*oblique, x, 0.02), b = touchesOf(*straight, x, 0.02);
    CAPTURE(x.transpose());
    REQUIRE(a.count == b.count);
    double nearA = 1, nearB = 1;
    for (int c = 0; c < a.count; ++c) {
      nearA = std::min(nearA, a.at[c].distance);
      nearB = std::min(nearB, b.at[c].distance);
    }
    CHECK(std::abs(nearA - nearB) < 1e-12);
  }
}

TEST_CASE("a disc is touched once on its face, on its rim and on the rim of its hole") {
  const auto disc = makeWall("disc", {{"centre", Vec3(0, 0, 1)}, {"radius", 0.1}});
  for (const Vec3& x : {Vec3(0, 0, 1.005), Vec3(1e-4, 0, 1.005), Vec3(0.05, 0.01, 0.995)}) {
    const auto t = touchesOf(*disc, x, 0.01);
    REQUIRE(t.count == 1);
    CHECK(t.at[0].distance == Approx(0.005).epsilon(1e-12));
    CHECK(t.at[0].normal.isApprox(Vec3(0, 0, x.z() > 1 ? 1 : -1)));
  }
  const auto rim = touchesOf(*disc, {0.103, 0, 1.004}, 0.01);
  REQUIRE(rim.count == 1);
  CHECK(rim.at[0].distance == Approx(0.005).epsilon(1e-9));
  const auto holed = makeWall("disc", {{"centre", Vec3(0, 0, 1)}, {"radius", 0.1}, {"hole", 0.05}});
  const auto inner = touchesOf(*holed, {0, 0.046, 1.003}, 0.01);
  REQUIRE(inner.count == 1);
  CHECK(inner.at[0].distance == Approx(0.005).epsilon(1e-9));
  CHECK(touchesOf(*holed, {0, 0, 1}, 0.04).count == 0);
  CHECK_THROWS_WITH(makeWall("disc", {{"centre", Vec3(0, 0, 0)}, {"radius", 0.1}, {"hole", 0.1}}),
                    Catch::Contains("must be smaller"));
}

TEST_CASE("in the middle of a closed bottom a grain feels the floor once") {
  const auto drum = makeWall(
      "cylinder", {{"base", Vec3(0, 0, 0)}, {"radius", 0.1}, {"height", 0.2}, {"ends", std::string("both")}});
  for (const double off : {0.0, 1e-9, 1e-4, 1e-3})
    CHECK(touchesOf(*drum, {off, 0, 0.0099}, 0.01).count == 1);
}
