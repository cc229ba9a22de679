#pragma once
// Spheres already placed, in cells, to ask whether another one fits. All periodic images are seen, in domains
// of any depth that a sphere fits into, and all images across the faces of a wedge.

#include "sim/frame/frame.h"
#include "sim/math/sector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

class PlacementGrid {
public:
  /// `largestDiameter` [m]: no sphere added or asked about is larger; no period may be shorter.
  PlacementGrid(const Domain& domain, double largestDiameter, const Sector& sector = {});

  void add(const Vec3& centre, double radius);

  /// Deepest overlap with a sphere in the grid, in shares of the smaller radius; <= 0: touches none.
  double overlap(const Vec3& centre, double radius) const;
  bool isFree(const Vec3& centre, double radius) const { return overlap(centre, radius) <= 0; }

private:
  double overlapHere(const Vec3& centre, double radius) const;
  std::array<int, 3> cellOf(const Vec3& centre) const;
  std::size_t index(int x, int y, int z) const;

  Domain domain_;
  Sector sector_;
  double largestDiameter_;
  Vec3 length_;
  std::array<int, 3> cells_{};
  std::vector<std::int32_t> first_, next_; ///< chains of spheres by cell
  std::vector<Vec3> centres_;
  std::vector<double> radii_;
};

} // namespace sandglass
