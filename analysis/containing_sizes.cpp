#include "analysis/containing_sizes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>

namespace sandglass::analysis {

namespace {

/// The largest sphere about each point so far. Spheres may be tried by several threads at once: the greatest
/// of all does not depend on their order. Those that follow each other had better lie near each other.
class LargestSpheres {
public:
  LargestSpheres(const VoidPoints& points, const Domain& domain, double diameter)
      : grid_(points.point, domain, 0.5 * diameter), axes_(grid_.axes()), best_(points.point.size()) {
    for (std::size_t s = 0; s < best_.size(); ++s)
      best_[s] = points.distance[grid_.original(s)];
  }

  void tryOut(const EmptySphere& sphere) {
    const std::array<double, 3> c{sphere.centre[axes_[0]], sphere.centre[axes_[1]], sphere.centre[axes_[2]]};
    const double r2 = sphere.radius * sphere.radius;
    const double *px = grid_.coordinates(0), *py = grid_.coordinates(1), *pz = grid_.coordinates(2);
    grid_.around(c, sphere.radius, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
      for (std::size_t s = begin; s < end; ++s) {
        const double dx = px[s] + shift[0] - c[0], dy = py[s] + shift[1] - c[1], dz = pz[s] + shift[2] - c[2];
        if (dx * dx + dy * dy + dz * dz > r2) continue;
        double now = best_[s].load(std::memory_order_relaxed);
        while (now < sphere.radius &&
               !best_[s].compare_exchange_weak(now, sphere.radius, std::memory_order_relaxed)) {
        }
      }
    });
  }

  std::vector<double> radii() const {
    std::vector<double> result(best_.size());
    for (std::size_t s = 0; s < best_.size(); ++s)
      result[grid_.original(s)] = best_[s];
    return result;
  }

private:
  CellGrid grid_;
  std::array<int, 3> axes_;
  std::vector<std::atomic<double>> best_;
};

template <class Work> void inParallel(std::size_t n, Work&& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k)
      work(k);
  });
}

/// Spheres on the edges and faces of grain i's cell; each face once.
template <class Try>
void onFaces(const Frame& frame, const VoronoiCells& cells, const SurfaceDistance& distance,
             const Region& region, std::size_t i, int level, Try&& tryOut) {
  const auto vertices = cells.vertices(i);
  const Vec3& own = frame.position[i];
  const auto add = [&](const Vec3& c, bool cut) {
    const double radius = cut ? distance(c) : (c - own).norm() - distance.largestRadius();
    if (radius > 0 && region.contains(c)) tryOut({distance.wrapped(c), radius, false});
  };
  for (const auto& face : cells.faces(i)) {
    if (face.other >= 0 && face.other < static_cast<int>(i)) continue;
    const auto corners = cells.corners(i, face);
    const bool cut = face.other < 0 || cells.atWall[i];
    Vec3 middle = Vec3::Zero();
    for (const int c : corners)
      middle += vertices[static_cast<std::size_t>(c)] / static_cast<double>(corners.size());
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Vec3& a = vertices[static_cast<std::size_t>(corners[c])];
      const Vec3& b = vertices[static_cast<std::size_t>(corners[(c + 1) % corners.size()])];
      for (int n = 1; n <= level; ++n)
        add(a + (b - a) * n / (level + 1), cut);
      for (int n = 1; n <= level / 2; ++n)
        add(a + (middle - a) * n / (level / 2 + 1), cut);
    }
    if (level > 0) add(middle, cut);
  }
}

/// Every void point has its own sphere; those on the way uphill are larger and still contain it.
template <class Try>
void uphill(const SurfaceDistance& distance, const Region& region, Vec3 x, int level, Try&& tryOut) {
  const double step = 0.5 * distance.largestRadius() / (level + 1);
  for (int n = 0; n < 2 * (level + 1); ++n) {
    x += step * distance.toGrains(x).away;
    if (!region.contains(x)) break;
    if (const double radius = distance(x); radius > 0) tryOut({distance.wrapped(x), radius, false});
  }
}

} // namespace

std::vector<double> climbedSizes(const SurfaceDistance& distance, const Region& region,
                                 const VoidPoints& points, double diameter) {
  std::vector<double> sizes(points.point.size());
  inParallel(sizes.size(), [&](std::size_t k) {
    sizes[k] = climbAbout(distance, region, points.point[k], 0.1 * diameter, 6e-3 * diameter).radius;
  });
  return sizes;
}

std::vector<double> containingSizes(const Frame& frame, const VoronoiCells& cells,
                                    const SurfaceDistance& distance, const Region& region,
                                    const std::vector<EmptySphere>& holes, const VoidPoints& points,
                                    int level, double diameter) {
  LargestSpheres largest(points, frame.domain, diameter);
  const auto tryOut = [&](const EmptySphere& sphere) { largest.tryOut(sphere); };
  if (distance.equalGrains())
    inParallel(frame.size(),
               [&](std::size_t i) { onFaces(frame, cells, distance, region, i, level, tryOut); });
  else
    inParallel(points.point.size(),
               [&](std::size_t k) { uphill(distance, region, points.point[k], level, tryOut); });
  inParallel(holes.size(), [&](std::size_t k) { tryOut(holes[k]); });
  return largest.radii();
}

} // namespace sandglass::analysis
