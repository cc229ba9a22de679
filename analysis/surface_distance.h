#pragma once
// Distance from any point to the nearest grain surface and the nearest wall: the ground of all void sizes.

#include "analysis/cell_grid.h"
#include "analysis/region.h"
#include "sim/frame/frame.h"

#include <array>
#include <memory>
#include <vector>

namespace sandglass::analysis {

class SurfaceDistance {
public:
  /// `reach`: distances from surfaces beyond this are not told apart [m]; for grains without radii all have
  /// `diameter` / 2. Keeps the Frame's walls alive, not the Frame.
  SurfaceDistance(const Frame& frame, double diameter, double reach);

  struct Nearest {
    double distance = 0;      ///< to the surface, negative inside a grain; `reach` when none is nearer [m]
    Vec3 away = Vec3::Zero(); ///< unit, from that grain's centre to the point; 0 when none is near
  };
  /// To the grains. `enough`: a distance below it need not be the least (points inside grains are of no
  /// interest).
  Nearest toGrains(const Vec3& x, double enough = 0) const;

  /// To the walls, positive inside; `reach` at most.
  double toWalls(const Vec3& x) const;

  /// The lesser of the two.
  double operator()(const Vec3& x) const { return std::min(toGrains(x).distance, toWalls(x)); }

  /// The grains whose centres lie within `reach` of x, where they are seen from x: x y z and radius of each.
  void grainsAbout(const Vec3& x, double reach, std::vector<std::array<double, 4>>& grains) const;

  bool equalGrains() const { return equal_; }
  double largestRadius() const { return largest_; }
  double reach() const { return reach_; }
  Vec3 wrapped(Vec3 x) const;

private:
  Domain domain_;
  CellGrid grid_;
  std::vector<double> radius_; ///< sorted as the grid
  std::vector<std::shared_ptr<const WallShape>> walls_;
  double largest_ = 0, reach_;
  bool equal_ = true;
};

struct EmptySphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
  bool atWall = false; ///< a wall is what limits it
};

/// From x uphill in the distance to the nearest surface, walls included, inside the region, until no step of
/// `tolerance` helps: an empty sphere that is (nearly) as large as it can be thereabouts.
EmptySphere climb(const SurfaceDistance& distance, const Region& region, const Vec3& x, double firstStep,
                  double tolerance);

/// The same among the spheres that contain the point `inside`, beginning with the one about itself. Centres
/// of such spheres make a convex set, on which the distance may still have more than one top.
EmptySphere climbAbout(const SurfaceDistance& distance, const Region& region, const Vec3& inside,
                       double firstStep, double tolerance);

} // namespace sandglass::analysis
