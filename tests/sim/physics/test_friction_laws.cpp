// Friction, rolling and torsion: closed forms under prescribed motion, and two-body numbers of the 1998
// source.

#include "sim/base/random.h"
#include "tests/sim/physics/one_contact.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;

LawStack stack(const std::string& tangential, const std::string& rolling = R"({ law = "none" })") {
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  t.tangential = tangential;
  t.rolling = rolling;
  return LawStack(t.scene());
}

std::string walton(double exponent) {
  return fmt::format(R"({{ law = "walton", friction = 0.3, stiffness = "800 N/m", exponent = {:.17g} }})",
                     exponent);
}

} // namespace

TEST_CASE("V7: monotone shear follows the closed forms of T over s, and a reversal starts at slope K0") {
  // Overlap 1e-4 m: F_n = 0.1 N, limit mu F_n = 0.03 N, K0 = 800 N/m. With u = T / mu F_n, x = K0 s / mu F_n:
  // dT/ds = K0 (1 - u)^gamma.
  const double limit = 0.03, K0 = 800;
  for (const double gamma : {1.0 / 3.0, 1.0, 2.0, 0.6}) {
    const LawStack laws = stack(walton(gamma));
    OneContact c(laws);
    const int pieces = 4000;
    const double end = 2.5; // in x
    const double slip = end * limit / K0 / pieces / c.b.dt;
    INFO(gamma);
    for (int k = 1; k <= pieces; ++k) {
      c.step(1e-4, slip);
      REQUIRE(c.tangential() <= limit * (1 + 1e-12));
      const double x = end * k / pieces;
      double u = 0;
      if (gamma == 1.0)
        u = 1 - std::exp(-x);
      else // (1 - u)^(1 - gamma) = 1 - (1 - gamma) x
        u = 1 - std::pow(std::max(1 - (1 - gamma) * x, 0.0), 1 / (1 - gamma));
      if (k % 100 == 0) REQUIRE(c.tangential() / limit == Approx(u).epsilon(0.005));
    }
    if (gamma < 0.5) CHECK(c.tangential() == Approx(limit).epsilon(1e-12)); // full slide from x = 1.5
    // Reversal: starts at slope K0, then (mu F_n + T)^gamma over (mu F_n + T*)^gamma.
    const double turn = c.tangential();
    c.step(1e-4, -slip);
    CHECK((turn - c.tangential()) / (slip * c.b.dt) == Approx(K0).epsilon(0.005));
    double T = turn - K0 * slip * c.b.dt;
    for (int k = 2; k <= 2 * pieces; ++k) {
      c.step(1e-4, -slip);
      for (int q = 0; q < 10; ++q) { // the reference in ten times finer steps, through zero and beyond
        const double share = std::max((limit + T) / (limit + turn), 0.0);
        T -= 0.1 * K0 * std::pow(share, gamma) * slip * c.b.dt;
      }
      if (k % 100 == 0) REQUIRE(c.tangential() == Approx(T).margin(0.005 * limit));
      REQUIRE(std::abs(c.tangential()) <= limit * (1 + 1e-12));
    }
    CHECK(c.tangential() < -0.5 * limit);
    // A second reversal starts at K0 again.
    const double second = c.tangential();
    c.step(1e-4, slip);
    CHECK((c.tangential() - second) / (slip * c.b.dt) == Approx(K0).epsilon(0.005));
  }
}

TEST_CASE("Walton's friction: a turning point scales with the load, slip across adds at K0") {
  const LawStack laws = stack(walton(1.0));
  OneContact c(laws);
  for (int k = 0; k < 100; ++k)
    c.step(1e-4, 0.1); // rises
  c.step(1e-4, -0.01); // turns
  const double turn = c.b.history[3][0];
  REQUIRE(turn > 0);
  c.step(1.5e-4, 0.0); // the load grows by half
  CHECK(c.b.history[3][0] == Approx(1.5 * turn).epsilon(1e-12));
  // Slip across the force: K0 times the slip, added at a right angle.
  const double T = c.tangential();
  c.b.vtz[0] = 1e-3;
  c.step(1.5e-4, 0.0);
  CHECK(-c.b.ftz[0] == Approx(800 * 1e-3 * c.b.dt).epsilon(1e-9));
  CHECK(c.tangential() == Approx(T).epsilon(1e-9));
}

TEST_CASE("V3: the offset pair with friction, arms to the contact, keeps angular momentum") {
  SceneText t;
  t.normal = R"({ law = "walton_braun", stiffness = "900 N/m", unloading_stiffness = "1710 N/m" })";
  t.tangential = R"({ law = "walton", friction = 0.3, stiffness = "720 N/m" })";
  t.density = 0.1 / (4.0 / 3.0 * pi * std::pow(0.05, 3));
  t.species = "[[species]]\nname = \"bead\"\nmaterial = \"glass\"\nsize = { distribution = \"single\", "
              "diameter = \"100 mm\" }\n";
  t.lower = R"(["-20 m", "-20 m", "-20 m"])";
  t.upper = R"(["20 m", "20 m", "20 m"])";
  const auto run = [&](const std::string& arm, double dt) {
    t.tangential =
        fmt::format(R"({{ law = "walton", friction = 0.3, stiffness = "720 N/m", arm = "{}" }})", arm);
    t.timeStep = dt;
    Scene scene = t.scene();
    scene.accuracy.maximumOverlap = 10;
    DemSolver solver(scene, {1});
    solver.add({grain(0, {2.0, 0.55, 0}, {5, 0, 0}, Vec3::Zero(), 0.05),
                grain(1, {2.4, 0.5, 0}, {-5, 0, 0}, Vec3::Zero(), 0.05)});
    solver.advance(std::lround(0.09 / dt));
    return solver.present();
  };
  const double mass = 0.1, inertia = 0.4 * mass * 0.05 * 0.05;
  const auto momentum = [&](const std::vector<GrainSeed>& p) {
    double L = 0;
    for (const auto& g : p)
      L += inertia * g.spin.z() + mass * g.position.cross(g.velocity).z();
    return L;
  };
  const auto p = run("contact", 1e-4);
  CHECK(p[0].velocity.x() == Approx(2.96).epsilon(0.02));
  CHECK(p[0].velocity.y() == Approx(2.476).epsilon(0.02));
  CHECK(p[0].spin.z() == Approx(-31.0).epsilon(0.02));
  CHECK(p[1].spin.z() == Approx(-31.0).epsilon(0.02));
  double translation = 0, spin = 0;
  for (const auto& g : p) {
    translation += 0.5 * mass * g.velocity.squaredNorm() / 2.5;
    spin += 0.5 * inertia * g.spin.squaredNorm() / 2.5;
  }
  CHECK(translation == Approx(0.596).epsilon(0.02));
  CHECK(spin == Approx(0.0385).epsilon(0.04));
  CHECK(momentum(p) == Approx(-0.025).margin(1e-9));
  CHECK((p[0].velocity + p[1].velocity).norm() < 1e-12);
  // Full radii as arms break it at such an overlap (the source's listing; -0.0283 in its corrections).
  CHECK(momentum(run("radius", 1e-4)) == Approx(-0.0283).epsilon(0.03));
}

TEST_CASE("a viscous contact drags by its coefficient up to Coulomb's limit") {
  const LawStack laws = stack(R"({ law = "viscous", friction = 0.3, damping = "0.05 kg/s" })");
  OneContact c(laws);
  c.step(1e-4, 0.1);
  CHECK(c.tangential() == Approx(0.05 * 0.1).epsilon(1e-14));
  c.step(1e-4, 5.0);
  CHECK(c.tangential() == Approx(0.3 * 0.1).epsilon(1e-14));
  c.step(-1e-6, 5.0);
  CHECK(c.tangential() == 0.0);
}

TEST_CASE("a tangential dashpot by rate, and a spring that is projected instead of turned") {
  const LawStack rated =
      stack(R"({ law = "spring", friction = 10.0, stiffness_ratio = 0.5, damping_rate = "200 1/s" })");
  OneContact c(rated);
  c.b.effectiveMass[0] = 1.0 / (2.0 / (4.0 / 3.0 * pi * 1e-9 * 2500.0)); // as the scene's grains have it
  c.step(1e-4, 0.1);
  // k_t s + rate m v with s = v dt
  CHECK(c.tangential() == Approx(500 * 0.1 * 1e-6 + 200 * c.b.effectiveMass[0] * 0.1).epsilon(1e-12));

  // A contact that turns by an angle keeps the spring's length, or its projection.
  for (const char* rotation : {"turn", "project"}) {
    const LawStack laws = stack(fmt::format(
        R"({{ law = "spring", friction = 10.0, stiffness_ratio = 0.5, rotation = "{}" }})", rotation));
    OneContact d(laws);
    d.step(1e-4, 0.1);
    const double before = d.tangential(), angle = 0.1;
    d.b.nx[0] = std::cos(angle), d.b.ny[0] = std::sin(angle); // the spring lies along y
    d.step(1e-4, 0.0);
    const double after = std::hypot(d.b.ftx[0], d.b.fty[0]);
    CHECK(after ==
          Approx(std::string(rotation) == "turn" ? before : before * std::cos(angle)).epsilon(1e-12));
    CHECK(d.b.ftx[0] * d.b.nx[0] + d.b.fty[0] * d.b.ny[0] == Approx(0).margin(1e-15));
  }
}

TEST_CASE(
    "spring and dashpot of friction stay within the limit and store no energy that slip did not bring") {
  // Random slips of a contact held at one overlap. The energy that a dashpot holds is nobody's: what is
  // stored may rise by no more than the work of the slip.
  for (const char* law :
       {R"({ law = "spring", friction = 0.5 })", R"({ law = "spring", friction = 0.5, damping_ratio = 1.0 })",
        R"({ law = "spring", friction = 0.5, damping_ratio = 100.0 })",
        R"({ law = "spring", friction = 0.5, damping_rate = "1e5 1/s" })",
        R"({ law = "spring", friction = 0.5, damping_rate = "1e7 1/s", rotation = "project" })",
        R"({ law = "mindlin", friction = 0.5 })"}) {
    SceneText t;
    t.elasticity = "youngs_modulus = \"20 MPa\"\npoisson_ratio = 0.25";
    t.normal = std::string(law).find("mindlin") == std::string::npos
                   ? R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.5 })"
                   : R"({ law = "hertz", restitution = 0.5 })";
    t.tangential = law;
    const LawStack laws(t.scene());
    OneContact c(laws, 1e-8);
    c.step(1e-4);
    const double start = c.stored();
    double work = 0, storedMost = 0;
    RandomStream random(11, RandomPurpose::test, 0);
    INFO(law);
    for (int k = 0; k < 200; ++k) {
      const double size = 0.3 * random.uniform();
      const Vec3 v = size * random.direction();
      for (int i = 0; i < 1000; ++i) {
        c.b.vtz[0] = v.z();
        c.step(1e-4, v.y());
        const double force = std::hypot(c.b.fty[0], c.b.ftz[0]);
        REQUIRE(force <= 0.5 * c.b.contactForce[0] * (1 + 1e-12));
        work -= (c.b.fty[0] * v.y() + c.b.ftz[0] * v.z()) * c.b.dt;
        storedMost = std::max(storedMost, c.stored() - start);
        REQUIRE(c.stored() - start <= work * (1 + 1e-3) + 1e-12);
      }
    }
    CHECK(storedMost > 0);
  }
}

TEST_CASE("a sliding sphere is slowed by mu g, however strong the dashpot of its friction") {
  const double friction = 0.5, mass = 4.0 / 3.0 * pi * 1e-9 * 2500.0, depth = mass * 9.81 / 1000;
  for (const char* dashpot : {"damping_ratio = 0.0", "damping_ratio = 1.0", "damping_ratio = 100.0",
                              R"(damping_rate = "1e5 1/s")", R"(damping_rate = "1e7 1/s")"}) {
    SceneText t;
    t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.5 })";
    t.tangential = fmt::format(R"({{ law = "spring", friction = {}, {} }})", friction, dashpot);
    t.walls = "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
              "\"0 m\"]\nnormal = [0, 0, 1]\n";
    DemSolver solver(t.scene(), {1});
    solver.add({grain(0, {0, 0, 1e-3 - depth}, {0.2, 0, 0})});
    const double before = solver.energies().total();
    // It rolls from 2/7 v / (mu g) = 11.7 ms on.
    solver.advance(std::lround(8e-3 / solver.stepSize()));
    INFO(dashpot);
    CHECK(solver.present()[0].velocity.x() == Approx(0.2 - friction * 9.81 * solver.time()).epsilon(1e-3));
    solver.advance(std::lround(22e-3 / solver.stepSize()));
    CHECK(solver.present()[0].velocity.x() == Approx(0.2 * 5 / 7).epsilon(2e-3));
    CHECK(solver.energies().total() < before);
  }
}

TEST_CASE("resistance to rolling and torsion takes no more than its limit in one bounce") {
  // A spinning sphere falls on a plane: the couple is at most l F_n, so the spin loses at most l (1 + e) m v
  // / I.
  const double mass = 4.0 / 3.0 * pi * 1e-9 * 2500.0, inertia = 0.4 * mass * 1e-6, length = 0.02e-3;
  const double most = length * (1 + 0.8) * mass * 0.1 / inertia;
  for (const char* role : {"rolling", "torsion"})
    for (const double damping : {0.0, 1.0}) {
      SceneText t;
      t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.8 })";
      const std::string law =
          fmt::format(R"({{ law = "elastic_plastic", length = "0.02 mm", damping = {} }})", damping);
      const bool rolling = role == std::string("rolling");
      t.rolling = rolling ? law : "{ law = \"none\" }\ntorsion = " + law;
      t.walls =
          "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
          "\"0 m\"]\nnormal = [0, 0, 1]\n";
      DemSolver solver(t.scene(), {1});
      solver.add({grain(0, {0, 0, 1.001e-3}, {0, 0, -0.1}, rolling ? Vec3(100, 0, 0) : Vec3(0, 0, 100))});
      while (solver.present()[0].position.z() < 1.001e-3 || solver.present()[0].velocity.z() < 0)
        solver.advance(10);
      const double lost = 100 - solver.present()[0].spin.norm();
      INFO(role << " damping " << damping);
      CHECK(lost > 0);
      CHECK(lost <= most * (1 + 0.01)); // 50 steps per contact take 0.5 % more from the normal force
      if (damping > 0) CHECK(lost > 0.9 * most);
    }
}

TEST_CASE("a constant rolling couple slows a spin by its law and never turns it round") {
  // A sphere on a plane that only spins: I dw/dt = -l F_n until rest. The linear contact holds it at rest in
  // height: F_n = m g.
  SceneText t;
  t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.5 })";
  t.rolling = R"({ law = "constant_torque", length = "0.05 mm" })";
  t.walls = "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
            "\"0 m\"]\nnormal = [0, 0, 1]\n";
  DemSolver solver(t.scene(), {1});
  const double mass = 4.0 / 3.0 * pi * 1e-9 * 2500.0, depth = mass * 9.81 / 1000;
  solver.add({grain(0, {0, 0, 1e-3 - depth}, Vec3::Zero(), {20, 0, 0})});
  const double slowing = 0.05e-3 * mass * 9.81 / (0.4 * mass * 1e-6);
  double before = 20;
  while (solver.time() < 0.5 * 20 / slowing)
    solver.advance(1);
  CHECK(solver.present()[0].spin.x() == Approx(20 - slowing * solver.time()).epsilon(1e-3));
  while (solver.time() < 1.5 * 20 / slowing) {
    solver.advance(1);
    const double now = solver.present()[0].spin.x();
    REQUIRE(now >= 0);
    REQUIRE(now <= before);
    before = now;
  }
  CHECK(before < 1e-6);
}

TEST_CASE("torsion: a spinning pair feels equal and opposite couples about the normal") {
  for (const std::string law : {R"({ law = "constant_torque", length = "0.02 mm" })",
                                R"({ law = "elastic_plastic", length = "0.02 mm" })"}) {
    SceneText t;
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.9 })";
    t.rolling = "{ law = \"none\" }\ntorsion = " + law;
    DemSolver solver(t.scene(), {1});
    // Pressed together by their approach, spinning against each other about the line of centres.
    solver.add(
        {grain(0, {1e-3, 0, 0}, {-0.1, 0, 0}, {50, 0, 0}), grain(1, {-1e-3, 0, 0}, {0.1, 0, 0}, {10, 0, 0})});
    solver.advance(100);
    const auto p = solver.present();
    INFO(law);
    CHECK(p[0].spin.x() + p[1].spin.x() == Approx(60).epsilon(1e-12)); // angular momentum about the normal
    CHECK(p[0].spin.x() < 50 - 1e-3);
    CHECK(p[0].spin.x() >= p[1].spin.x()); // not turned round
    CHECK(p[0].spin.y() == 0.0);
  }
}

TEST_CASE("pairs of materials may use different kinds of law") {
  SceneText t;
  t.normal = R"({ law = "walton_braun", stiffness = "1000 N/m", restitution = 0.6 })";
  t.wallNormal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.9 })";
  t.walls = "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
            "\"0 m\"]\nnormal = [1, 0, 0]\n";
  t.stepsPerContact = 200;
  DemSolver solver(t.scene(), {1});
  solver.add({grain(0, {1.001e-3, 0, 0}, {-0.1, 0, 0}), grain(1, {0.1, 0, 0}, {0.1, 0, 0}),
              grain(2, {0.102001, 0, 0}, {-0.1, 0, 0})});
  while (solver.present()[0].position.x() < 1.001e-3 || solver.present()[0].velocity.x() < 0)
    solver.advance(10);
  solver.advance(2000);
  const auto p = solver.present();
  CHECK(p[0].velocity.x() == Approx(0.09).epsilon(0.01));
  CHECK(p[2].velocity.x() == Approx(0.06).epsilon(0.01));
}

TEST_CASE("tangential laws of one scene must agree on the arm") {
  SceneText t;
  t.tangential = R"({ law = "spring", friction = 0.3, arm = "radius" })";
  CHECK(LawStack(t.scene()).fullRadiusArm());
  std::string text = t.text();
  text.replace(text.rfind("arm = \"radius\""), 14, "arm = \"contact\"");
  CHECK_THROWS_WITH(LawStack(parseScene(text, "test")), Catch::Contains("same choice of 'arm'"));
}
