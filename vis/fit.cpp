#include "vis/fit.h"

#include "vis/camera.h"
#include "vis/overlay.h"
#include "vis/visible_grains.h"

#include <cmath>

namespace sandglass::vis {

namespace {

bool hasDomain(const Frame& frame) {
  const Vec3 size = frame.domain.upper - frame.domain.lower;
  return size.allFinite() && (size.array() > 0).all();
}

/// Lets the wall move each side of the box outwards by up to `most` of the box' size.
void takeIn(Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& wall, const Vec3& most) {
  for (int k = 0; k < 3; ++k) {
    const double down = box.min()[k] - wall.min()[k], up = wall.max()[k] - box.max()[k];
    if (down > 0 && down <= most[k]) box.min()[k] = wall.min()[k];
    if (up > 0 && up <= most[k]) box.max()[k] = wall.max()[k];
  }
}

} // namespace

Eigen::AlignedBox3d grainBox(const Frame& frame) {
  Eigen::AlignedBox3d box;
  const VisibleGrains grains = visibleGrains(frame, View{});
  for (std::size_t i = 0; i < grains.position.size(); ++i) {
    box.extend(grains.position[i] - Vec3::Constant(grains.radius[i]));
    box.extend(grains.position[i] + Vec3::Constant(grains.radius[i]));
  }
  return box;
}

Eigen::AlignedBox3d domainBox(const Frame& frame) {
  if (hasDomain(frame)) return {frame.domain.lower, frame.domain.upper};
  Eigen::AlignedBox3d box = grainBox(frame);
  for (const auto& wall : frame.walls) {
    const auto bounds = wall.shape->bounds();
    if (bounds.min().allFinite() && bounds.max().allFinite()) box.extend(bounds);
  }
  if (box.isEmpty()) box = {-Vec3::Ones(), Vec3::Ones()};
  return box;
}

Eigen::AlignedBox3d fitBox(const Frame& frame, const Eigen::AlignedBox3d& grains) {
  if (grains.isEmpty()) return domainBox(frame);
  Eigen::AlignedBox3d box = grains;
  const Vec3 most = 0.5 * grains.sizes();
  for (const auto& wall : frame.walls)
    if (wall.active) takeIn(box, wall.shape->bounds(), most);
  if (!hasDomain(frame)) return box;

  constexpr double parts = 8;
  const Vec3& lower = frame.domain.lower;
  const Vec3 part = (frame.domain.upper - lower) / parts;
  for (int k = 0; k < 3; ++k) {
    if (frame.domain.periodic[k]) {
      box.min()[k] = lower[k];
      box.max()[k] = frame.domain.upper[k];
      continue;
    }
    const double first = std::floor((box.min()[k] - lower[k]) / part[k] + 1e-9);
    const double last = std::ceil((box.max()[k] - lower[k]) / part[k] - 1e-9);
    box.min()[k] = lower[k] + part[k] * std::clamp(first, 0.0, parts - 1);
    box.max()[k] = lower[k] + part[k] * std::clamp(last, std::clamp(first, 0.0, parts - 1) + 1, parts);
  }
  return box;
}

Camera fitCamera(const Frame& frame, const View& view, const Eigen::AlignedBox3d& grains) {
  const bool titled = !view.title.empty() || frame.provenance.contains("title");
  return resolve(view.camera, fitBox(frame, grains), frame.domain.periodic,
                 static_cast<double>(view.width) / view.height, freeArea(view, titled));
}

} // namespace sandglass::vis
