// Speed of the contact core on one machine: rows of
//   case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,check
// `check` is a hash of all positions and velocities: equal for equal physics, whatever the threads.

#include "sim/base/random.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>
#define XXH_INLINE_ALL // header only
#include <xxhash.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>

using namespace sandglass;

namespace {

/// A bed of equal beads over a floor, periodic sideways: dry, frictional, with history.
Scene bedScene(int across, bool friction) {
  const double width = across * 2.05e-3;
  return parseScene(fmt::format(R"(
title = "bed"
gravity = ["0", "0", "-9.81 m/s^2"]
[domain]
lower = ["0 m", "0 m", "-1 cm"]
upper = ["{0} m", "{0} m", "2 m"]
periodic = ["x", "y"]
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[contact]]
between = ["glass", "glass"]
normal = {{ law = "linear", stiffness = "500 N/m", restitution = 0.8 }}
tangential = {1}
[[species]]
name = "bead"
material = "glass"
size = {{ distribution = "single", diameter = "2 mm" }}
[[wall]]
name = "floor"
kind = "plane"
material = "glass"
point = ["0", "0", "0"]
normal = [0, 0, 1]
[[fill]]
kind = "list"
grains = [{{ position = ["2 mm", "2 mm", "2 mm"], species = "bead" }}]
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
)",
                                width,
                                friction ? R"({ law = "spring", friction = 0.5 })" : R"({ law = "none" })"),
                    "bench");
}

std::vector<GrainSeed> bed(int across, int layers) {
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < across * across * layers; ++k) {
    RandomStream random(1, RandomPurpose::test, k);
    GrainSeed s;
    s.id = k;
    s.radius = 1e-3;
    s.position = 2.05e-3 * Vec3(k % across + 0.5, k / across % across + 0.5, k / across / across + 0.5);
    s.velocity = 0.05 * random.direction();
    seeds.push_back(s);
  }
  return seeds;
}

double cpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::string hashOf(const Solver& solver) {
  std::vector<double> all;
  for (const GrainSeed& s : solver.present())
    for (const Vec3* v : {&s.position, &s.velocity, &s.spin})
      all.insert(all.end(), v->data(), v->data() + 3);
  return fmt::format("{:016x}", XXH3_64bits(all.data(), all.size() * sizeof(double)));
}

std::string row(const std::string& name, DemSolver& solver, int threads, std::int64_t steps) {
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpuSeconds();
  const std::int64_t rebuilds = solver.rebuilds();
  solver.advance(steps);
  const double spentCpu = cpuSeconds() - cpu;
  const std::chrono::duration<double> spentWall = std::chrono::steady_clock::now() - wall;
  const double grainSteps = static_cast<double>(solver.grains()) * static_cast<double>(steps);
  fmt::print(stderr,
             "{}: {:.2f} million grain-steps per wall second, {:.2f} pairs listed a grain, a list lasts "
             "{:.0f} steps\n",
             name, grainSteps / spentWall.count() / 1e6,
             static_cast<double>(solver.pairsListed()) / static_cast<double>(solver.grains()),
             static_cast<double>(steps) /
                 static_cast<double>(std::max<std::int64_t>(1, solver.rebuilds() - rebuilds)));
  return fmt::format("{},sandglass,{},double,{},{},{:.3f},{:.3f},{:.4g},{:.0f},{}\n", name, threads,
                     solver.grains(), steps, spentCpu, spentWall.count(), grainSteps / spentCpu,
                     solver.bytesPerGrain(), hashOf(solver));
}

} // namespace

int main(int argc, char** argv) {
  const std::string file = argc > 2 && std::string(argv[1]) == "--csv" ? argv[2] : "";
  std::string csv = "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_"
                    "per_grain,check\n";
  for (const bool friction : {true, false})
    for (const int threads : {1, 2}) {
      const int across = 20, layers = 25;
      DemSolver solver(bedScene(across, friction), {threads});
      solver.add(bed(across, layers));
      const std::string name = friction ? "bed_10k" : "bed_10k_frictionless";
      csv += row(name + "_settling", solver, threads, 6000);
      csv += row(name + "_settled", solver, threads, 3000);
    }
  std::cout << csv;
  if (!file.empty() && !(std::ofstream(file) << csv)) {
    std::cerr << "bench: cannot write " << file << "\n";
    return 1;
  }
}
