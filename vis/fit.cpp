#include "vis/fit.h"

#include "vis/camera.h"
#include "vis/overlay.h"
#include "vis/periodic_images.h"
#include "vis/visible_grains.h"

#include <algorithm>
#include <cmath>

namespace sandglass::vis {

namespace {

bool hasDomain(const Frame& frame) {
  const Vec3 size = frame.domain.upper - frame.domain.lower;
  return size.allFinite() && (size.array() > 0).all();
}

std::vector<Vec3> cornersOf(const Eigen::AlignedBox3d& box) {
  std::vector<Vec3> all;
  for (int k = 0; k < 8; ++k)
    all.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
  return all;
}

} // namespace

void GrainExtent::add(const Frame& frame) {
  const VisibleGrains grains = visibleGrains(frame, View{});
  const bool gridded = hasDomain(frame);
  const Vec3 lower = frame.domain.lower, part = (frame.domain.upper - lower) / parts;
  const auto cell = [&](double x, int axis) {
    return std::clamp(static_cast<int>(std::floor((x - lower[axis]) / part[axis])), 0, parts - 1);
  };
  for (std::size_t i = 0; i < grains.position.size(); ++i) {
    const Vec3 first = grains.position[i] - Vec3::Constant(grains.radius[i]);
    const Vec3 last = grains.position[i] + Vec3::Constant(grains.radius[i]);
    box_.extend(first);
    box_.extend(last);
    if (!gridded) continue;
    for (int x = cell(first.x(), 0); x <= cell(last.x(), 0); ++x)
      for (int y = cell(first.y(), 1); y <= cell(last.y(), 1); ++y)
        for (int z = cell(first.z(), 2); z <= cell(last.z(), 2); ++z)
          cells_.set(static_cast<std::size_t>(x + parts * (y + parts * z)));
  }
}

std::vector<Vec3> GrainExtent::corners(const Frame& frame) const {
  if (!hasDomain(frame)) return cornersOf(box_);
  const Vec3 lower = frame.domain.lower, part = (frame.domain.upper - lower) / parts;
  std::vector<Vec3> all;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (!cells_[c]) continue;
    const int n = static_cast<int>(c);
    const Vec3 corner = lower + part.cwiseProduct(Vec3(n % parts, n / parts % parts, n / parts / parts));
    for (const Vec3& p : cornersOf({corner, corner + part}))
      all.push_back(p);
  }
  return all;
}

Eigen::AlignedBox3d domainBox(const Frame& frame) {
  if (hasDomain(frame)) return {frame.domain.lower, frame.domain.upper};
  GrainExtent grains;
  grains.add(frame);
  Eigen::AlignedBox3d box = grains.box();
  for (const auto& wall : frame.walls) {
    const auto bounds = wall.shape->bounds();
    if (bounds.min().allFinite() && bounds.max().allFinite()) box.extend(bounds);
  }
  if (box.isEmpty()) box = {-Vec3::Ones(), Vec3::Ones()};
  return box;
}

std::vector<Vec3> fitPoints(const Frame& frame, const GrainExtent& grains) {
  if (grains.empty()) return cornersOf(domainBox(frame));
  std::vector<Vec3> points = grains.corners(frame);
  Eigen::AlignedBox3d reach = grains.box();
  const Vec3 most = 1.25 * grains.box().sizes();
  reach.extend(Vec3(reach.min() - most));
  reach.extend(Vec3(reach.max() + most));
  for (const auto& wall : frame.walls)
    if (wall.active && reach.contains(wall.shape->bounds()))
      for (const Vec3& p : wall.shape->mesh(reach).points)
        points.push_back(p);
  return points;
}

Camera fitCamera(const Frame& frame, const View& view, const GrainExtent& grains) {
  if (view.camera.preset.empty()) return view.camera;
  const bool titled = !view.title.empty() || frame.provenance.contains("title");
  const std::vector<Vec3> once = fitPoints(frame, grains);
  std::vector<Vec3> points;
  for (const Vec3& shift : imageShifts(frame.domain, view))
    for (const Vec3& p : once)
      points.push_back(p + shift);
  return resolve(view.camera, points, thinDirection(domainBox(frame), frame.domain.periodic),
                 static_cast<double>(view.width) / view.height, freeArea(view, titled));
}

} // namespace sandglass::vis
