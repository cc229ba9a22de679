// Discharge through a slot in a flat floor, periodic in depth: three beds that one program has settled, each
// emptied by both. In LAMMPS floor and lip are two blocks.

#include "analysis/discharge.h"
#include "analysis/statistics.h"
#include "sim/solvers/dem/dem_solver.h"
#include "tests/validate/lammps/cases.h"

#include <fmt/format.h>

#include <cmath>
#include <future>
#include <iostream>
#include <numbers>

namespace sandglass::validate {

namespace {

constexpr double diameter = 2.24e-3, density = 2500, width = 7.5e-2, outlet = 2.5e-2, depth = 0.56e-2;
constexpr double lip = 0.45e-2, below = 2e-2, timeStep = 2.5e-5;
constexpr int every = 80; ///< steps between two counts

Scene slotScene(const SharedLaw& law, int number, std::uint64_t seed, bool gate) {
  return parseScene(
      fmt::format(R"(
title = "slot"
seed = {0}
gravity = ["0", "-9.81 m/s^2", "0"]
[domain]
lower = ["-4 cm", "-{1} m", "-2.8 mm"]
upper = ["4 cm", "30 cm", "2.8 mm"]
periodic = ["z"]
[[material]]
name = "glass"
density = "{2} kg/m^3"
{3}
[[species]]
name = "bead"
material = "glass"
size = {{ distribution = "single", diameter = "{4} m" }}
[[wall]]
name = "hopper"
kind = "wedge"
material = "glass"
outlet = "{5} m"
width = "{6} m"
half_angle = "90 deg"
height = "30 cm"
lip = "{7} m"
{8}
[[outlet]]
name = "below"
point = ["0", "-{9} m", "0"]
normal = [0, -1, 0]
[[fill]]
kind = "random"
species = "bead"
region = "box"
lower = ["-3.75 cm", "0", "-2.8 mm"]
upper = ["3.75 cm", "25 cm", "2.8 mm"]
number = {10}
[[stage]]
name = "settle"
until = {{ duration = "1 s" }}
[accuracy]
time_step = "{11} s"
)",
                  seed, below + 0.01, density, law.contact("glass", "glass"), diameter, outlet, width, lip,
                  gate ? fmt::format("[[wall]]\nname = \"gate\"\nkind = \"rectangle\"\n"
                                     "material = \"glass\"\ncentre = [\"0\", \"0\", \"0\"]\n"
                                     "normal = [0, 1, 0]\nalong = [1, 0, 0]\nlength = \"{} m\"\n"
                                     "breadth = \"10 cm\"",
                                     outlet)
                       : "",
                  below, number, timeStep),
      "slot");
}

double rateOf(const std::vector<double>& time, const std::vector<double>& left, int number) {
  analysis::DischargeData data;
  const double mass = std::numbers::pi / 6 * std::pow(diameter, 3) * density;
  data.time = time;
  for (const double n : left)
    data.mass.push_back(mass * (number - n));
  analysis::DischargeOptions options;
  options.shares = {0.1, 0.5};
  options.totalMass = mass * number;
  return 10 * analysis::fitDischarge(data, options).rate / depth; // g/(cm s)
}

double ours(const Scene& scene, const std::vector<GrainSeed>& grains, int counts) {
  DemSolver solver(scene, {1});
  solver.add(grains);
  std::vector<double> time, left;
  for (int k = 0; k <= counts; ++k) {
    if (k > 0) solver.advance(every);
    double above = 0;
    for (const GrainSeed& g : solver.present())
      above += g.position.y() > -lip;
    time.push_back(solver.time());
    left.push_back(above);
  }
  return rateOf(time, left, static_cast<int>(grains.size()));
}

double theirs(const Scene& scene, const SharedLaw& law, const std::vector<GrainSeed>& grains, int counts) {
  const peers::ScratchFolder scratch;
  peers::writeLammpsData(scratch.path() / "grains.data", scene, grains);
  const std::string wall = law.coefficients().wallWords();
  std::string deck = peers::lammpsOpening(scene, "grains.data");
  deck += fmt::format(R"(pair_style {0}
pair_coeff * *
neighbor 2e-4 bin
neigh_modify every 1 delay 0
timestep {1}
region left block -1 -{2} -{3} 0 INF INF side out
region right block {2} 1 -{3} 0 INF INF side out
region above block INF INF -{3} INF INF INF
fix weight all gravity 9.81 vector 0 -1 0
fix motion all nve/sphere
fix sides all wall/gran {4} xplane -{5} {5}
fix left all wall/gran/region {4} region left
fix right all wall/gran/region {4} region right
variable left equal count(all,above)
thermo_style custom step v_left
thermo_modify norm no lost ignore
thermo {6}
run {7}
)",
                      law.coefficients().words(), timeStep, 0.5 * outlet, lip, wall, 0.5 * width, every,
                      every * counts);
  const auto run = peers::runLammps(scratch.path(), deck, 1);
  std::vector<double> time, left;
  for (const auto& row : run.loops.front().thermo) {
    time.push_back(row.at("Step") * timeStep);
    left.push_back(row.at("v_left"));
  }
  return rateOf(time, left, static_cast<int>(grains.size()));
}

} // namespace

void compareHoppers(Report& report, const std::vector<std::uint64_t>& seeds, bool quick) {
  const int number = quick ? 2500 : 3500, counts = quick ? 160 : 260;
  // Restitution 0.94 of two grains: exp(-rate t_c / 2), t_c = 5.2e-4 s.
  const SharedLaw law{250, 235, 0.2};
  std::vector<double> a, b, difference;
  for (const std::uint64_t seed : seeds) {
    const Scene closed = slotScene(law, number, seed, true);
    DemSolver settling(closed, {0});
    settling.add(placeGrains(closed, "settle", 0, {}));
    settling.advance(quick ? 12000 : 32000);
    const auto grains = settling.present();
    const Scene open = slotScene(law, number, seed, false);
    auto other = std::async(std::launch::async, [&] { return theirs(open, law, grains, counts); });
    a.push_back(ours(open, grains, counts));
    b.push_back(other.get());
    difference.push_back(a.back() / b.back() - 1);
    std::cerr << fmt::format("slot, bed {}: {:.2f}, LAMMPS {:.2f} g/(cm s)\n", seed, a.back(), b.back());
  }
  const std::string name = "slot hopper";
  const double n = static_cast<double>(a.size());
  const double mean = analysis::mean(difference);
  const double half =
      n < 2 ? 0 : analysis::studentFactor(0.95, n - 1) * std::sqrt(analysis::variance(difference) / n);
  report.recorded(name, "rate per depth [g/(cm s)], mean of the beds", analysis::mean(a), 0,
                  fmt::format("{:.4g}", analysis::mean(b)), "LAMMPS, the same settled beds",
                  "the rows below judge");
  report.between(name, "difference of the rates, paired by bed", mean, half, -0.03, 0.03, "LAMMPS");
  report.between(name, "size of the difference over the half width of its 95 % interval",
                 half > 0 ? std::abs(mean) / half : 0, 0, 0, 1, "no difference beyond chance");
}

} // namespace sandglass::validate
