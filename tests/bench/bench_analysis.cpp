// Speed of the analyses on one machine: rows of
//   case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,check
// with --csv FILE, --case NAME for one of them. A step is a frame. g(r) of uniform points is checked by its
// largest deviation from 1 beyond the hole, in the errors that are quoted; the others by a number that must
// not change. Points are hard spheres of 0.3 by random sequential addition for what looks at neighbours and
// voids, uniform points for g(r).

#include "analysis/coarse_graining.h"
#include "analysis/containing_sizes.h"
#include "analysis/neighbour_list.h"
#include "analysis/pair_correlation.h"
#include "analysis/steinhardt.h"
#include "analysis/voronoi.h"
#include "sim/base/random.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <voro++/voro++.hh>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <numeric>
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
  for (std::size_t i = 0; i < grains; ++i) {
    frame.position.push_back(Vec3(random.uniform(), random.uniform(), random.uniform()) * size +
                             Vec3::Constant(margin));
    frame.id.push_back(static_cast<std::int64_t>(i));
  }
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

/// A packing's order and its disorder: fcc of fraction 0.6, each centre displaced by up to a tenth of the gap
/// to the next ones and more, so that neighbours are as many and as irregular as in a bed.
Frame packing(std::size_t cells, bool unequal = false) {
  const double a = std::cbrt(4 * 3.14159265358979 / 6 / 0.6);
  Frame frame;
  frame.domain.upper = Vec3::Constant(a * static_cast<double>(cells));
  frame.domain.periodic = {true, true, true};
  RandomStream random(2, RandomPurpose::test, 0);
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t j = 0; j < cells; ++j)
      for (std::size_t k = 0; k < cells; ++k)
        for (const Vec3& b :
             {Vec3(0.1, 0.1, 0.1), Vec3(0.6, 0.6, 0.1), Vec3(0.6, 0.1, 0.6), Vec3(0.1, 0.6, 0.6)})
          frame.position.push_back(
              a * (Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) + b) +
              0.09 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
  const std::size_t n = frame.position.size();
  auto& radius = frame.scalars[quantity::radius];
  for (std::size_t i = 0; i < n; ++i) {
    frame.id.push_back(static_cast<std::int64_t>(i));
    radius.push_back(unequal ? 0.4 + 0.2 * random.uniform() : 0.5);
    frame.vectors[quantity::velocity].push_back(random.direction());
  }
  return frame;
}

class Rows {
public:
  /// The work returns its check.
  void add(const std::string& name, const std::string& program, std::size_t threads, std::size_t grains,
           const std::function<std::string()>& work) {
    // An arena of its own: that of the main thread keeps the size which it had when it was first used.
    tbb::task_arena arena(static_cast<int>(threads));
    const auto wall = std::chrono::steady_clock::now();
    const auto cpu = std::clock();
    std::string check;
    arena.execute([&] { check = work(); });
    const double spentCpu = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const std::chrono::duration<double> spentWall = std::chrono::steady_clock::now() - wall;
    const std::string row =
        fmt::format("{},{},{},double,{},1,{:.3f},{:.3f},{:.4g},,{}\n", name, program, threads, grains,
                    spentCpu, spentWall.count(), static_cast<double>(grains) / spentCpu, check);
    std::cout << row << std::flush;
    csv_ += row;
  }
  const std::string& csv() const { return csv_; }

private:
  std::string csv_ =
      "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,"
      "check\n";
};

std::string gr(const Frame& frame, Estimator estimator) {
  PairCorrelationOptions options;
  options.estimator = estimator;
  const Curve g = pairCorrelation(frame, options).g;
  double worst = 0;
  for (std::size_t b = 10; b < g.series[0].y.size(); ++b)
    worst = std::max(worst, std::abs(g.series[0].y[b] - 1) / g.series[0].error[b]);
  return fmt::format("{:.2f} sigma", worst);
}

std::string voronoi(const Frame& frame) {
  VoronoiOptions options;
  options.diameter = 1;
  const auto cells = voronoiCells(frame, options);
  double sum = 0;
  for (const double v : cells.volume)
    if (std::isfinite(v)) sum += v;
  return fmt::format("{:.1e} of the box missing", std::abs(sum / frame.domain.upper.prod() - 1));
}

/// voro++'s own container and loop, with the same results asked for.
std::string voroppItself(const Frame& frame) {
  const Vec3 size = frame.domain.upper;
  const int blocks = static_cast<int>(std::cbrt(static_cast<double>(frame.size()) / 5.6));
  voro::container_poly container(0, size.x(), 0, size.y(), 0, size.z(), blocks, blocks, blocks, true, true,
                                 true, 8);
  for (std::size_t i = 0; i < frame.size(); ++i)
    container.put(static_cast<int>(i), frame.position[i].x(), frame.position[i].y(), frame.position[i].z(),
                  frame.scalar(quantity::radius)[i]);
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  std::vector<int> neighbours;
  std::vector<double> areas, normals;
  double sum = 0;
  if (loop.start()) do
      if (container.compute_cell(cell, loop)) {
        sum += cell.volume();
        cell.neighbors(neighbours);
        cell.face_areas(areas);
        cell.normals(normals);
      }
    while (loop.inc());
  return fmt::format("{:.1e} of the box missing", std::abs(sum / size.prod() - 1));
}

std::string q6(const Frame& frame) {
  const NeighbourList list = neighboursWithin(frame.position, frame.domain, 1.4);
  const auto q = magnitudes(bondOrder({list.start, list.index, list.vector, {}}, 6));
  return fmt::format("mean {:.12f}",
                     std::accumulate(q.begin(), q.end(), 0.0) / static_cast<double>(q.size()));
}

std::string v1(const Frame& frame, std::size_t probes) {
  const Region region(frame, {});
  const SurfaceDistance distance(frame, 1, 3);
  const VoidPoints points = voidPoints(distance, region, probes, 0, 1);
  return fmt::format("porosity {:.6f}",
                     static_cast<double>(points.point.size()) / static_cast<double>(points.tried));
}

std::string v2(const Frame& frame) {
  const Region region(frame, {});
  const SurfaceDistance distance(frame, 1, 3);
  VoidPoints points = voidPoints(distance, region, 125000, 0, 1); // 50000 of them in voids
  const VoronoiCells cells = cellsForVoids(frame, {}, 1);
  const auto found = holes(frame, cells, distance, region, points, 1);
  points.distance = climbedSizes(distance, region, points, 1);
  const auto sizes = containingSizes(frame, cells, distance, region, found, points, 3, 1);
  return fmt::format("mean {:.9f}",
                     std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size()));
}

std::string fields(const Frame& frame, int nodes) {
  std::vector<Vec3> points;
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      for (int k = 0; k < nodes; ++k)
        points.push_back(frame.domain.upper.cwiseProduct(Vec3(k, j, i)) / nodes);
  const CoarseGrainer grainer(frame, 1, 1, 1);
  double mass = 0;
  for (const auto& a : grainer.at(points))
    mass += a.mass;
  return fmt::format("mean density {:.9f}", mass / static_cast<double>(points.size()));
}

} // namespace

int main(int argc, char** argv) {
  std::string file, only;
  for (int k = 1; k + 1 < argc; k += 2)
    (std::string(argv[k]) == "--csv" ? file : only) = argv[k + 1];
  const Frame open = cube(100000, true), boxed = cube(100000, false), million = cube(1000000, true);
  const Frame bed = packing(29), mixed = packing(29, true), large = packing(63); // 97556 and 1000188 grains
  Rows rows;
  for (const std::size_t threads : {1, 2}) {
    const auto add = [&](const std::string& name, const Frame& frame,
                         const std::function<std::string()>& work) {
      if (only.empty() || name == only) rows.add(name, "sandglass", threads, frame.size(), work);
    };
    add("gr_100k_periodic_5d", open, [&] { return gr(open, Estimator::uncorrected); });
    add("gr_100k_box_5d_E3", boxed, [&] { return gr(boxed, Estimator::localShell); });
    add("gr_1m_periodic_5d", million, [&] { return gr(million, Estimator::uncorrected); });
    add("voronoi_radical_100k", mixed, [&] { return voronoi(mixed); });
    if (threads == 1 && (only.empty() || only == "voronoi_radical_100k"))
      rows.add("voronoi_radical_100k", "voro++", 1, mixed.size(), [&] { return voroppItself(mixed); });
    add("q6_100k", bed, [&] { return q6(bed); });
    add("voids_v1_1m_probes", bed, [&] { return v1(bed, 1000000); });
    add("voids_v2_100k", bed, [&] { return v2(bed); });
    add("fields_1m_64", large, [&] { return fields(large, 64); });
  }
  if (!file.empty() && !(std::ofstream(file) << rows.csv())) {
    std::cerr << "bench: cannot write " << file << "\n";
    return 1;
  }
}
