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

double slopeOf(const Camera& camera) {
  return std::tan(radians(camera.viewAngle) / 2);
}

/// What points take of the picture, in picture heights from its middle.
struct Outline {
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
};

Outline outlineOf(const std::vector<Vec3>& points, const Camera& camera, const CameraAxes& axes) {
  Outline outline;
  // A point behind the eye asks for more distance.
  const double nearest = 1e-6 * (camera.target - camera.position).norm();
  for (const Vec3& p : points) {
    const Vec3 d = p - camera.position;
    const double height = camera.orthographic ? camera.orthographicHeight
                                              : 2 * slopeOf(camera) * std::max(d.dot(axes.forward), nearest);
    const double x = d.dot(axes.right) / height, y = d.dot(axes.up) / height;
    outline = {std::min(outline.left, x), std::max(outline.right, x), std::min(outline.bottom, y),
               std::max(outline.top, y)};
  }
  return outline;
}

/// The direction from the target to the camera.
Vec3 sideOf(const std::string& preset, int thin, const Vec3& up) {
  // Looking at the front, x runs to the right.
  const Vec3 right = Vec3::UnitX(), front = right.cross(up);
  const Vec3 threeQuarter = (0.45 * right + front + 0.42 * up).normalized();
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

int thinDirection(const Eigen::AlignedBox3d& box, const std::array<bool, 3>& periodic) {
  constexpr double thin = 0.2;
  const Vec3 size = box.sizes();
  for (int k = 0; k < 3; ++k)
    if (periodic[k] && size[k] < thin * size[(k + 1) % 3] && size[k] < thin * size[(k + 2) % 3]) return k;
  return -1;
}

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
  return 2 * (camera.target - camera.position).norm() * slopeOf(camera);
}

Camera resolve(const Camera& camera, const std::vector<Vec3>& points, int thin, double aspect,
               const Frameable& frameable) {

  if (camera.preset.empty()) return camera;
  const Vec3 up = thin == 2 ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 side = sideOf(camera.preset, thin, up);

  Camera result = camera;
  result.preset.clear();
  result.up = std::abs(side.dot(up)) > 0.999 ? Vec3(side.cross(Vec3::UnitX())) : up;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points)
    box.extend(p);
  result.target = box.center();
  result.position = result.target + side * std::max(box.diagonal().norm(), 1e-9) / slopeOf(camera);
  result.orthographicHeight = std::max(box.diagonal().norm(), 1e-9);
  const CameraAxes axes = axesOf(result);
  const double wide = (frameable.right - frameable.left) * aspect, high = frameable.bottom - frameable.top;
  const double middleX = ((frameable.left + frameable.right) / 2 - 0.5) * aspect;
  const double middleY = 0.5 - (frameable.top + frameable.bottom) / 2;

  // Move and approach until the corners fill the free part; perspective makes that a fixed-point iteration.
  constexpr int iterations = 100;
  for (int k = 0; k < iterations; ++k) {
    const Outline outline = outlineOf(points, result, axes);
    const double scale =
        std::max((outline.right - outline.left) / wide, (outline.top - outline.bottom) / high);
    if (k > 0 && std::abs(scale - 1) < 1e-12) break;
    const double height = heightAtTarget(result);
    result.target += height * (axes.right * ((outline.left + outline.right) / 2 - middleX * scale) +
                               axes.up * ((outline.bottom + outline.top) / 2 - middleY * scale));
    result.orthographicHeight *= scale;
    result.position = result.target + side * heightAtTarget(result) * (result.orthographic ? 1 : scale) /
                                          (2 * slopeOf(result));
  }
  if (!result.orthographic) result.orthographicHeight = heightAtTarget(result);
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
