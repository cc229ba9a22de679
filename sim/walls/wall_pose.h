#pragma once
// Where a wall is and how it moves.

#include "sim/base/vec.h"

namespace sandglass {

/// From the wall's own frame, in which its shape is described, to space: x = rotation * body + translation.
struct WallPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 translation = Vec3::Zero(); ///< [m]
  bool turned = false;             ///< false: rotation is the identity and need not be applied

  Vec3 toBody(const Vec3& x) const {
    const Vec3 d = x - translation;
    return turned ? Vec3(rotation.transpose() * d) : d;
  }
  Vec3 toSpace(const Vec3& body) const { return directionToSpace(body) + translation; }
  Vec3 directionToSpace(const Vec3& n) const { return turned ? Vec3(rotation * n) : n; }
  bool atRest() const { return !turned && translation == Vec3::Zero(); }
};

/// Motion of a rigid wall: of one of its points, and its turning.
struct WallVelocity {
  Vec3 reference = Vec3::Zero(); ///< [m], the point
  Vec3 linear = Vec3::Zero();    ///< [m/s], its velocity
  Vec3 spin = Vec3::Zero();      ///< [rad/s]

  /// Velocity of the wall's material point at x.
  Vec3 at(const Vec3& x) const { return linear + spin.cross(x - reference); }
};

} // namespace sandglass
