// Speed of g(r) on one machine: rows of
//   case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,check
// A step is a frame. `check`: largest deviation of g from 1 beyond the hole, in the errors that are quoted;
// the points are uniform.

#include "analysis/neighbours.h"
#include "analysis/pair_correlation.h"
#include "sim/base/random.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>

using namespace sandglass;
using namespace sandglass::analysis;

namespace {

/// Uniform points as dense as a packing of 0.6, unit diameter, in a cube.
Frame cube(std::size_t grains, bool periodic) {
  const double size = std::cbrt(static_cast<double>(grains) * 3.14159265358979 / 6 / 0.6);
  Frame frame;
  frame.domain.upper = Vec3::Constant(size + (periodic ? 0 : 1));
  frame.domain.periodic = {periodic, periodic, periodic};
  RandomStream random(1, RandomPurpose::test, 0);
  const double margin = periodic ? 0 : 0.5;
  for (std::size_t i = 0; i < grains; ++i)
    frame.position.push_back(Vec3(random.uniform(), random.uniform(), random.uniform()) * size +
                             Vec3::Constant(margin));
  frame.scalars[quantity::radius] = std::vector<double>(grains, 0.5);
  if (periodic) return frame;
  for (const auto& kind : wallKinds())
    if (kind.name == "box") {
      Parameters p;
      p.set("lower", Vec3(0, 0, 0));
      p.set("upper", Vec3(frame.domain.upper));
      p.set("open", std::vector<std::string>{});
      FrameWall wall;
      wall.name = "box";
      wall.shape = kind.make(p);
      frame.walls.push_back(wall);
    }
  return frame;
}

std::string row(const std::string& name, const Frame& frame, Estimator estimator, std::size_t threads) {
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  PairCorrelationOptions options;
  options.estimator = estimator;
  const auto wall = std::chrono::steady_clock::now();
  const auto cpu = std::clock();
  const Curve g = pairCorrelation(frame, options).g;
  const double spentCpu = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  const std::chrono::duration<double> spentWall = std::chrono::steady_clock::now() - wall;
  double worst = 0;
  for (std::size_t b = 10; b < g.series[0].y.size(); ++b)
    worst = std::max(worst, std::abs(g.series[0].y[b] - 1) / g.series[0].error[b]);
  return fmt::format("{},sandglass,{},double,{},1,{:.3f},{:.3f},{:.4g},,{:.2f} sigma\n", name, threads,
                     frame.size(), spentCpu, spentWall.count(), static_cast<double>(frame.size()) / spentCpu,
                     worst);
}

} // namespace

int main(int argc, char** argv) {
  const std::string file = argc > 2 && std::string(argv[1]) == "--csv" ? argv[2] : "";
  std::string csv = "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_"
                    "per_grain,check\n";
  const Frame open = cube(100000, true), boxed = cube(100000, false);
  for (const std::size_t threads : {1, 2}) {
    csv += row("gr_100k_periodic_5d", open, Estimator::uncorrected, threads);
    csv += row("gr_100k_box_5d_E3", boxed, Estimator::localShell, threads);
  }
  std::cout << csv;
  if (!file.empty() && !(std::ofstream(file) << csv)) {
    std::cerr << "bench: cannot write " << file << "\n";
    return 1;
  }
}
