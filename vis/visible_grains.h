#pragma once
// The grains that a view shows of a frame: the one list behind drawing and picking, so that what is clipped
// away cannot be picked. A clip plane removes whole grains, those whose centre lies behind it: no cut
// spheres.

#include "sim/frame/frame.h"
#include "vis/camera.h"
#include "vis/renderer.h"
#include "vis/view.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace sandglass::vis {

struct VisibleGrains {
  std::vector<std::size_t> index; ///< into the frame's arrays, ascending
  std::vector<std::int64_t> id;
  std::vector<Vec3> position; ///< [m]
  std::vector<double> radius; ///< [m]
};

/// Frames without radii (imported points) get half the mean spacing of their box.
VisibleGrains visibleGrains(const Frame& frame, const View& view);

/// At most `count` of them (0: all), evenly spread over the list.
std::vector<std::size_t> evenSubset(std::size_t size, int count);

bool isClipped(const std::vector<ClipPlane>& clips, const Vec3& point);

/// The first grain that the ray hits.
PickResult pickAlong(const Ray& ray, const VisibleGrains& grains);

} // namespace sandglass::vis
