#include "sim/grains/placement_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass {

PlacementGrid::PlacementGrid(const Domain& domain, double largestDiameter, const Sector& sector)
    : domain_(domain), sector_(sector), largestDiameter_(largestDiameter),
      length_(domain.upper - domain.lower) {
  constexpr double mostCells = 1e7; // 40 MB; larger cells in larger domains only cost time
  const auto cellsAcross = [&](double width) -> Vec3 { return (length_ / width).array().floor().max(1.0); };
  double width = largestDiameter;
  while (cellsAcross(width).prod() > mostCells)
    width *= 1.25;
  const Vec3 across = cellsAcross(width);
  for (std::size_t k = 0; k < 3; ++k)
    cells_[k] = static_cast<int>(across[static_cast<int>(k)]);
  first_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2], -1);
}

std::array<int, 3> PlacementGrid::cellOf(const Vec3& centre) const {
  std::array<int, 3> cell{};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double c = std::floor((centre[k] - domain_.lower[k]) / length_[k] * cells_[axis]);
    cell[axis] = static_cast<int>(std::clamp(c, 0.0, cells_[axis] - 1.0));
  }
  return cell;
}

std::size_t PlacementGrid::index(int x, int y, int z) const {
  return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_[1]) + static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(cells_[0]) +
         static_cast<std::size_t>(x);
}

void PlacementGrid::add(const Vec3& centre, double radius) {
  const auto cell = cellOf(centre);
  auto& first = first_[index(cell[0], cell[1], cell[2])];
  next_.push_back(first);
  first = static_cast<std::int32_t>(centres_.size());
  centres_.push_back(centre);
  radii_.push_back(radius);
}

double PlacementGrid::overlap(const Vec3& centre, double radius) const {
  double deepest = overlapHere(centre, radius);
  // Twice that far: spheres that were there before may stand beyond a face.
  sector_.eachImage(centre, 2.0 * largestDiameter_, [&](int turn) {
    deepest = std::max(deepest, overlapHere(sector_.turned(centre, turn), radius));
  });
  return deepest;
}

double PlacementGrid::overlapHere(const Vec3& centre, double radius) const {
  const auto cell = cellOf(centre);
  double deepest = -std::numeric_limits<double>::infinity();
  // Neighbours are counted without wrapping and each carries its own shift: with one or two cells across a
  // period the same cell is visited again as another image, as it must be.
  std::array<int, 3> c{};
  Vec3 shift = Vec3::Zero();
  const auto axis = [&](std::size_t k, int offset) {
    int at = cell[k] + offset;
    shift[static_cast<int>(k)] = 0;
    if (at < 0 || at >= cells_[k]) {
      if (!domain_.periodic[k]) return false;
      const int turns = at < 0 ? -1 : 1;
      at -= turns * cells_[k];
      shift[static_cast<int>(k)] = turns * length_[static_cast<int>(k)];
    }
    c[k] = at;
    return true;
  };
  for (int dz = -1; dz <= 1; ++dz) {
    if (!axis(2, dz)) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      if (!axis(1, dy)) continue;
      for (int dx = -1; dx <= 1; ++dx) {
        if (!axis(0, dx)) continue;
        for (auto i = first_[index(c[0], c[1], c[2])]; i >= 0; i = next_[static_cast<std::size_t>(i)]) {
          const auto j = static_cast<std::size_t>(i);
          const double sum = radii_[j] + radius;
          const Vec3 apart = centres_[j] + shift - centre;
          const double squared = apart.squaredNorm();
          if (squared < sum * sum)
            deepest = std::max(deepest, (sum - std::sqrt(squared)) / std::min(radii_[j], radius));
        }
      }
    }
  }
  return deepest;
}

} // namespace sandglass
