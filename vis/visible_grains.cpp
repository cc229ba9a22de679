#include "vis/visible_grains.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

namespace {

double substituteRadius(const Frame& frame) {
  if (frame.position.empty()) return 0;
  Eigen::AlignedBox3d box;
  for (const auto& p : frame.position)
    box.extend(p);
  const Vec3 size = box.sizes().cwiseMax(1e-3 * box.sizes().maxCoeff());
  const double spacing = std::cbrt(size.prod() / static_cast<double>(frame.size()));
  return spacing > 0 ? spacing / 2 : 1;
}

} // namespace

bool isClipped(const std::vector<ClipPlane>& clips, const Vec3& point) {
  return std::any_of(clips.begin(), clips.end(),
                     [&](const ClipPlane& c) { return (point - c.point).dot(c.normal) < 0; });
}

VisibleGrains visibleGrains(const Frame& frame, const View& view) {
  VisibleGrains result;
  if (!view.grains) return result;
  const bool hasRadius = frame.scalars.contains(quantity::radius);
  const std::vector<double>* radius = hasRadius ? &frame.scalar(quantity::radius) : nullptr;
  const double substitute = hasRadius ? 0 : substituteRadius(frame);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double r = radius ? (*radius)[i] : substitute;
    if (!frame.position[i].allFinite() || !(r > 0) || isClipped(view.clips, frame.position[i])) continue;
    result.index.push_back(i);
    result.id.push_back(i < frame.id.size() ? frame.id[i] : static_cast<std::int64_t>(i));
    result.position.push_back(frame.position[i]);
    result.radius.push_back(r);
  }
  return result;
}

std::vector<std::size_t> evenSubset(std::size_t size, int count) {
  const std::size_t kept = count > 0 ? std::min(size, static_cast<std::size_t>(count)) : size;
  std::vector<std::size_t> result(kept);
  for (std::size_t k = 0; k < kept; ++k)
    result[k] = k * size / kept;
  return result;
}

PickResult pickAlong(const Ray& ray, const VisibleGrains& grains) {
  // Sphere |o + t d - c|^2 = r^2: t = b - sqrt(b^2 - (|oc|^2 - r^2)) with oc = c - o, b = d . oc.
  PickResult best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grains.position.size(); ++i) {
    const Vec3 oc = grains.position[i] - ray.origin;
    const double b = ray.direction.dot(oc);
    const double missed = (oc - b * ray.direction).squaredNorm(), r = grains.radius[i];
    if (missed > r * r) continue;
    const double t = b - std::sqrt(r * r - missed);
    if (t <= 0 || t >= nearest) continue;
    nearest = t;
    best = {grains.id[i], ray.origin + t * ray.direction};
  }
  return best;
}

} // namespace sandglass::vis
