#pragma once
// Where a stage lets grains be: inside the domain and the wedge, on the right side of every wall that stands, short of
// outlets.

#include "sim/math/sector.h"
#include "sim/scene/scene.h"
#include "sim/walls/wall_shape.h"

#include <memory>
#include <string>
#include <vector>

namespace sandglass {

class OpenSpace {
public:
  /// The walls that stand once `stage` has begun, those with a motion where it begins.
  OpenSpace(const Scene& scene, const std::string& stage);

  /// Whether a sphere there touches no wall and has not left. A part of `mayOverlap` of its radius may stick
  /// into a wall.
  bool admits(const Vec3& centre, double radius, double mayOverlap = 0) const;
  /// Name of the wall (or "the outlet NAME", "the domain", …) that forbids it, "" when it is admitted.
  std::string obstacle(const Vec3& centre, double radius, double mayOverlap = 0) const;

  /// The wall that a sphere there still sticks into by more than a hundredth of its radius after it was pushed
  /// out of all walls again and again, as the space between them is narrower than the sphere; "" when it came
  /// clear, as from a corner or the foot of a wedge.
  std::string squeezedBy(Vec3 centre, double radius) const;

  /// The same point inside the domain along periodic axes.
  Vec3 wrapped(Vec3 point) const;
  const Domain& domain() const { return domain_; }

private:
  struct Wall {
    std::string name;
    std::shared_ptr<const WallShape> shape;
  };
  /// Where a sphere sticks deepest into a wall.
  struct Depth {
    double depth = 0; ///< [m]
    Vec3 normal = Vec3::Zero();
    std::string wall;
  };
  Depth deepest(const Vec3& centre, double radius) const;

  Domain domain_;
  Sector sector_;
  std::vector<Wall> walls_;
  std::vector<OutletSpec> outlets_;
};

} // namespace sandglass
