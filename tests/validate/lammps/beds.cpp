// Beds let fall from a jittered lattice, in each program by itself: height, coordination number and stresses
// of what comes to rest. Many low beds rather than few high ones: the column that swings up and down after
// the fall dies out with the square of its height, and until it has, stresses swing too; and what is left is
// the scatter of packings, which many beds average.

#include "analysis/statistics.h"
#include "sim/base/random.h"
#include "sim/solvers/dem/dem_solver.h"
#include "tests/validate/lammps/cases.h"

#include <fmt/format.h>

#include <cmath>
#include <future>
#include <iostream>
#include <numbers>

namespace sandglass::validate {

namespace {

// Units of grain diameter, mass of a cube of it, gravity 1.
constexpr double timeStep = 3e-4, side = 10.5;
constexpr int across = 10;

struct Bed {
  double height = 0;                ///< twice the mean height of the centres
  double coordination = 0;          ///< contacts with grains, a grain
  double vertical = 0, lateral = 0; ///< sum over contacts of branch times force [energy], a grain
};

Scene bedScene(const SharedLaw& law, double top) {
  return parseScene(fmt::format(R"(
title = "bed"
gravity = ["0", "0", "-1 m/s^2"]
[domain]
lower = ["0", "0", "-1 m"]
upper = ["{0} m", "{0} m", "{1} m"]
periodic = ["x", "y"]
[[material]]
name = "bead"
density = "1 kg/m^3"
{2}
[[species]]
name = "bead"
material = "bead"
size = {{ distribution = "single", diameter = "1 m" }}
[[wall]]
name = "floor"
kind = "plane"
material = "bead"
point = ["0", "0", "0"]
normal = [0, 0, 1]
[[fill]]
kind = "list"
grains = [{{ position = ["0.5 m", "0.5 m", "0.6 m"] }}]
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
[output]
quantities = ["velocity"]
contacts = true
[accuracy]
time_step = "{3} s"
)",
                                side, top, law.contact("bead", "bead"), timeStep),
                    "bed");
}

std::vector<GrainSeed> lattice(std::uint64_t seed, int layers) {
  std::vector<GrainSeed> grains;
  const double spacing = side / across;
  for (int k = 0; k < across * across * layers; ++k) {
    RandomStream random(seed, RandomPurpose::test, k);
    GrainSeed g;
    g.id = k;
    g.radius = 0.5;
    const Vec3 cell(k % across, k / across % across, k / (across * across));
    g.position = spacing * (cell + Vec3::Constant(0.5)) + 0.02 * random.direction();
    g.velocity = 0.5 * random.direction();
    grains.push_back(g);
  }
  return grains;
}

Bed ours(const Scene& scene, const std::vector<GrainSeed>& grains, std::int64_t steps) {
  DemSolver solver(scene, {1});
  solver.add(grains);
  solver.advance(steps);
  const FramePtr f = solver.frame();
  Bed bed;
  const double n = static_cast<double>(f->size());
  for (const Vec3& x : f->position)
    bed.height += 2 * x.z() / n;
  for (const FrameContact& c : f->contacts) {
    if (c.b < 0) continue;
    Vec3 branch = f->position[c.a] - f->position[c.b]; // ids are places here
    for (int k = 0; k < 2; ++k)
      branch[k] -= side * std::round(branch[k] / side);
    bed.coordination += 2 / n;
    bed.vertical += branch.z() * c.force.z() / n;
    bed.lateral += 0.5 * (branch.x() * c.force.x() + branch.y() * c.force.y()) / n;
  }
  return bed;
}

Bed theirs(const Scene& scene, const SharedLaw& law, const std::vector<GrainSeed>& grains,
           std::int64_t steps) {
  const peers::ScratchFolder scratch;
  peers::writeLammpsData(scratch.path() / "grains.data", scene, grains);
  std::string deck = peers::lammpsOpening(scene, "grains.data");
  deck += fmt::format(R"(pair_style {}
pair_coeff * *
neighbor 0.1 bin
neigh_modify every 1 delay 0
timestep {}
fix weight all gravity 1 vector 0 0 -1
fix motion all nve/sphere
fix floor all wall/gran {} zplane 0 NULL
compute touching all contact/atom
compute stress all stress/atom NULL pair
compute z all property/atom z
compute meanz all reduce ave c_z
compute contacts all reduce ave c_touching
compute s all reduce ave c_stress[1] c_stress[2] c_stress[3]
thermo_style custom step c_meanz c_contacts c_s[1] c_s[2] c_s[3]
thermo_modify norm no format float %.15g
thermo {}
run {}
)",
                      law.coefficients().words(), timeStep, law.coefficients().wallWords(), steps, steps);
  const auto run = peers::runLammps(scratch.path(), deck, 1);
  const auto& last = run.loops.front().thermo.back();
  Bed bed;
  bed.height = 2 * last.at("c_meanz");
  bed.coordination = last.at("c_contacts");
  // stress/atom is minus the stress times volume, here that of pairs alone.
  bed.lateral = -0.5 * (last.at("c_s[1]") + last.at("c_s[2]"));
  bed.vertical = -last.at("c_s[3]");
  return bed;
}

} // namespace

void compareBeds(Report& report, const std::vector<std::uint64_t>& seeds, bool quick) {
  // The slowest mode, a quarter of a wave over the height H: w = pi/2 sqrt(k/m)/H = 25 for 12 layers; it is
  // damped by w^2 rate m / (4 k) = 1.6 a unit of time, so nothing of it is left after the 9 units of the run.
  const int layers = quick ? 6 : 12;
  const std::int64_t steps = quick ? 8000 : 30000;
  const SharedLaw law{2e4, 400, 0.5};
  const Scene scene = bedScene(law, 2.0 * layers + 10);
  std::vector<std::vector<double>> a(4), b(4);
  for (const std::uint64_t seed : seeds) {
    const auto grains = lattice(seed, layers);
    auto other = std::async(std::launch::async, [&] { return theirs(scene, law, grains, steps); });
    const Bed o = ours(scene, grains, steps), t = other.get();
    std::cerr << fmt::format(
        "bed {}: height {:.4f} {:.4f}, coordination {:.4f} {:.4f}, vertical stress {:.4f} {:.4f}, "
        "lateral {:.4f} {:.4f}\n",
        seed, o.height, t.height, o.coordination, t.coordination, o.vertical, t.vertical, o.lateral,
        t.lateral);
    const double ov[] = {o.height, o.coordination, o.vertical, o.lateral};
    const double tv[] = {t.height, t.coordination, t.vertical, t.lateral};
    for (int k = 0; k < 4; ++k) {
      a[k].push_back(ov[k]);
      b[k].push_back(tv[k]);
    }
  }
  const char* const names[] = {"height", "coordination number", "vertical stress", "lateral stress"};
  for (int k = 0; k < 4; ++k) {
    // Both programs drop the same lattice, and beds from one lattice are alike: ratios bed by bed.
    std::vector<double> ratios;
    for (std::size_t i = 0; i < a[k].size(); ++i)
      ratios.push_back(a[k][i] / b[k][i]);
    const double n = static_cast<double>(ratios.size());
    const double spread =
        n < 2 ? 0 : analysis::studentFactor(0.95, n - 1) * std::sqrt(analysis::variance(ratios) / n);
    report.near("settled bed", fmt::format("{} over that of LAMMPS, {} beds", names[k], a[k].size()),
                analysis::mean(ratios), spread, 1, 0.01,
                fmt::format("LAMMPS, its mean {:.4g}", analysis::mean(b[k])));
  }
}

} // namespace sandglass::validate
