#include "sim/grains/open_space.h"

#include "sim/walls/posed_shape.h"
#include "sim/walls/wall_motion.h"
#include "sim/walls/wall_registry.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

bool removedBy(const Scene& scene, const std::string& stage, const std::string& wall) {
  for (const auto& s : scene.stages) {
    if (std::find(s.removeWalls.begin(), s.removeWalls.end(), wall) != s.removeWalls.end()) return true;
    if (s.name == stage) break;
  }
  return false;
}

} // namespace

OpenSpace::OpenSpace(const Scene& scene, const std::string& stage)
    : domain_(scene.domain), sector_(scene.sector()), outlets_(scene.outlets) {
  for (const auto& wall : scene.walls) {
    if (removedBy(scene, stage, wall.name)) continue;
    for (const auto& kind : wallKinds())
      if (kind.name == wall.shape.kind) {
        const auto motion = makeMotion(wall.motion.kind, wall.motion.parameters);
        const auto shape = kind.make(wall.shape.parameters);
        walls_.push_back({wall.name, motion ? posed(shape, motion->pose(0.0)) : shape});
      }
  }
}

std::string OpenSpace::obstacle(const Vec3& centre, double radius, double mayOverlap) const {
  for (int k = 0; k < 3; ++k)
    if (!domain_.periodic[static_cast<std::size_t>(k)] &&
        (centre[k] < domain_.lower[k] || centre[k] > domain_.upper[k]))
      return "the domain";
  if (sector_.numberOf(centre) != 0) return "the faces of the wedge";
  if (sector_.radius(centre) < radius * (1 - mayOverlap) * sector_.coreRadius())
    return "its own image at the axis of the wedge";
  for (const auto& outlet : outlets_)
    if ((centre - outlet.point).dot(outlet.normal) > 0) return "the outlet '" + outlet.name + "'";
  const double needed = radius * (1 - mayOverlap);
  for (const auto& wall : walls_) {
    if (wall.shape->signedDistance(centre) < needed) return "the wall '" + wall.name + "'";
    WallShape::Touches touches;
    wall.shape->touches(centre, needed, touches);
    for (int i = 0; i < touches.count; ++i)
      if (touches.at[static_cast<std::size_t>(i)].distance < needed) return "the wall '" + wall.name + "'";
  }
  return "";
}

bool OpenSpace::admits(const Vec3& centre, double radius, double mayOverlap) const {
  return obstacle(centre, radius, mayOverlap).empty();
}

OpenSpace::Depth OpenSpace::deepest(const Vec3& centre, double radius) const {
  Depth most;
  for (const auto& wall : walls_) {
    if (wall.shape->signedDistance(centre) < 0) return {2 * radius, Vec3::Zero(), wall.name};
    WallShape::Touches touches;
    wall.shape->touches(centre, radius, touches);
    for (int i = 0; i < touches.count; ++i) {
      const WallTouch& touch = touches.at[static_cast<std::size_t>(i)];
      if (radius - touch.distance > most.depth)
        most = {radius - touch.distance, touch.normal.stableNormalized(), wall.name};
    }
  }
  return most;
}

std::string OpenSpace::squeezedBy(Vec3 centre, double radius) const {
  // Half the depth at a time, so that the centre crosses no wall. Between walls that meet at an angle of a
  // degree or more the depth shrinks by over 0.2% in fifty pushes; between those that never let the sphere go
  // it stays, after the first few, or goes round in a circle, so that the most of ten pushes is looked at.
  constexpr double mayStick = 0.01, shrinks = 0.998;
  constexpr int pushes = 100, circle = 10;
  double before = 0, after = 0;
  Depth at;
  for (int push = 0; push < pushes; ++push) {
    at = deepest(centre, radius);
    if (at.depth <= mayStick * radius) return "";
    if (push >= pushes / 2 - circle && push < pushes / 2) before = std::max(before, at.depth);
    if (push >= pushes - circle) after = std::max(after, at.depth);
    centre += 0.5 * at.depth * at.normal;
  }
  return after < shrinks * before ? "" : at.wall;
}

Vec3 OpenSpace::wrapped(Vec3 point) const {
  for (int k = 0; k < 3; ++k) {
    if (!domain_.periodic[static_cast<std::size_t>(k)]) continue;
    const double length = domain_.upper[k] - domain_.lower[k];
    point[k] -= length * std::floor((point[k] - domain_.lower[k]) / length);
    if (point[k] >= domain_.upper[k]) point[k] = domain_.lower[k];
  }
  return point;
}

} // namespace sandglass
