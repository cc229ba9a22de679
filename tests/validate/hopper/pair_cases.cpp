// V1, V28: two grains head-on and against a wall; what contacts must conserve.

#include "sim/base/random.h"
#include "sim/solvers/dem/dem_solver.h"
#include "tests/validate/hopper/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::validate {

namespace {

struct PairSetup {
  double diameter = 2.24e-3, density = glassDensity;
  bool wall = false;
  std::string tangential = R"({ law = "none" })";
};

constexpr double unloading = 283, wallUnloading = 308.6;

Scene pairScene(const PairSetup& p, double step) {
  return parseScene(fmt::format(R"(
title = "pair"
gravity = ["0", "0", "0"]
[domain]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["1 m", "1 m", "1 m"]
[[material]]
name = "grain"
density = "{0} kg/m^3"
[[material]]
name = "wall"
[[contact]]
between = ["grain", "grain"]
normal = {1}
tangential = {3}
[[contact]]
between = ["grain", "wall"]
normal = {2}
tangential = {3}
[[species]]
name = "grain"
material = "grain"
size = {{ distribution = "single", diameter = "{4:.10g} mm" }}
{5}
[[fill]]
kind = "list"
grains = [{{ position = ["0.5 m", "0", "0"] }}]
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
[output]
quantities = ["velocity", "force"]
[accuracy]
time_step = "{6:.17g} s"
)",
                                p.density, latchingLaw(loadingStiffness, unloading),
                                latchingLaw(loadingStiffness, wallUnloading), p.tangential, 1e3 * p.diameter,
                                p.wall ? "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\n"
                                         "point = [\"0\", \"0\", \"0\"]\nnormal = [1, 0, 0]"
                                       : "",
                                step),
                    "pair");
}

struct Collision {
  double restitution = 0, duration = 0; ///< duration of the force [s]
  analysis::Series force;               ///< [N] against overlap [m]
};

/// One head-on collision at a fiftieth of its expected duration a step.
Collision collide(const PairSetup& p, double speed) {
  const double mass = sphereMass(p.diameter, p.density);
  const double expected = p.wall ? latchingTime(mass, loadingStiffness, wallUnloading)
                                 : latchingTime(0.5 * mass, loadingStiffness, unloading);
  const double step = expected / 50;
  DemSolver solver(pairScene(p, step), {1});
  const double gap = 0.3 * speed * step, r = 0.5 * p.diameter;
  GrainSeed a, b;
  a.radius = b.radius = r;
  b.id = 1;
  if (p.wall) {
    a.position = {r + gap, 0, 0};
    a.velocity = {-speed, 0, 0};
    solver.add({a});
  } else {
    a.position = {-r - 0.5 * gap, 0, 0};
    b.position = {r + 0.5 * gap, 0, 0};
    a.velocity = {0.5 * speed, 0, 0};
    b.velocity = {-0.5 * speed, 0, 0};
    solver.add({a, b});
  }
  Collision c;
  c.force.name = fmt::format("{:g} cm/s", 100 * speed);
  double before = 0, last = 0; // forces of the last two steps in touch
  int lastStep = 0;
  for (int k = 1; k <= 80; ++k) {
    solver.advance(1);
    const FramePtr f = solver.frame();
    const double force = std::abs(f->vector(quantity::force)[0].x());
    if (force <= 0) continue;
    const double apart = p.wall ? f->position[0].x() - r : f->position[1].x() - f->position[0].x() - 2 * r;
    c.force.x.push_back(-1e6 * apart);
    c.force.y.push_back(1e3 * force);
    before = last;
    last = force;
    lastStep = k;
  }
  const FramePtr f = solver.frame();
  const auto& v = f->vector(quantity::velocity);
  c.restitution = p.wall ? v[0].x() / speed : (v[1].x() - v[0].x()) / speed;
  // Touch falls 0.3 of a step after the start; the force falls to zero in a straight line.
  const double tail = before > last ? std::min(1.0, last / (before - last)) : 0;
  c.duration = (lastStep + tail - 0.3) * step;
  return c;
}

void judgeCollisions(const HopperRuns&, Report& report) {
  const std::string name = "V1 two grains";
  analysis::Curve curve;
  curve.name = "V1";
  curve.title = "V1: force against overlap of two glass grains";
  curve.definition = "head-on, 50 steps in a collision";
  curve.x = {"overlap", "um"};
  curve.y = {"force", "mN"};
  for (const bool wall : {false, true}) {
    double low = unbounded, high = -unbounded, time = 0;
    for (const double speed : {0.05, 0.2, 0.5}) {
      const Collision c = collide({.wall = wall}, speed);
      low = std::min(low, c.restitution);
      high = std::max(high, c.restitution);
      time = c.duration;
      if (!wall) curve.series.push_back(c.force);
    }
    const std::string what = wall ? "grain on wall: " : "grain on grain: ";
    report.near(name, what + "restitution at 5 to 50 cm/s, lowest", low, 0, wall ? 0.90 : 0.94, 0.01, anand);
    report.near(name, what + "restitution at 5 to 50 cm/s, highest", high, 0, wall ? 0.90 : 0.94, 0.01,
                anand);
    report.near(name, what + "duration [s]", time, 0, wall ? 7.24e-4 : 5.23e-4, 0.01, anand);
  }
  report.near(name, "iron of 2.35 mm: duration [s]",
              collide({.diameter = 2.35e-3, .density = 7850}, 0.2).duration, 0, 9.95e-4, 0.01, anand);
  report.near(name, "glass of 0.521 mm: duration [s]", collide({.diameter = 0.521e-3}, 0.2).duration, 0,
              5.86e-5, 0.01, anand);
  report.curves.push_back(curve);
}

/// Two hundred pairs far apart, each a collision of random direction, offset and spin; the largest relative
/// change of a pair's momentum and angular momentum, and the largest relative gain of energy.
void judgeConservation(const HopperRuns& runs, Report& report) {
  const std::string name = "V28 conservation";
  PairSetup p;
  p.tangential = R"({ law = "spring", friction = 0.2, stiffness_ratio = 0.2857142857142857 })";
  const double mass = sphereMass(p.diameter), r = 0.5 * p.diameter, inertia = 0.4 * mass * r * r;
  const double step = latchingTime(0.5 * mass, loadingStiffness, unloading) / 50;
  DemSolver solver(pairScene(p, step), {1});
  std::vector<GrainSeed> seeds;
  constexpr int pairs = 200;
  for (int k = 0; k < pairs; ++k) {
    RandomStream random(1, RandomPurpose::test, k);
    const Vec3 centre(0.1 * (k % 10 - 4.5), 0.1 * (k / 10 % 10 - 4.5), 0.1 * (k / 100 - 0.5));
    const Vec3 along = random.direction(), off = random.direction();
    const Vec3 offset = 0.8 * p.diameter * random.uniform() * along.cross(off).normalized();
    for (const int side : {-1, 1}) {
      GrainSeed s;
      s.id = static_cast<std::int64_t>(seeds.size());
      s.radius = r;
      s.position = centre + side * (0.75 * p.diameter * along + 0.5 * offset);
      s.velocity = -side * 0.25 * along + 0.05 * random.direction();
      s.spin = 100 * random.direction();
      seeds.push_back(s);
    }
  }
  solver.add(seeds);
  const auto sums = [&](const std::vector<GrainSeed>& g, int k) {
    struct {
      Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
      double energy = 0;
    } s;
    const Vec3 about = seeds[2 * k].position;
    for (int j = 2 * k; j < 2 * k + 2; ++j) {
      s.momentum += mass * g[j].velocity;
      s.angular += mass * (g[j].position - about).cross(g[j].velocity) + inertia * g[j].spin;
      s.energy += 0.5 * mass * g[j].velocity.squaredNorm() + 0.5 * inertia * g[j].spin.squaredNorm();
    }
    return s;
  };
  solver.advance(600);
  const auto after = solver.present();
  double momentum = 0, angular = 0, gain = -unbounded;
  for (int k = 0; k < pairs; ++k) {
    const auto a = sums(seeds, k), b = sums(after, k);
    momentum = std::max(momentum, (b.momentum - a.momentum).norm() / (mass * 0.5));
    angular = std::max(angular, (b.angular - a.angular).norm() / (mass * 0.5 * p.diameter));
    gain = std::max(gain, b.energy / a.energy - 1);
  }
  report.between(name, "momentum of a pair: largest relative change in 200 oblique collisions", momentum, 0,
                 0, 1e-10, "symmetry of contact forces");
  report.between(name, "angular momentum, spins included: largest relative change", angular, 0, 0, 1e-10,
                 "symmetry of contact forces");
  report.between(name, "energy: largest relative gain", gain, 0, -unbounded, 1e-10,
                 "friction and restitution only lose");
  double mass28 = 0;
  for (const HopperRun& run : runs.of(baseBed()))
    mass28 = std::max(mass28, std::abs(run.imbalance));
  report.between(name, "mass neither discharged nor present in the base runs", mass28, 0, 0, 1e-10,
                 "conservation");
}

} // namespace

std::vector<HopperCase> pairCases() {
  return {{"V1", "two grains", {}, judgeCollisions}, {"V28", "conservation", {baseBed()}, judgeConservation}};
}

} // namespace sandglass::validate
