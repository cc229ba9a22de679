#pragma once
// The geometry of a wall, at rest. A wall is a surface with no thickness; grains live on its positive side.
// One file per kind; a kind is made known by one line in wall_registry.cpp.

#include "sim/base/mesh.h"
#include "sim/base/vec.h"

#include <Eigen/Geometry>

#include <array>
#include <memory>
#include <string>

namespace sandglass {

/// One place where a sphere is near a wall. `feature` names the face, edge or corner, so that a contact
/// keeps its history while the grain stays on it.
struct WallTouch {
  double distance = 0;        ///< from sphere centre to the wall point, > 0 on the grain side [m]
  Vec3 normal = Vec3::Zero(); ///< unit, from the wall point to the sphere centre
  int feature = 0;
};

class WallShape {
public:
  /// No sphere can touch one wall in more places than this at a time: a ball that plugs a funnel of many
  /// facets, which count as one where they are nearly parallel.
  static constexpr int maxTouches = 32;
  struct Touches {
    int count = 0, lost = 0; ///< lost: those beyond maxTouches; forces would be wrong
    std::array<WallTouch, maxTouches> at;
    void add(const WallTouch& t) {
      if (count < maxTouches)
        at[count++] = t;
      else
        ++lost;
    }
  };

  virtual ~WallShape() = default;

  /// Whether a grain whose centre has passed through is pushed back to where it came from. Where the normal
  /// points from the nearest place of the surface to the grain, it is pushed out on the other side instead.
  virtual bool pushesBack() const { return false; }

  /// Of this kind of wall; what is kept of grains near it grows with it.
  virtual int mostTouches() const { return 6; }

  /// Every face, edge or corner nearer than `reach` to `centre`, in ascending order of feature.
  /// An edge shared by two faces is reported once, and not at all where a face covers it.
  virtual void touches(const Vec3& centre, double reach, Touches& out) const = 0;

  /// Distance from x to the wall, positive on the side where grains live; used to find the space that is
  /// open to grains. Where a wall does not look at x at all (above its rim, say) the value is positive.
  virtual double signedDistance(const Vec3& x) const = 0;

  /// Smallest box around the wall; infinite extents where the wall has none.
  virtual Eigen::AlignedBox3d bounds() const = 0;

  /// Triangles and feature edges for drawing and export. `clip` bounds infinite walls.
  virtual TriangleMesh mesh(const Eigen::AlignedBox3d& clip) const = 0;
};

} // namespace sandglass
