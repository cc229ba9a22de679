#include "tests/bench/beds.h"

#include "sim/base/random.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace sandglass::bench {

namespace {
constexpr double stiffness = 2e5, dampingRate = 50, frictionCoefficient = 0.5;
constexpr double degree = std::numbers::pi / 180;
/// For LAMMPS and its relative.
constexpr const char* heldFast = "group bottom type 2\nneigh_modify exclude group bottom bottom\n"
                                 "fix hold bottom freeze\n";
} // namespace

peers::HookeHistory standardCoefficients(bool friction) {
  return {stiffness, 2.0 / 7.0 * stiffness, dampingRate, 0, friction ? frictionCoefficient : 0, false};
}

Scene Beads::scene(const std::vector<std::string>& knobs) const {
  // A dashpot of fixed rate has, for one effective mass, the restitution exp(-rate t_c / 2).
  const auto contact = [&](const char* with, double mass) {
    const double zeta = 0.5 * dampingRate * std::sqrt(mass / stiffness);
    const double e =
        restitution > 0 ? restitution : std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta));
    return fmt::format(
        R"([[contact]]
between = ["bead", "{}"]
normal = {{ law = "linear", stiffness = "{:.17g} N/m", {} }}
tangential = {}
)",
        with, stiffness,
        clamped || rough ? fmt::format("damping_rate = \"{:.17g} 1/s\"{}", dampingRate,
                                       clamped ? ", clamp_attraction = true" : "")
                         : fmt::format("restitution = {:.17g}", e),
        friction ? fmt::format(R"({{ law = "spring", friction = {}, rotation = "project", arm = "radius" }})",
                               frictionCoefficient)
                 : R"({ law = "none" })");
  };
  const double mass = std::numbers::pi / 6;
  return parseScene(fmt::format(R"(
title = "bench"
gravity = ["{:.17g} m/s^2", "0", "{:.17g} m/s^2"]
[domain]
lower = ["0", "0", "{} m"]
upper = ["{:.17g} m", "{:.17g} m", "{:.17g} m"]
periodic = ["x", "y"{}]
[[material]]
name = "bead"
density = "1 kg/m^3"
[[material]]
name = "floor"
{}{}
[[species]]
name = "bead"
material = "bead"
size = {{ distribution = "single", diameter = "1 m" }}
{}{}
[[fill]]
kind = "list"
grains = [{{ species = "bead", position = ["0.6 m", "0.6 m", "0.6 m"] }}]
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
[accuracy]
time_step = "{:.17g} s"
)",
                                gravity * std::sin(angle * degree), -gravity * std::cos(angle * degree),
                                floor ? -1 : 0, width, breadth, height, floor ? "" : ", \"z\"",
                                contact("bead", 0.5 * mass), contact("floor", mass),
                                rough ? R"([[species]]
name = "bottom"
material = "bead"
size = { distribution = "single", diameter = "1 m" }
frozen = true
)"
                                      : "",
                                floor && !rough ? R"([[wall]]
name = "floor"
kind = "plane"
material = "floor"
point = ["0", "0", "0"]
normal = [0, 0, 1]
)"
                                                : "",
                                timeStep),
                    "bench", knobs);
}

std::string Beads::lammpsDeck(std::int64_t look) const {
  const peers::HookeHistory c = standardCoefficients(friction);
  std::string deck = peers::lammpsOpening(scene(), "grains.data");
  // The skin is the one that the benchmark has.
  deck += fmt::format("pair_style {}\npair_coeff * *\nneighbor 0.1 bin\nneigh_modify every 1 delay 0\n"
                      "timestep {:.17g}\nfix weight all gravity {:.17g} vector {:.17g} 0 {:.17g}\n"
                      "fix motion all nve/sphere\n{}",
                      c.words(), timeStep, gravity, std::sin(angle * degree), -std::cos(angle * degree),
                      rough ? heldFast : "");
  if (floor && !rough) deck += fmt::format("fix floor all wall/gran {} zplane 0 NULL\n", c.wallWords());
  return deck + fmt::format("compute kinetic all ke\nthermo_style custom step atoms c_kinetic\n"
                            "thermo_modify norm no format float %.17g\nthermo {}\n",
                            look);
}

std::string Beads::liggghtsDeck(std::int64_t look) const {
  const peers::HookeHistory c = standardCoefficients(friction);
  std::string deck = fmt::format("units lj\natom_style granular\natom_modify map array\nboundary p p {}\n"
                                 "newton off\ncommunicate single vel yes\nread_data grains.data\n",
                                 floor ? "f" : "p");
  const auto property = [&](const char* name, double value) {
    deck += fmt::format("fix {0} all property/global {0} peratomtypepair {2} {1:.17g}", name, value,
                        rough ? 2 : 1);
    for (int k = 1; k < (rough ? 4 : 1); ++k)
      deck += fmt::format(" {:.17g}", value);
    deck += "\n";
  };
  property("kn", c.normalStiffness);
  property("kt", c.tangentialStiffness);
  property("gamman", c.normalDamping);
  property("gammat", c.tangentialDamping);
  property("coefficientFriction", c.friction);
  deck += fmt::format(
      "pair_style gran model hooke/stiffness tangential history\npair_coeff * *\n"
      "neighbor 0.1 bin\nneigh_modify every 1 delay 0\ntimestep {:.17g}\n"
      "fix weight all gravity {:.17g} vector {:.17g} 0 {:.17g}\nfix motion all nve/sphere\n{}",
      timeStep, gravity, std::sin(angle * degree), -std::cos(angle * degree), rough ? heldFast : "");
  if (floor && !rough)
    deck += "fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 zplane 0\n";
  return deck + fmt::format("compute kinetic all ke\nthermo_style custom step atoms c_kinetic\n"
                            "thermo_modify norm no format float %.17g\nthermo {}\n",
                            look);
}

std::string Beads::yadeScript(std::int64_t steps) const {
  const Scene s = scene();
  peers::YadeScene yade{standardCoefficients(friction), 0.5, std::numbers::pi / 6};
  for (int k = 0; k < 3; ++k) {
    yade.lower[k] = s.domain.lower[k];
    yade.upper[k] = s.domain.upper[k];
    yade.gravity[k] = s.gravity[k];
  }
  yade.floor = floor && !rough;
  yade.timeStep = timeStep;
  return peers::yadeScript(yade, steps);
}

std::vector<GrainSeed> dropped(std::vector<GrainSeed> beads, double speed) {
  for (GrainSeed& s : beads)
    s.velocity.z() -= speed;
  return beads;
}

std::vector<GrainSeed> settledTile(int across, int layers, bool quick) {
  const double side = across * tileSpacing;
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < across * across * layers; ++k) {
    RandomStream random(1, RandomPurpose::test, k);
    GrainSeed s;
    s.id = k;
    s.radius = 0.5;
    const Vec3 cell(k % across, k / across % across, k / (across * across));
    s.position = tileSpacing * (cell + Vec3::Constant(0.5)) + 0.02 * random.direction();
    s.velocity = 0.2 * random.direction();
    seeds.push_back(s);
  }
  // Soft in time and lossy: only the bed that is left matters.
  Beads beads{side, side, 2.0 * layers + 10, 0, 1, true, true, 0.4, 3e-4};
  DemSolver solver(beads.scene(), {0});
  solver.add(seeds);
  solver.advance(quick ? 3000 : 30000);
  return solver.present();
}

std::vector<GrainSeed> tiled(const std::vector<GrainSeed>& tile, double side, int nx, int ny) {
  std::vector<GrainSeed> all;
  all.reserve(tile.size() * nx * ny);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (GrainSeed s : tile) {
        s.id = static_cast<std::int64_t>(all.size());
        s.position += side * Vec3(i, j, 0);
        all.push_back(s);
      }
  return all;
}

std::vector<GrainSeed> roughened(std::vector<GrainSeed> beads) {
  constexpr double layer = 1.1; // a gap in the heights of a settled tile
  for (GrainSeed& s : beads)
    if (s.position.z() < layer) {
      s.species = 1;
      s.velocity = s.spin = Vec3::Zero();
    }
  return beads;
}

std::vector<GrainSeed> after(const Beads& beads, const std::vector<GrainSeed>& start, double time) {
  DemSolver solver(beads.scene(), {0});
  solver.add(start);
  solver.advance(std::llround(time / beads.timeStep));
  return solver.present();
}

std::vector<GrainSeed> shaken(std::vector<GrainSeed> beads) {
  constexpr double shearRate = 0.05, agitation = 0.3;
  for (GrainSeed& s : beads) {
    RandomStream random(3, RandomPurpose::test, s.id);
    s.velocity = Vec3(shearRate * s.position.z(), 0, 0) + agitation * random.direction();
  }
  return beads;
}

std::vector<GrainSeed> nudged(std::vector<GrainSeed> beads) {
  constexpr double speed = 1e-3;
  for (GrainSeed& s : beads) {
    RandomStream random(4, RandomPurpose::test, s.id);
    if (s.species == 0) s.velocity = speed * random.direction();
  }
  return beads;
}

std::vector<GrainSeed> gas(int across, double solidFraction, Beads& beads) {
  const double spacing = std::cbrt(std::numbers::pi / 6 / solidFraction), side = across * spacing;
  beads = {side, side, side, 0, 0, true, false, 0, 1e-4};
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < across * across * across; ++k) {
    RandomStream random(2, RandomPurpose::test, k);
    GrainSeed s;
    s.id = k;
    s.radius = 0.5;
    s.position = spacing * (Vec3(k % across, k / across % across, k / across / across) + Vec3::Constant(0.5));
    s.velocity = 1.7 * random.direction();
    seeds.push_back(s);
  }
  return seeds;
}

} // namespace sandglass::bench
