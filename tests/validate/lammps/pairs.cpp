// Trajectories through one collision at a two-thousandth of its duration a step: positions, velocities and
// spins of both programs at forty times.

#include "sim/solvers/dem/dem_solver.h"
#include "tests/validate/lammps/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::validate {

namespace {

constexpr double diameter = 2e-3, density = 2500;
constexpr int stepsInCollision = 2000, steps = 2800, every = 70;

struct Setup {
  std::string name;
  bool wall = false;
  std::vector<GrainSeed> grains;
};

GrainSeed grain(std::int64_t id, const Vec3& position, const Vec3& velocity, const Vec3& spin) {
  GrainSeed g;
  g.id = id;
  g.radius = 0.5 * diameter;
  g.position = position;
  g.velocity = velocity;
  g.spin = spin;
  return g;
}

std::vector<Setup> setups() {
  const double gap = 1e-9, r = 0.5 * diameter;
  const Vec3 none = Vec3::Zero();
  // Oblique: hit 40 degrees off the line of centres, with spins about all axes.
  const Vec3 n = Vec3(std::cos(0.7), std::sin(0.7), 0), a = -(r + 0.5 * gap) * n, b = (r + 0.5 * gap) * n;
  return {
      {"head-on",
       false,
       {grain(0, {-r - 0.5 * gap, 0, 0}, {0.2, 0, 0}, none),
        grain(1, {r + 0.5 * gap, 0, 0}, {-0.2, 0, 0}, none)}},
      {"oblique with friction and spin",
       false,
       {grain(0, a, {0.3, 0.05, 0.02}, {40, -30, 90}), grain(1, b, {-0.3, 0.01, -0.04}, {-20, 60, 50})}},
      {"oblique, sticking",
       false,
       {grain(0, a, {0.3, 0.2, 0.01}, {3, 0, 1}), grain(1, b, {-0.3, -0.2, 0}, {0, 2, 1})}},
      {"sphere on wall, oblique with spin",
       true,
       {grain(0, {0, 0, r + gap}, {0.15, -0.05, -0.3}, {30, -80, 60})}},
  };
}

Scene sceneOf(const Setup& s, const SharedLaw& law, double step) {
  return parseScene(fmt::format(R"(
title = "pair"
gravity = ["0", "0", "0"]
[domain]
lower = ["-1 cm", "-1 cm", "-1 cm"]
upper = ["1 cm", "1 cm", "1 cm"]
[[material]]
name = "glass"
density = "{} kg/m^3"
{}
[[species]]
name = "bead"
material = "glass"
size = {{ distribution = "single", diameter = "{} m" }}
{}
[[fill]]
kind = "list"
grains = [{{ position = ["0", "0", "5 mm"] }}]
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
[accuracy]
time_step = "{:.17g} s"
)",
                                density, law.contact("glass", "glass"), diameter,
                                s.wall
                                    ? "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"glass\"\n"
                                      "point = [\"0\", \"0\", \"0\"]\nnormal = [0, 0, 1]"
                                    : "",
                                step),
                    "pair");
}

} // namespace

void comparePairs(Report& report) {
  const double mass = std::numbers::pi / 6 * std::pow(diameter, 3) * density;
  const SharedLaw law{1000, 800, 0.4};
  for (const Setup& s : setups()) {
    const double reduced = s.wall ? mass : 0.5 * mass;
    const double step = std::numbers::pi /
                        std::sqrt(law.stiffness / reduced - 0.25 * law.dampingRate * law.dampingRate) /
                        stepsInCollision;
    const Scene scene = sceneOf(s, law, step);
    const peers::ScratchFolder scratch;
    peers::writeLammpsData(scratch.path() / "grains.data", scene, s.grains);
    std::string deck = peers::lammpsOpening(scene, "grains.data");
    deck += fmt::format(
        "pair_style {}\npair_coeff * *\nneighbor 1e-4 bin\ntimestep {:.17g}\nfix motion all nve/sphere\n",
        law.coefficients().words(), step);
    if (s.wall)
      deck += fmt::format("fix floor all wall/gran {} zplane 0 NULL\n", law.coefficients().wallWords());
    deck += peers::lammpsDumpCommand("out.dump", every);
    deck += fmt::format("run {}\n", steps);
    peers::runLammps(scratch.path(), deck, 1);
    const auto theirs = peers::readLammpsDump(scratch.path() / "out.dump");

    DemSolver solver(scene, {1});
    solver.add(s.grains);
    double speed = 0, position = 0, velocity = 0, spin = 0, change = 0;
    for (const GrainSeed& g : s.grains)
      speed = std::max(speed, g.velocity.norm());
    for (std::size_t k = 1; k < theirs.size(); ++k) {
      solver.advance(every);
      const auto ours = solver.present();
      for (std::size_t i = 0; i < ours.size(); ++i) {
        position = std::max(position, (ours[i].position - theirs[k][i].position).norm() / diameter);
        velocity = std::max(velocity, (ours[i].velocity - theirs[k][i].velocity).norm() / speed);
        change = std::max(change, (ours[i].velocity - s.grains[i].velocity).norm() / speed);
        spin = std::max(spin, (ours[i].spin - theirs[k][i].spin).norm() * 0.5 * diameter / speed);
      }
    }
    const std::string source = "LAMMPS, gran/hooke/history, the same step";
    const std::string name = "trajectory: " + s.name;
    report.between(name, "change of velocity, over the speed of impact (they do collide)", change, 0, 0.5,
                   std::numeric_limits<double>::infinity(), "nearly 1 or more");
    report.between(name, "largest difference of position, over the diameter", position, 0, 0, 1e-6, source);
    report.between(name, "of velocity, over the speed of impact", velocity, 0, 0, 1e-6, source);
    report.between(name, "of spin times radius, over the speed of impact", spin, 0, 0, 1e-6, source);
  }
}

} // namespace sandglass::validate
