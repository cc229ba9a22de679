#include "analysis/voronoi.h"

#include "analysis/cell_grid.h"
#include "analysis/free_surface.h"
#include "sim/base/error.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sandglass::analysis {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Candidate {
  double key; ///< squared distance of the plane, times 4 and with its sign: what is near cuts first
  double d2;
  Vec3 h;
  std::uint32_t index;
};

/// One thread's cell and scratch space. Lengths are scaled by the mean spacing, since voro++ has absolute
/// tolerances.
struct Workshop {
  voro::voronoicell_neighbor cell;
  std::vector<Candidate> candidates; ///< of the shell that is being searched
  std::vector<Candidate> tried;      ///< all that may have cut; faces are numbered by them
  std::vector<int> neighbours, corners;
  std::vector<double> areas, normals, vertices;
};

struct Piece {
  std::vector<VoronoiFace> faces;
  std::vector<Vec3> vertices;
  std::vector<int> corners;
};

class Cutter {
public:
  Cutter(const Frame& frame, const VoronoiOptions& options, double unit)
      : frame_(frame), options_(options), unit_(unit), grid_(frame.position, frame.domain, 0.8 * unit) {
    if (options.radical) {
      radius_ = &frame.scalar(quantity::radius);
      largest_ = *std::max_element(radius_->begin(), radius_->end()) / unit_;
    }
    for (const auto& wall : frame.walls)
      if (wall.active) walls_.push_back(wall.shape.get());
    if (options.up) {
      surface_.emplace(frame, *options.up, 1.5 * options.diameter, options.diameter);
      up_ = surface_->axes().up;
    }
  }

  const CellGrid& grid() const { return grid_; }

  /// Cell of the sorted grain s into `cells` and `piece`.
  void cut(std::size_t s, Workshop& shop, VoronoiCells& cells, Piece& piece) const {
    const std::uint32_t i = grid_.original(s);
    cells.volume[i] = std::numeric_limits<double>::quiet_NaN();
    const Vec3& x = frame_.position[i];
    auto& cell = shop.cell;
    if (!begin(x, cell)) return;
    std::vector<const WallShape*> touched;
    double wallReach = 2;
    if (!cutByWalls(x, 0, wallReach, cell, touched) || !cutBySurface(x, cell) || !cutByGrains(s, shop))
      return;
    // A cell that reaches farther than the walls were looked for.
    for (double far = farthest(cell); far > wallReach; far = farthest(cell)) {
      if (!cutByWalls(x, wallReach, far, cell, touched)) return;
      wallReach = far;
    }
    for (int round = 0; round < options_.wallRounds && !touched.empty(); ++round)
      if (!cutByCurves(x, touched, shop)) break;
    keep(i, shop, cells, piece);
  }

private:
  /// The domain as seen from x; half a period to either side along periodic axes.
  bool begin(const Vec3& x, voro::voronoicell_neighbor& cell) const {
    Vec3 low, high;
    for (int k = 0; k < 3; ++k) {
      const double period = frame_.domain.upper[k] - frame_.domain.lower[k];
      if (frame_.domain.periodic[k]) {
        low[k] = -0.5 * period / unit_;
        high[k] = -low[k];
      } else {
        low[k] = std::min(0.0, (frame_.domain.lower[k] - x[k]) / unit_);
        high[k] = std::max(0.0, (frame_.domain.upper[k] - x[k]) / unit_);
        if (!(high[k] > low[k])) return false;
      }
    }
    cell.init(low.x(), high.x(), low.y(), high.y(), low.z(), high.z());
    return true;
  }

  static double farthest(voro::voronoicell_neighbor& cell) {
    return 0.5 * std::sqrt(cell.max_radius_squared()); // voro++ keeps doubled coordinates
  }

  /// Features of walls between `from` and `to` [unit] away. False when nothing is left.
  bool cutByWalls(const Vec3& x, double from, double to, voro::voronoicell_neighbor& cell,
                  std::vector<const WallShape*>& touched) const {
    for (const auto* wall : walls_) {
      WallShape::Touches touches;
      wall->touches(x, to * unit_, touches);
      for (int t = 0; t < touches.count; ++t) {
        const double d = touches.at[t].distance / unit_;
        if (d < from || !(d > 0)) continue;
        if (wall->signedDistance(x) < 0) return false;
        const Vec3 n = -touches.at[t].normal;
        if (!cell.nplane(n.x(), n.y(), n.z(), 2 * d, beyond::wall - 16)) return false;
        if (std::find(touched.begin(), touched.end(), wall) == touched.end()) touched.push_back(wall);
      }
    }
    return true;
  }

  bool cutBySurface(const Vec3& x, voro::voronoicell_neighbor& cell) const {
    if (!surface_) return true;
    const double left = (surface_->heightAt(x) + 0.5 * options_.diameter - x.dot(up_)) / unit_;
    if (!(left > 0)) return false;
    return cell.nplane(up_.x(), up_.y(), up_.z(), 2 * left, beyond::surface - 16);
  }

  bool cutByGrains(std::size_t s, Workshop& shop) const {
    const std::uint32_t i = grid_.original(s);
    const double own = radius_ ? (*radius_)[i] / unit_ : 0;
    const std::array<double, 3> c{grid_.coordinates(0)[s], grid_.coordinates(1)[s], grid_.coordinates(2)[s]};
    const auto axes = grid_.axes();
    auto& cell = shop.cell;
    const auto needed = [&] {
      const double rho = farthest(cell);
      return rho + std::sqrt(std::max(0.0, rho * rho + largest_ * largest_ - own * own));
    };
    shop.tried.clear();
    // Shells of growing reach: most cells are done within the first.
    double seen = 0;
    for (double reach = 1.75;; reach = std::min(1.6 * reach, std::max(needed(), 1.05 * reach))) {
      shop.candidates.clear();
      grid_.around(c, reach * unit_, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
        for (std::size_t t = begin; t < end; ++t) {
          Vec3 h;
          for (int k = 0; k < 3; ++k)
            h[axes[k]] = (grid_.coordinates(k)[t] + shift[k] - c[k]) / unit_;
          const double d2 = h.squaredNorm();
          if (d2 < seen * seen || d2 >= reach * reach || d2 == 0) continue;
          const std::uint32_t j = grid_.original(t);
          const double other = radius_ ? (*radius_)[j] / unit_ : 0;
          const double rsq = d2 + own * own - other * other;
          shop.candidates.push_back({rsq * std::abs(rsq) / d2, d2, h, j});
        }
      });
      std::sort(shop.candidates.begin(), shop.candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.key != b.key ? a.key < b.key : a.index < b.index;
      });
      double limit = infinity; // planes with a larger key are out of the cell
      int sinceCheck = 0;
      for (const Candidate& near : shop.candidates) {
        if (near.key > limit) break;
        const double other = radius_ ? (*radius_)[near.index] / unit_ : 0;
        const double rsq = near.d2 + own * own - other * other;
        if (!cell.nplane(near.h.x(), near.h.y(), near.h.z(), rsq, static_cast<int>(shop.tried.size())))
          return false;
        shop.tried.push_back(near);
        if (++sinceCheck >= 12) {
          limit = cell.max_radius_squared() * (1 + 1e-9);
          sinceCheck = 6;
        }
      }
      seen = reach;
      if (seen >= needed() || seen > 1e4) return true;
    }
  }

  /// Tangent planes where vertices lie beyond a curved wall. False when none did.
  bool cutByCurves(const Vec3& x, const std::vector<const WallShape*>& touched, Workshop& shop) const {
    shop.cell.vertices(shop.vertices);
    bool any = false;
    for (std::size_t v = 0; v + 2 < shop.vertices.size(); v += 3) {
      const Vec3 at = x + unit_ * Vec3(shop.vertices[v], shop.vertices[v + 1], shop.vertices[v + 2]);
      for (const auto* wall : touched) {
        const double outside = -wall->signedDistance(at) / unit_;
        if (outside < 1e-7) continue;
        WallShape::Touches touches;
        wall->touches(at, 1.5 * outside * unit_, touches);
        for (int t = 0; t < touches.count; ++t) {
          const Vec3& n = touches.at[t].normal;
          const double d = n.dot(at - touches.at[t].distance * n - x) / unit_;
          // A plane that would cut off the grain's own centre belongs to a wall that bulges into the bed.
          if (!(d > 0)) continue;
          any = true;
          shop.cell.nplane(n.x(), n.y(), n.z(), 2 * d, beyond::wall - 16);
        }
      }
    }
    return any;
  }

  void keep(std::uint32_t i, Workshop& shop, VoronoiCells& cells, Piece& piece) const {
    auto& cell = shop.cell;
    cells.volume[i] = cell.volume() * unit_ * unit_ * unit_;
    cell.neighbors(shop.neighbours);
    cell.face_areas(shop.areas);
    cell.normals(shop.normals);
    const std::size_t first = piece.faces.size();
    std::size_t corner = 0; // voro++ lists each face as its number of corners and then these
    if (options_.vertices) cell.face_vertices(shop.corners);
    const std::size_t firstCorner = piece.corners.size();
    for (std::size_t f = 0; f < shop.neighbours.size(); ++f) {
      VoronoiFace face;
      face.area = shop.areas[f] * unit_ * unit_;
      // voro++ numbers the sides of the first box -1 to -6.
      const int n = shop.neighbours[f];
      const int axis = n < 0 && n >= -6 ? (-n - 1) / 2 : 0;
      const Vec3 normal(shop.normals[3 * f], shop.normals[3 * f + 1], shop.normals[3 * f + 2]);
      face.vector = normal;
      if (n >= 0) {
        const Candidate& near = shop.tried[static_cast<std::size_t>(n)];
        face.other = static_cast<int>(near.index);
        face.vector = near.h * unit_;
      } else if (n >= -6 && frame_.domain.periodic[axis]) {
        face.other = static_cast<int>(i); // half way to its own image
        face.vector = normal * (frame_.domain.upper[axis] - frame_.domain.lower[axis]);
      } else {
        face.other = n >= -6 ? beyond::bound : n + 16;
        // The domain's end where a flat wall stands is that wall.
        if (face.other == beyond::bound && wallThere(i, axis, n)) face.other = beyond::wall;
      }
      if (options_.vertices) {
        const int corners = shop.corners[corner++];
        face.firstCorner = static_cast<std::uint32_t>(piece.corners.size() - firstCorner);
        face.corners = static_cast<std::uint32_t>(corners);
        for (int k = 0; k < corners; ++k)
          piece.corners.push_back(shop.corners[corner++]);
      }
      cells.atWall[i] |= face.other == beyond::wall;
      cells.atBound[i] |= face.other == beyond::bound;
      cells.atSurface[i] |= face.other == beyond::surface;
      piece.faces.push_back(face);
    }
    std::sort(piece.faces.begin() + static_cast<std::ptrdiff_t>(first), piece.faces.end(),
              [](const VoronoiFace& a, const VoronoiFace& b) {
                return a.area != b.area ? a.area > b.area : a.other < b.other;
              });
    cells.start[i + 1] = piece.faces.size() - first;
    if (!options_.vertices) return;
    cells.cornerStart[i + 1] = piece.corners.size() - firstCorner;
    shop.cell.vertices(shop.vertices);
    cells.vertexStart[i + 1] = shop.vertices.size() / 3;
    for (std::size_t v = 0; v + 2 < shop.vertices.size(); v += 3)
      piece.vertices.push_back(frame_.position[i] +
                               unit_ * Vec3(shop.vertices[v], shop.vertices[v + 1], shop.vertices[v + 2]));
  }

  bool wallThere(std::uint32_t i, int axis, int side) const {
    Vec3 at = frame_.position[i];
    at[axis] = (-side - 1) % 2 == 0 ? frame_.domain.lower[axis] : frame_.domain.upper[axis];
    for (const auto* wall : walls_)
      if (std::abs(wall->signedDistance(at)) < 1e-6 * unit_) return true;
    return false;
  }

  const Frame& frame_;
  const VoronoiOptions& options_;
  double unit_, largest_ = 0;
  CellGrid grid_;
  const std::vector<double>* radius_ = nullptr;
  std::vector<const WallShape*> walls_;
  std::optional<FreeSurface> surface_;
  Vec3 up_ = Vec3::UnitZ();
};

/// The edge of a cube that holds one grain on average, at least a hundredth of the mean diameter.
double spacing(const Frame& frame, double diameter) {
  if (diameter > 0) return 1.1 * diameter;
  Vec3 lower = frame.domain.lower, upper = frame.domain.upper;
  const double volume = (upper - lower).prod();
  return std::cbrt(volume / static_cast<double>(std::max<std::size_t>(1, frame.size())));
}

} // namespace

VoronoiCells voronoiCells(const Frame& frame, const VoronoiOptions& options) {
  const std::size_t n = frame.size();
  VoronoiCells cells;
  cells.volume.assign(n, 0);
  cells.start.assign(n + 1, 0);
  cells.vertexStart.assign(n + 1, 0);
  cells.cornerStart.assign(n + 1, 0);
  cells.atWall.assign(n, 0);
  cells.atBound.assign(n, 0);
  cells.atSurface.assign(n, 0);
  if (n == 0) return cells;
  const double unit = spacing(frame, options.diameter);
  if (!(unit > 0) || !std::isfinite(unit))
    throw InputError("Voronoi cells need a domain with a volume: give the frame bounds, or a diameter");
  const Cutter cutter(frame, options, unit);
  constexpr std::size_t block = 256;
  const std::size_t blocks = (n + block - 1) / block;
  std::vector<Piece> pieces(blocks);
  tbb::enumerable_thread_specific<Workshop> shops;
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    Workshop& shop = shops.local();
    for (std::size_t s = b * block; s < std::min(n, (b + 1) * block); ++s)
      cutter.cut(s, shop, cells, pieces[b]);
  });
  std::partial_sum(cells.start.begin(), cells.start.end(), cells.start.begin());
  std::partial_sum(cells.vertexStart.begin(), cells.vertexStart.end(), cells.vertexStart.begin());
  std::partial_sum(cells.cornerStart.begin(), cells.cornerStart.end(), cells.cornerStart.begin());
  cells.corner.resize(cells.cornerStart.back());
  cells.face.resize(cells.start.back());
  cells.vertex.resize(cells.vertexStart.back());
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    std::size_t face = 0, vertex = 0, corner = 0;
    for (std::size_t s = b * block; s < std::min(n, (b + 1) * block); ++s) {
      const std::uint32_t i = cutter.grid().original(s);
      for (std::size_t k = cells.start[i]; k < cells.start[i + 1]; ++k)
        cells.face[k] = pieces[b].faces[face++];
      for (std::size_t k = cells.vertexStart[i]; k < cells.vertexStart[i + 1]; ++k)
        cells.vertex[k] = pieces[b].vertices[vertex++];
      for (std::size_t k = cells.cornerStart[i]; k < cells.cornerStart[i + 1]; ++k)
        cells.corner[k] = pieces[b].corners[corner++];
    }
  });
  return cells;
}

} // namespace sandglass::analysis
