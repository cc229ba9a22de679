#pragma once
// The space in which statistics are taken: the part of the container that is open to grain centres (or, with
// clearance 0, to the grains themselves), cut by the user's limits and by the free surface.

#include "analysis/free_surface.h"
#include "sim/frame/frame.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::analysis {

struct RegionOptions {
  double clearance = 0; ///< least distance from walls [m]: the grain radius for centres, 0 for grains
  Vec3 lower = Vec3::Constant(-std::numeric_limits<double>::infinity()); ///< the user's limits [m]
  Vec3 upper = Vec3::Constant(std::numeric_limits<double>::infinity());
  bool closeGates = true; ///< an opened gate still closes the region: nothing below it counts, so that what
                          ///< fell out is not in it; needs `up`
  std::vector<std::string> gates; ///< walls that a stage will remove; those already removed are known anyway
  std::optional<Vec3> up;         ///< minus gravity
  bool freeSurface = true;        ///< whether the free surface bounds the region; needs `up` and `diameter`
  double surfaceMargin = 0;       ///< [m] below the free surface
  double columnWidth = 0;         ///< [m] of the surface's height field; 0: 1.5 `diameter`
  double diameter = 0;            ///< mean grain diameter [m]; needed with `up`
};

/// A volume with its standard error [m^3].
struct Volume {
  double value = 0, error = 0;
};

/// Immutable; safe from many threads. Keeps the Frame's walls alive, not the Frame.
class Region {
public:
  Region(const Frame& frame, const RegionOptions& options);

  /// Whether x (any periodic image) lies in the region.
  bool contains(const Vec3& x) const {
    return insideBox(x) && insideWalls(x, options_.clearance) && belowSurface(x);
  }

  /// Whether a grain of this radius at x counts as inside. Walls are given `slack`, a share of the radius,
  /// since a soft grain pressed on a wall is nearer to it than its radius.
  bool containsGrain(const Vec3& x, double radius, double slack = 0.1) const;

  /// A lower bound of the distance from x to the region's boundary, never more than `reach` [m]; a ball of
  /// that radius about x is inside the region. 0 or less when x is outside.
  double depthInside(const Vec3& x, double reach) const;

  /// A box around the region; whole along periodic directions.
  const Eigen::AlignedBox3d& box() const { return box_; }

  /// By a million quasi-random points in the box; the error comes from 16 independent shifts of them.
  Volume volume(std::uint64_t seed = 1) const;

  /// Volumes of slabs between planes across `up` at heights from + n width, n = 0 .. slabs, counted in the
  /// same way. Errors are those of each slab.
  std::vector<Volume> slabVolumes(const Vec3& up, double from, double width, int slabs,
                                  std::uint64_t seed = 1) const;

  const FreeSurface* surface() const { return surface_.get(); }
  const Domain& domain() const { return domain_; }
  const RegionOptions& options() const { return options_; }

  /// One clause for a result's definition: "centres at least 1.1 mm from walls, ...".
  std::string description() const;

private:
  Vec3 wrapped(Vec3 x) const;
  bool insideBox(const Vec3& x) const;
  bool insideWalls(const Vec3& x, double clearance) const;
  bool belowSurface(const Vec3& x) const;

  Domain domain_;
  RegionOptions options_;
  std::vector<std::shared_ptr<const WallShape>> walls_;
  std::shared_ptr<const FreeSurface> surface_;
  Eigen::AlignedBox3d box_;
};

} // namespace sandglass::analysis
