#pragma once
// Where a picture is taken from: presets resolved against the box that it shall hold, and points to pixels.

#include "vis/view.h"

#include <Eigen/Geometry>

#include <array>

namespace sandglass::vis {

/// The part of the picture that the box shall fill, in shares from the left and the top edge; what is left
/// over belongs to legend, title and scale.
struct Frameable {
  double left = 0.04, right = 0.96, top = 0.04, bottom = 0.96;
};

/// Index of the periodic direction that makes the box a slice (below a fifth of both others), or -1.
int thinDirection(const Eigen::AlignedBox3d& box, const std::array<bool, 3>& periodic);

/// `camera` with its preset replaced by numbers such that `points` fill the free part of the picture. "fit"
/// looks along the thin direction of a slice and at three quarters at everything else. Up is z, or y where z
/// is the thin direction. A camera without preset comes back unchanged.
Camera resolve(const Camera& camera, const std::vector<Vec3>& points, int thin, double aspect,
               const Frameable& frameable);

/// Height of the picture in metres at the depth of the camera's target.
double heightAtTarget(const Camera& camera);

/// Right, up and forward of the camera, each of unit length.
struct CameraAxes {
  Vec3 right, up, forward;
};
CameraAxes axesOf(const Camera& camera);

/// The ray through the centre of pixel (x, y), counted from the top left.
struct Ray {
  Vec3 origin, direction; ///< direction of unit length
};
Ray rayThrough(const Camera& camera, int x, int y, int width, int height);

const std::vector<std::string>& cameraPresets();

} // namespace sandglass::vis
