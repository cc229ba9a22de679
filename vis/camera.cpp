#include "vis/camera.h"

#include "sim/base/error.h"
#include "vis/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass::vis {

namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// Index of the periodic direction that makes the box a slice, or -1.
int thinDirection(const Eigen::AlignedBox3d& box, const std::array<bool, 3>& periodic) {
  constexpr double thin = 0.2;
  const Vec3 size = box.sizes();
  for (int k = 0; k < 3; ++k)
    if (periodic[k] && size[k] < thin * size[(k + 1) % 3] && size[k] < thin * size[(k + 2) % 3]) return k;
  return -1;
}

/// The direction from the target to the camera.
Vec3 sideOf(const std::string& preset, int thin, const Vec3& up) {
  // Looking at the front, x runs to the right.
  const Vec3 right = Vec3::UnitX(), front = right.cross(up);
  const Vec3 threeQuarter = (0.45 * right + front + 0.32 * up).normalized();
  if (preset == "fit") {
    if (thin == 0) return Vec3::UnitX();
    return thin > 0 ? front : threeQuarter;
  }
  if (preset == "iso") return (right + front + 0.8165 * up).normalized();
  if (preset == "front") return front;
  if (preset == "back") return -front;
  if (preset == "right") return right;
  if (preset == "left") return -right;
  if (preset == "top") return up;
  if (preset == "bottom") return -up;
  throw InputError(
      fmt::format("there is no camera preset '{}'; there are: {}", preset, fmt::join(cameraPresets(), ", ")));
}

} // namespace

const std::vector<std::string>& cameraPresets() {
  static const std::vector<std::string> all{"fit", "front", "back", "left", "right", "top", "bottom", "iso"};
  return all;
}

CameraAxes axesOf(const Camera& camera) {
  const Vec3 forward = (camera.target - camera.position).normalized();
  Vec3 right = forward.cross(camera.up);
  if (right.norm() < 1e-9 * camera.up.norm()) right = forward.unitOrthogonal();
  right.normalize();
  return {right, right.cross(forward), forward};
}

double heightAtTarget(const Camera& camera) {
  if (camera.orthographic) return camera.orthographicHeight;
  return 2 * (camera.target - camera.position).norm() * std::tan(radians(camera.viewAngle) / 2);
}

Camera resolve(const Camera& camera, const Eigen::AlignedBox3d& box, const std::array<bool, 3>& periodic,
               double aspect, const Frameable& frameable) {
  if (camera.preset.empty()) return camera;
  const int thin = thinDirection(box, periodic);
  const Vec3 up = thin == 2 ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 side = sideOf(camera.preset, thin, up);

  Camera result = camera;
  result.preset.clear();
  result.up = std::abs(side.dot(up)) > 0.999 ? Vec3(Vec3::UnitX().cross(side) * -1) : up;
  result.target = box.center();
  result.position = result.target + side;
  const CameraAxes axes = axesOf(result);

  // Extents of the eight corners about the centre, and from the middle of those the picture's middle.
  const double wide = frameable.right - frameable.left, high = frameable.bottom - frameable.top;
  const double slope = std::tan(radians(camera.viewAngle) / 2);
  double distance = 0, orthographicHeight = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 d = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - result.target;
    const double x = std::abs(d.dot(axes.right)) / (aspect * wide), y = std::abs(d.dot(axes.up)) / high;
    orthographicHeight = std::max({orthographicHeight, 2 * x, 2 * y});
    distance = std::max(distance, std::max(x, y) / slope - d.dot(axes.forward));
  }
  const double height = result.orthographic ? orthographicHeight : 2 * distance * slope;
  const Vec3 shift = axes.right * (0.5 - (frameable.left + frameable.right) / 2) * height * aspect +
                     axes.up * ((frameable.top + frameable.bottom) / 2 - 0.5) * height;
  result.target += shift;
  result.position = result.target + side * std::max(distance, 1e-9);
  result.orthographicHeight = result.orthographic ? orthographicHeight : height;
  return result;
}

Ray rayThrough(const Camera& camera, int x, int y, int width, int height) {
  const CameraAxes axes = axesOf(camera);
  const double h = heightAtTarget(camera);
  const Vec3 onTarget = camera.target + axes.right * h * ((x + 0.5) / height - 0.5 * width / height) +
                        axes.up * h * (0.5 - (y + 0.5) / height);
  if (camera.orthographic)
    return {onTarget - axes.forward * (camera.target - camera.position).norm(), axes.forward};
  return {camera.position, (onTarget - camera.position).normalized()};
}

Camera orbit(const Camera& camera, double azimuth, double elevation) {
  const CameraAxes axes = axesOf(camera);
  const Vec3 up = camera.up.normalized();
  const Vec3 arm = camera.position - camera.target;
  constexpr double nearPole = 89;
  const double now = std::asin(std::clamp(arm.normalized().dot(up), -1.0, 1.0)) * 180 / std::numbers::pi;
  const double turn = std::clamp(now + elevation, -nearPole, nearPole) - now;
  Camera result = camera;
  result.preset.clear();
  result.position = camera.target + Eigen::AngleAxisd(radians(azimuth), up) *
                                        (Eigen::AngleAxisd(radians(-turn), axes.right) * arm);
  return result;
}

Camera zoom(const Camera& camera, double factor) {
  Camera result = camera;
  result.preset.clear();
  result.position = camera.target + (camera.position - camera.target) / factor;
  result.orthographicHeight = camera.orthographicHeight / factor;
  return result;
}

Camera pan(const Camera& camera, double right, double up) {
  const CameraAxes axes = axesOf(camera);
  const Vec3 shift = heightAtTarget(camera) * (right * axes.right + up * axes.up);
  Camera result = camera;
  result.preset.clear();
  result.position += shift;
  result.target += shift;
  return result;
}

} // namespace sandglass::vis
