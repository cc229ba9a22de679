// Walton and Braun's latching spring: restitution, duration, the loop of force over overlap, and the two-body
// numbers of the cases that Roy (1998) and Anand (2009) ran with it.

#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;

/// Roy's test pair: radius 0.05 m, mass 0.1 kg, K1 = 900, K2 = 1710 N/m, no gravity, dt = 1e-4 s.
SceneText royPair(const std::string& tangential = R"({ law = "none" })") {
  SceneText t;
  t.normal = R"({ law = "walton_braun", stiffness = "900 N/m", unloading_stiffness = "1710 N/m" })";
  t.tangential = tangential;
  t.lower = R"(["-20 m", "-20 m", "-20 m"])";
  t.upper = R"(["20 m", "20 m", "20 m"])";
  t.species = fmt::format("[[species]]\nname = \"bead\"\nmaterial = \"glass\"\nsize = {{ distribution = "
                          "\"single\", diameter = \"100 mm\" }}\n");
  t.density = 0.1 / (4.0 / 3.0 * pi * std::pow(0.05, 3));
  t.timeStep = 1e-4;
  return t;
}

struct Meeting {
  double touch = -1, deepest = 0, forceEnd = -1, parting = -1; ///< [s], [m], [s], [s]
  double residual = -1;                                        ///< overlap at forceEnd [m]
  std::vector<GrainSeed> end;
  double energyBefore = 0, translation = 0, spin = 0, spinMomentum = 0;
};

Meeting meet(const SceneText& text, const Vec3& a, const Vec3& b, double speed, int steps) {
  Scene scene = text.scene();
  scene.accuracy.maximumOverlap = 10; // these spheres pass through each other to more than a radius
  DemSolver solver(scene, {1});
  solver.add(
      {grain(0, a, {speed, 0, 0}, Vec3::Zero(), 0.05), grain(1, b, {-speed, 0, 0}, Vec3::Zero(), 0.05)});
  Meeting m;
  Vec3 before = solver.present()[0].velocity;
  for (int k = 1; k <= steps; ++k) {
    solver.advance(1);
    const auto p = solver.present();
    const double overlap = 0.1 - (p[0].position - p[1].position).norm();
    const double now = solver.time();
    if (overlap > 0 && m.touch < 0) m.touch = now;
    m.deepest = std::max(m.deepest, overlap);
    if (m.touch >= 0 && m.parting < 0 && overlap <= 0) m.parting = now;
    if (m.touch >= 0 && m.forceEnd < 0 && now > m.touch + 1e-3 && (p[0].velocity - before).norm() == 0.0) {
      m.forceEnd = now;
      m.residual = overlap;
    }
    before = p[0].velocity;
  }
  m.end = solver.present();
  const double mass = 0.1, inertia = 0.4 * mass * 0.05 * 0.05;
  m.energyBefore = mass * speed * speed;
  for (const GrainSeed& g : m.end) {
    m.translation += 0.5 * mass * g.velocity.squaredNorm();
    m.spin += 0.5 * inertia * g.spin.squaredNorm();
    m.spinMomentum += inertia * g.spin.z() + mass * g.position.cross(g.velocity).z();
  }
  return m;
}

} // namespace

TEST_CASE("V1: the aligned pair of the 1998 source, with the latching spring as corrected") {
  const Meeting m = meet(royPair(), {2.0, 0.1, 0.1}, {2.4, 0.1, 0.1}, 5.0, 900);
  CHECK(m.touch == Approx(0.0300).margin(1.01e-4));
  CHECK(m.deepest == Approx(0.07454).epsilon(0.002));
  CHECK(m.forceEnd == Approx(0.0502).margin(2e-4));
  CHECK(m.residual ==
        Approx(0.03531).margin(2 * 7.25e-4)); // the first step without force: parts by 2 x 3.627 m/s
  CHECK(m.parting == Approx(0.0551).margin(2e-4));
  CHECK(m.end[0].velocity.x() == Approx(-3.627).epsilon(0.001));
  CHECK(m.end[1].velocity.x() == Approx(3.627).epsilon(0.001));
  CHECK(m.end[0].position.x() == Approx(2.0233).margin(5e-4));
  CHECK(m.end[1].position.x() == Approx(2.3767).margin(5e-4));
  for (const GrainSeed& g : m.end) {
    CHECK(g.position.y() == 0.1);
    CHECK(g.position.z() == 0.1);
  }
  CHECK((m.end[0].velocity + m.end[1].velocity).norm() < 1e-12);
  CHECK(m.translation / (2 * 0.5 * 0.1 * 25) == Approx(0.5263).epsilon(0.002));
}

TEST_CASE("V2: the offset pair without friction") {
  const Meeting m = meet(royPair(), {2.0, 0.55, 0}, {2.4, 0.5, 0}, 5.0, 900);
  CHECK(m.touch == Approx(0.03134).margin(1.01e-4));
  CHECK(m.deepest == Approx(0.0405).epsilon(0.002));
  CHECK(m.end[0].velocity.x() == Approx(3.890).epsilon(0.002));
  CHECK(m.end[0].velocity.y() == Approx(2.525).epsilon(0.002));
  CHECK((m.end[0].velocity + m.end[1].velocity).norm() < 1e-12);
  CHECK(m.translation / m.energyBefore == Approx(0.860).epsilon(0.002));
  CHECK(m.spinMomentum == Approx(-0.025).margin(1e-9));
}

TEST_CASE("V5: restitution is the root of K1 over K2 at every speed, at forty steps of unloading") {
  for (const double ratio : {1.0, 1.9, 3.0, 10.0})
    for (const double v : {0.01, 0.3, 5.0}) {
      SceneText t = royPair();
      t.normal =
          fmt::format(R"({{ law = "walton_braun", stiffness = "5000 N/m", unloading_stiffness = "{} N/m" }})",
                      5000 * ratio);
      t.timeStep = 0.5 * pi * std::sqrt(0.05 / (5000 * ratio)) / 40;
      const int steps = static_cast<int>(0.8 / t.timeStep / std::max(1.0, v * 10));
      const Meeting m = meet(t, {-0.0501, 0, 0}, {0.0501, 0, 0}, v, std::max(steps, 400));
      INFO(ratio << " at " << v);
      REQUIRE(m.parting > 0);
      CHECK(-m.end[0].velocity.x() / v == Approx(std::sqrt(1 / ratio)).epsilon(0.005));
    }
}

TEST_CASE("V6: the loop of force over overlap under a prescribed overlap") {
  const LawStack laws(royPair().scene());
  ContactBlock b;
  b.size = 1;
  b.oneType = true;
  b.type[0] = 0;
  b.history[0][0] = 0;
  b.vn[0] = 0;
  const double K1 = 900, K2 = 1710, a = 0.01;
  double area = 0, before = 0, forceBefore = 0;
  const auto move = [&](double to, double expectedSlope) {
    const double from = before;
    for (int k = 1; k <= 1000; ++k) {
      b.overlap[0] = from + (to - from) * k / 1000;
      laws.apply(b, false);
      const double force = b.normalForce[0];
      REQUIRE(force >= 0.0);
      area += 0.5 * (force + forceBefore) * (b.overlap[0] - before);
      if (k > 1 && expectedSlope > 0)
        REQUIRE((force - forceBefore) / (b.overlap[0] - before) == Approx(expectedSlope).epsilon(1e-8));
      before = b.overlap[0];
      forceBefore = force;
    }
  };
  const double residual = a * (1 - K1 / K2);
  const double half = 0.5 * (a + residual);
  move(a, K1);
  CHECK(forceBefore == Approx(K1 * a).epsilon(1e-14));
  move(half, K2);
  CHECK(forceBefore == Approx(0.5 * K1 * a).epsilon(1e-12));
  move(a, K2);
  CHECK(forceBefore == Approx(K1 * a).epsilon(1e-12));
  move(1.5 * a, K1);
  CHECK(forceBefore == Approx(1.5 * K1 * a).epsilon(1e-14));
  move(1.5 * residual, K2);
  CHECK(forceBefore == Approx(0.0).margin(1e-12));
  move(0.0, 0);
  CHECK(area == Approx(0.5 * K1 * 2.25 * a * a * (1 - K1 / K2)).epsilon(1e-6));
  CHECK(b.history[0][0] == 0.0); // parted: forgotten
}

TEST_CASE("the 2009 source's collisions: restitution 0.94 and 0.90, durations, whatever the speed") {
  // Glass of 2.24 mm, kL = 250 N/m; pairs kU = 283 N/m, wall kU = 308.6 N/m; iron 2.35 mm, fines 0.521 mm.
  struct Case {
    double diameter, density, restitution, unloading, time;
    bool wall;
  };
  for (const Case& c : {Case{2.24e-3, 2500, 0.94, 283, 5.23e-4, false},
                        {2.24e-3, 2500, 0.90, 308.6, 7.24e-4, true},
                        {2.35e-3, 7850, 0.94, 283, 9.95e-4, false},
                        {0.521e-3, 2500, 0.94, 283, 5.86e-5, false}})
    for (const double v : {0.05, 0.5}) {
      SceneText t;
      t.density = c.density;
      t.species = fmt::format("[[species]]\nname = \"bead\"\nmaterial = \"glass\"\nsize = {{ distribution = "
                              "\"single\", diameter = \"{} mm\" }}\n",
                              c.diameter * 1e3);
      t.normal =
          fmt::format(R"({{ law = "walton_braun", stiffness = "250 N/m", unloading_stiffness = "{} N/m" }})",
                      c.unloading);
      if (c.wall)
        t.walls = "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 "
                  "m\", \"0 m\"]\nnormal = [1, 0, 0]\n";
      t.timeStep = c.time / 50;
      DemSolver solver(t.scene(), {1});
      const double r = 0.5 * c.diameter, gap = 1e-7, u = c.wall ? v : 0.5 * v;
      if (c.wall)
        solver.add({grain(0, {r + gap, 0, 0}, {-u, 0, 0}, Vec3::Zero(), r)});
      else
        solver.add({grain(0, {r + gap, 0, 0}, {-u, 0, 0}, Vec3::Zero(), r),
                    grain(1, {-r - gap, 0, 0}, {u, 0, 0}, Vec3::Zero(), r)});
      // The loaded time, found from the acceleration between steps; to a tenth of a step by the velocity
      // changes at both ends being small.
      int loaded = 0;
      double last = -u;
      for (int k = 0; k < 90; ++k) {
        solver.advance(1);
        const double now = solver.present()[0].velocity.x();
        loaded += now != last;
        last = now;
      }
      INFO(c.diameter << " " << c.wall << " " << v);
      CHECK(last / u == Approx(c.restitution).epsilon(0.01));
      CHECK(loaded * t.timeStep == Approx(c.time).epsilon(0.03)); // to a step and a half of fifty
      const double mass = pi / 6 * std::pow(c.diameter, 3) * c.density * (c.wall ? 1 : 0.5);
      CHECK(0.5 * pi * std::sqrt(mass) * (1 / std::sqrt(250.0) + 1 / std::sqrt(c.unloading)) ==
            Approx(c.time).epsilon(0.005));
    }
}

TEST_CASE("a latching spring refuses to unload softer than it loads") {
  SceneText t;
  t.normal = R"({ law = "walton_braun", stiffness = "900 N/m", unloading_stiffness = "800 N/m" })";
  CHECK_THROWS_WITH(LawStack(t.scene()), Catch::Contains("below the loading stiffness"));
}
