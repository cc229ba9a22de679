#pragma once
// Superellipsoids to be drawn: grains, and the tubes and tips that contacts, arrows and tracks are made of.

#include "sim/frame/frame.h"
#include "vis/colour_map.h"

#include <vector>

namespace sandglass::vis {

struct Solid {
  Vec3 position = Vec3::Zero(); ///< [m]
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  GrainShape shape;
  Rgb colour{0, 0, 0};
  int source = 0; ///< solids of one source have one shape; for meshes
};

/// A cylinder from `from` to `to`, its edges a little rounded.
Solid tube(const Vec3& from, const Vec3& to, double radius, const Rgb& colour);

/// A tube along a line of points with balls at its bends.
void addLine(std::vector<Solid>& solids, const std::vector<Vec3>& points, double radius, const Rgb& colour);

/// A shaft and a tip (two cones, base to base). Nothing when `along` is zero.
void addArrow(std::vector<Solid>& solids, const Vec3& from, const Vec3& along, double radius,
              const Rgb& colour);

/// Makes what is thinner than `radius` as thick: a line of less than a pixel falls apart into dots.
void thicken(std::vector<Solid>& solids, double radius);

} // namespace sandglass::vis
