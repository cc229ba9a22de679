#include "tests/bench/core_cases.h"

#include "sim/base/error.h"
#include "sim/solvers/dem/dem_solver.h"
#include "tests/bench/beds.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

namespace sandglass::bench {

namespace {

constexpr std::int64_t look = lookStep; // runs are multiples of it where others take part

struct Tile {
  int across = 0, layers = 0;
  std::vector<GrainSeed> grains;
  double side() const { return across * tileSpacing; }
};

/// Each tile is settled once.
const Tile& tile(int across, int layers, bool quick) {
  static std::map<std::pair<int, int>, Tile> made;
  Tile& t = made[{across, layers}];
  if (t.grains.empty()) t = {across, layers, settledTile(across, layers, quick)};
  return t;
}

Scene clampedScene(Beads beads) {
  beads.clamped = true;
  return beads.scene();
}

/// A bed on the ground that `beads` describes.
CoreCase bed(const std::string& name, const Beads& beads, std::vector<GrainSeed> grains, std::int64_t steps,
             bool peers) {
  CoreCase c{name, beads.scene(), std::move(grains), {}, steps, {}, {}, {}, {}, {}};
  if (peers) {
    c.yadeScript = beads.yadeScript(look);
    c.clamped = clampedScene(beads);
    c.lammpsDeck = beads.lammpsDeck(look);
    c.liggghtsDeck = beads.liggghtsDeck(look);
  }
  return c;
}

/// nx times ny tiles.
Beads ground(const Tile& t, int nx, int ny, double angle = 0) {
  return {nx * t.side(), ny * t.side(), 2.0 * t.layers + 10, angle};
}

/// Settled tiles on a level floor.
CoreCase levelBed(const std::string& name, const Tile& t, int nx, int ny, bool friction, std::int64_t steps) {
  Beads beads = ground(t, nx, ny);
  beads.friction = friction;
  return bed(name, beads, tiled(t.grains, t.side(), nx, ny), steps, false);
}

enum class Chute { rest, flowing, shaken };

/// 32,000 beads on a slope of 26 degrees.
CoreCase chute(const std::string& name, bool quick, Chute kind) {
  constexpr double flowTime = 6, shortTime = 0.3, shakenTime = 2;
  const Tile& t = tile(10, 40, quick);
  Beads one = ground(t, 1, 1, 26), whole = ground(t, 4, 2, 26);
  one.rough = whole.rough = kind != Chute::shaken;
  // In flow so long that everybody's lists are made anew several times.
  const std::int64_t steps = quick ? look : kind == Chute::rest ? 4 * look : 10 * look;
  // Shaken, one tile flows and is repeated. Over the rough floor all flow, each tile in its own way: how often
  // lists are made anew depends on the fastest few of all grains.
  const bool repeated = kind == Chute::shaken;
  std::vector<GrainSeed> grains = repeated ? shaken(t.grains) : roughened(t.grains);
  if (repeated) grains = after(one, grains, quick ? shortTime : shakenTime);
  grains = tiled(grains, t.side(), 4, 2);
  if (kind == Chute::flowing) grains = after(whole, nudged(grains), quick ? shortTime : flowTime);
  return bed(name, whole, grains, steps, true);
}

CoreCase dilute(bool quick) {
  Beads beads;
  const auto grains = gas(quick ? 16 : 32, 0.05, beads);
  return {"dilute_gas",
          beads.scene(),
          grains,
          {},
          quick ? look : 4 * look,
          beads.lammpsDeck(look),
          {},
          beads.yadeScript(look),
          clampedScene(beads),
          {}};
}

/// Runs a scene's first stage and, where it has a gate, a while of the next.
CoreCase prepared(const std::string& name, const Scene& scene, std::int64_t settle, std::int64_t flow,
                  std::int64_t steps) {
  DemSolver solver(scene, {0});
  solver.add(placeGrains(scene, scene.stages.front().name, 0, {}));
  solver.advance(settle);
  if (scene.stages.size() > 1)
    for (const std::string& wall : scene.stages[1].removeWalls)
      solver.removeWall(wall);
  solver.advance(flow);
  CoreCase made;
  made.name = name;
  made.scene = scene;
  made.state = solver.save();
  made.steps = steps;
  return made;
}

CoreCase conicalHopper(bool quick) {
  const std::string file = std::string(SANDGLASS_SOURCE_DIR) + "/sample_runs/hopper_conical/scene.toml";
  Scene scene =
      readScene(file, quick ? std::vector<std::string>{"fill.1.number=2000"} : std::vector<std::string>{});
  CoreCase c =
      prepared("hopper_conical", scene, quick ? 2000 : 12000, quick ? 1000 : 6000, quick ? 300 : 1000);
  c.whyNoPeers = "none of them has its rolling law (an elastic-plastic couple)";
  return c;
}

/// Half the mass in grains ten times as large as the others, falling on a floor.
CoreCase binary(bool quick) {
  const peers::HookeHistory law{2000, 2.0 / 7.0 * 2000, 1000, 0, 0.5, false};
  const Scene scene =
      parseScene(fmt::format(R"(
title = "bench"
[domain]
lower = ["0", "0", "-5 mm"]
upper = ["40 mm", "40 mm", "400 mm"]
periodic = ["x", "y"]
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[contact]]
between = ["glass", "glass"]
normal = {{ law = "linear", stiffness = "{0:.17g} N/m", damping_rate = "{1:.17g} 1/s" }}
tangential = {{ law = "spring", friction = {3}, stiffness_ratio = {2:.17g}, rotation = "project", arm = "radius" }}
[[species]]
name = "small"
material = "glass"
size = {{ distribution = "single", diameter = "1 mm" }}
[[species]]
name = "large"
material = "glass"
size = {{ distribution = "single", diameter = "10 mm" }}
[[wall]]
name = "floor"
kind = "plane"
material = "glass"
point = ["0", "0", "0"]
normal = [0, 0, 1]
[[fill]]
kind = "random"
region = "box"
lower = ["0", "0", "0"]
upper = ["40 mm", "40 mm", "80 mm"]
mixture = [{{ species = "small", fraction = 0.5 }}, {{ species = "large", fraction = 0.5 }}]
by = "mass"
mass = "{4} g"
[[stage]]
name = "settle"
until = {{ duration = "1 s" }}
)",
                             law.normalStiffness, law.normalDamping,
                             law.tangentialStiffness / law.normalStiffness, law.friction, quick ? 10 : 100),
                 "bench");
  DemSolver solver(scene, {0});
  solver.add(placeGrains(scene, "settle", 0, {}));
  solver.advance(quick ? 3000 : 20000);
  CoreCase c;
  c.name = "binary_1_10";
  c.scene = scene;
  c.grains = solver.present(); // contacts begin anew, as they do in LAMMPS
  c.steps = quick ? look : 5 * look;
  c.lammpsDeck = peers::lammpsOpening(scene, "grains.data") +
                 fmt::format("pair_style {}\npair_coeff * *\nneighbor 1e-4 multi\ncomm_modify mode multi\n"
                             "neigh_modify every 1 delay 0\ntimestep {:.17g}\n"
                             "fix weight all gravity 9.81 vector 0 0 -1\nfix motion all nve/sphere\n"
                             "fix floor all wall/gran {} zplane 0 NULL\ncompute kinetic all ke\n"
                             "thermo_style custom step atoms c_kinetic\n"
                             "thermo_modify norm no format float %.17g\nthermo {}\n",
                             law.words(), solver.stepSize(), law.wallWords(), look);
  return c;
}

using Maker = std::function<CoreCase(bool)>;

const std::vector<std::pair<std::string, Maker>>& makers() {
  static const std::vector<std::pair<std::string, Maker>> all{
      {"chute_rest", [](bool q) { return chute("chute_rest", q, Chute::rest); }},
      {"chute_flowing", [](bool q) { return chute("chute_flowing", q, Chute::flowing); }},
      {"chute_shaken", [](bool q) { return chute("chute_shaken", q, Chute::shaken); }},
      {"bed_1e5",
       [](bool q) {
         const Tile& t = tile(10, 25, q);
         const int nx = q ? 2 : 8, ny = q ? 1 : 5;
         // At rest there is no energy to compare; see docs/performance.md.
         std::vector<GrainSeed> grains = dropped(tiled(t.grains, t.side(), nx, ny), 0.5);
         return bed("bed_1e5", ground(t, nx, ny), std::move(grains), q ? look : 2 * look, true);
       }},
      {"bed_1e4",
       [](bool q) { return levelBed("bed_1e4", tile(10, 25, q), 2, q ? 1 : 2, true, q ? look : 10 * look); }},
      {"bed_1e4_frictionless",
       [](bool q) {
         return levelBed("bed_1e4_frictionless", tile(10, 25, q), 2, q ? 1 : 2, false, q ? look : 10 * look);
       }},
      {"bed_1e5_frictionless",
       [](bool q) {
         return levelBed("bed_1e5_frictionless", tile(10, 25, q), q ? 2 : 8, q ? 1 : 5, false,
                         q ? look : 2 * look);
       }},
      {"bed_1e6",
       [](bool q) { return levelBed("bed_1e6", tile(10, 25, q), q ? 4 : 20, q ? 2 : 20, true, 60); }},
      {"hopper_conical", conicalHopper},
      {"binary_1_10", binary},
      {"dilute_gas", dilute},
  };
  return all;
}

} // namespace

std::vector<std::string> coreCaseNames() {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers())
    names.push_back(name);
  return names;
}

CoreCase makeCoreCase(const std::string& name, bool quick) {
  for (const auto& [known, make] : makers())
    if (known == name) return make(quick);
  throw InputError(
      fmt::format("there is no case '{}'; there are: {}", name, fmt::join(coreCaseNames(), " ")));
}

} // namespace sandglass::bench
