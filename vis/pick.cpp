#include "vis/pick.h"

#include "vis/superellipsoid.h"

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

} // namespace sandglass::vis
