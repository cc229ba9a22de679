#include "vis/pick.h"

#include "vis/superellipsoid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

PickResult pickAlong(const Ray& ray, const VisibleGrains& grains) {
  // Sphere |o + t d - c|^2 = r^2: t = b - sqrt(b^2 - (|oc|^2 - r^2)) with oc = c - o, b = d . oc.
  PickResult best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Vec3 oc = grains.position[i] - ray.origin;
    const double b = ray.direction.dot(oc);
    const double missed = (oc - b * ray.direction).squaredNorm(), r = grains.radius[i];
    if (missed > r * r) continue;
    double t = b - std::sqrt(r * r - missed);
    if (t >= nearest) continue;
    if (!grains.isSphere(i)) {
      const Eigen::Quaterniond back = grains.orientation[i].conjugate();
      const auto entry = entryDistance(grains.shapes[static_cast<std::size_t>(grains.shape[i])],
                                       {back * -oc, back * ray.direction});
      if (!entry) continue;
      t = *entry;
    }
    if (t <= 0 || t >= nearest) continue;
    nearest = t;
    best = {grains.id[i], ray.origin + t * ray.direction};
  }
  return best;
}

std::vector<std::int64_t> grainsInRectangle(const VisibleGrains& grains, const PictureGeometry& picture,
                                            int x0, int y0, int x1, int y1) {
  const CameraAxes axes = axesOf(picture.camera);
  const double left = std::min(x0, x1), right = std::max(x0, x1) + 1.0;
  const double top = std::min(y0, y1), bottom = std::max(y0, y1) + 1.0;
  std::vector<std::int64_t> ids;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const Vec3 d = grains.position[k] - picture.camera.position;
    const double scale = pixelsPerMetre(picture, d.dot(axes.forward));
    const double x = picture.width / 2.0 + scale * d.dot(axes.right);
    const double y = picture.height / 2.0 - scale * d.dot(axes.up);
    if (scale > 0 && x >= left && x < right && y >= top && y < bottom) ids.push_back(grains.id[k]);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end()); // periodic images
  return ids;
}

} // namespace sandglass::vis
