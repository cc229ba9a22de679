#include "analysis/void_sizes.h"

#include "analysis/quasi_random.h"
#include "analysis/voronoi.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace sandglass::analysis {

VoidPoints voidPoints(const SurfaceDistance& distance, const Region& region, std::size_t probes,
                      double wallDistance, std::uint64_t seed) {
  constexpr std::size_t block = 4096;
  const std::size_t blocks = (probes + block - 1) / block;
  std::vector<VoidPoints> piece(blocks);
  const Vec3 size = region.box().sizes();
  const QuasiRandom3 sequence(seed, 0x766f6964ULL);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    VoidPoints& mine = piece[b];
    for (std::size_t n = b * block; n < std::min(probes, (b + 1) * block); ++n) {
      const auto u = sequence(n);
      const Vec3 x = region.box().min() + size.cwiseProduct(Vec3(u[0], u[1], u[2]));
      if (!region.contains(x)) continue;
      ++mine.tried;
      const double grains = distance.toGrains(x).distance;
      if (!(grains > 0)) continue;
      const double walls = distance.toWalls(x);
      mine.point.push_back(x);
      mine.distance.push_back(std::min(grains, walls));
      mine.nearWall.push_back(walls < wallDistance);
    }
  });
  VoidPoints all;
  for (const auto& p : piece) {
    all.point.insert(all.point.end(), p.point.begin(), p.point.end());
    all.distance.insert(all.distance.end(), p.distance.begin(), p.distance.end());
    all.nearWall.insert(all.nearWall.end(), p.nearWall.begin(), p.nearWall.end());
    all.tried += p.tried;
  }
  return all;
}

namespace {

/// Largest first, and one of each set that agrees to a ten thousandth of the diameter: cells share their
/// vertices.
std::vector<EmptySphere> unique(const std::vector<EmptySphere>& spheres, double diameter) {
  struct Keyed {
    std::array<std::int64_t, 3> key;
    std::size_t index;
  };
  std::vector<Keyed> keyed(spheres.size());
  tbb::parallel_for(std::size_t{0}, spheres.size(), [&](std::size_t s) {
    Keyed& k = keyed[s];
    k.index = s;
    // Shifted, so that the round coordinates of lattices do not lie on the border between two keys.
    for (int a = 0; a < 3; ++a)
      k.key[static_cast<std::size_t>(a)] =
          static_cast<std::int64_t>(std::floor(spheres[s].centre[a] / (1e-4 * diameter) + 0.31415926));
  });
  tbb::parallel_sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  });
  std::vector<EmptySphere> kept;
  for (std::size_t k = 0; k < keyed.size(); ++k)
    if (k == 0 || keyed[k].key != keyed[k - 1].key) kept.push_back(spheres[keyed[k].index]);
  tbb::parallel_sort(kept.begin(), kept.end(), [](const EmptySphere& a, const EmptySphere& b) {
    if (a.radius != b.radius) return a.radius > b.radius;
    return std::lexicographical_compare(a.centre.data(), a.centre.data() + 3, b.centre.data(),
                                        b.centre.data() + 3);
  });
  return kept;
}

/// The Voronoi vertices with a positive radius, in the order of the grains whoever does the work. Cells that
/// meet in a vertex share it: that of the first grain stands for all, as far as the faces tell.
std::vector<EmptySphere> vertexSpheres(const Frame& frame, const VoronoiCells& cells,
                                       const SurfaceDistance& distance) {
  constexpr std::size_t block = 1024;
  const std::size_t n = frame.size();
  std::vector<std::vector<EmptySphere>> pieces((n + block - 1) / block);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t b) {
    std::vector<char> listed;
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) {
      const auto vertices = cells.vertices(i);
      listed.assign(vertices.size(), 0);
      for (const auto& face : cells.faces(i))
        if (face.other >= 0 && face.other < static_cast<int>(i))
          for (const int c : cells.corners(i, face))
            listed[static_cast<std::size_t>(c)] = 1;
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        const double radius = (vertices[v] - frame.position[i]).norm() - distance.largestRadius();
        if (!listed[v] && radius > 0) pieces[b].push_back({distance.wrapped(vertices[v]), radius, false});
      }
    }
  });
  std::vector<EmptySphere> all;
  for (const auto& piece : pieces)
    all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

/// Every `stride`-th void point climbed to the top of its void.
std::vector<EmptySphere> climbed(const SurfaceDistance& distance, const Region& region,
                                 const VoidPoints& points, std::size_t most, double diameter) {
  const std::size_t stride = std::max<std::size_t>(1, points.point.size() / most);
  std::vector<EmptySphere> spheres(points.point.size() / stride);
  tbb::parallel_for(std::size_t{0}, spheres.size(), [&](std::size_t k) {
    spheres[k] = climb(distance, region, points.point[k * stride], 0.1 * diameter, 1e-3 * diameter);
  });
  return spheres;
}

} // namespace

VoronoiCells cellsForVoids(const Frame& frame, const std::optional<Vec3>& up, double diameter) {
  VoronoiOptions options;
  options.radical = false;
  options.up = up;
  options.diameter = diameter;
  options.vertices = true;
  return voronoiCells(frame, options);
}

std::vector<EmptySphere> holes(const Frame& frame, const VoronoiCells& cells, const SurfaceDistance& distance,
                               const Region& region, const VoidPoints& points, double diameter) {
  std::vector<EmptySphere> found;
  if (distance.equalGrains()) {
    found = unique(vertexSpheres(frame, cells, distance), diameter);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
      EmptySphere& s = found[k];
      const double walls = distance.toWalls(s.centre);
      if (walls >= s.radius) return;
      s = climb(distance, region, s.centre, 0.1 * diameter, 1e-4 * diameter);
      s.atWall = true;
    });
  } else {
    found = climbed(distance, region, points, 5000, diameter);
  }
  std::erase_if(found, [&](const EmptySphere& s) { return !(s.radius > 0) || !region.contains(s.centre); });
  return unique(found, diameter);
}

DistanceGrid distanceGrid(const SurfaceDistance& distance, const Region& region, double spacing) {
  DistanceGrid grid;
  const Vec3 size = region.box().sizes();
  for (int k = 0; k < 3; ++k) {
    const auto a = static_cast<std::size_t>(k);
    const Domain& domain = region.domain();
    grid.count[a] = std::max(1, static_cast<int>(std::lround(size[k] / spacing)));
    grid.count[a] += grid.count[a] % 2; // even, so that every second node is a grid of twice the spacing
    grid.spacing[k] = size[k] / grid.count[a];
    grid.origin[k] = region.box().min()[k] + 0.5 * grid.spacing[k];
    grid.periodic[a] = domain.periodic[a] && size[k] >= (domain.upper[k] - domain.lower[k]) * (1 - 1e-12);
  }
  const std::size_t nodes = static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2];
  grid.grains.assign(nodes, std::numeric_limits<float>::quiet_NaN());
  grid.walls.assign(nodes, std::numeric_limits<float>::quiet_NaN());
  tbb::parallel_for(0, grid.count[2], [&](int c) {
    for (int b = 0; b < grid.count[1]; ++b)
      for (int a = 0; a < grid.count[0]; ++a) {
        const Vec3 x = grid.origin + grid.spacing.cwiseProduct(Vec3(a, b, c));
        if (!region.contains(x)) continue;
        const std::size_t node = (static_cast<std::size_t>(c) * grid.count[1] + b) * grid.count[0] + a;
        grid.grains[node] = static_cast<float>(distance.toGrains(x).distance);
        grid.walls[node] = static_cast<float>(distance.toWalls(x));
      }
  });
  return grid;
}

Cavities cavities(const DistanceGrid& grid, double probe, int stride) {
  const std::array<int, 3> n{grid.count[0] / stride, grid.count[1] / stride, grid.count[2] / stride};
  const std::size_t nodes = static_cast<std::size_t>(n[0]) * n[1] * n[2];
  const auto open = [&](int a, int b, int c) {
    const std::size_t node =
        (static_cast<std::size_t>(c) * stride * grid.count[1] + b * stride) * grid.count[0] + a * stride;
    return grid.grains[node] > probe && grid.walls[node] > probe; // false for NaN
  };
  std::vector<std::uint32_t> parent(nodes);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t k) {
    while (parent[k] != k)
      k = parent[k] = parent[parent[k]];
    return k;
  };
  const auto index = [&](int a, int b, int c) {
    return static_cast<std::uint32_t>((static_cast<std::size_t>(c) * n[1] + b) * n[0] + a);
  };
  const auto join = [&](std::uint32_t i, std::uint32_t j) {
    i = root(i), j = root(j);
    parent[std::max(i, j)] = std::min(i, j);
  };
  for (int c = 0; c < n[2]; ++c)
    for (int b = 0; b < n[1]; ++b)
      for (int a = 0; a < n[0]; ++a) {
        if (!open(a, b, c)) continue;
        for (int k = 0; k < 3; ++k) {
          std::array<int, 3> next{a, b, c};
          const auto axis = static_cast<std::size_t>(k);
          if (++next[axis] == n[axis]) {
            if (!grid.periodic[axis]) continue;
            next[axis] = 0;
          }
          if (open(next[0], next[1], next[2])) join(index(a, b, c), index(next[0], next[1], next[2]));
        }
      }
  std::map<std::uint32_t, std::size_t> size;
  for (int c = 0; c < n[2]; ++c)
    for (int b = 0; b < n[1]; ++b)
      for (int a = 0; a < n[0]; ++a)
        if (open(a, b, c)) ++size[root(index(a, b, c))];
  Cavities result;
  result.spacing = grid.spacing.x() * stride;
  const double node = grid.spacing.prod() * stride * stride * stride;
  for (const auto& [unused, count] : size) {
    result.volumes.push_back(static_cast<double>(count) * node);
    result.total += result.volumes.back();
  }
  std::sort(result.volumes.rbegin(), result.volumes.rend());
  return result;
}

} // namespace sandglass::analysis
