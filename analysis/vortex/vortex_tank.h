#pragma once
// A round tank with an upright axis, as the analysis of vortex runs sees it: what the walls say, whoever made
// the frames.

#include "sim/base/vec.h"
#include "sim/scene/scene.h"

#include <optional>

namespace sandglass::analysis {

struct VortexTank {
  double radius = 0;          ///< [m] inner
  double floor = 0;           ///< [m] height of the floor along `up`
  double top = 0;             ///< [m] height above which a grain has left the bed for good
  double gravity = 9.81;      ///< [m/s^2]
  Vec3 up = Vec3::UnitZ();    ///< unit; the axis of the tank
  Vec3 onAxis = Vec3::Zero(); ///< [m] a point of the axis
  bool operator==(const VortexTank&) const = default;
};

/// From the first cylinder of the scene whose axis is that of gravity: its radius and height, and the highest
/// floor (closed end, plane, disc or rectangle square to the axis) below its middle. Nothing when the scene
/// has no such cylinder.
std::optional<VortexTank> tankOf(const Scene& scene);

} // namespace sandglass::analysis
