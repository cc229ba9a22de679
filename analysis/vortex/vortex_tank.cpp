#include "analysis/vortex/vortex_tank.h"

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {

bool parallel(const Vec3& a, const Vec3& b) {
  return a.cross(b).norm() <= 1e-6 * a.norm() * b.norm();
}

/// Height of a wall that may be a floor; its key names differ by kind.
std::optional<double> floorHeight(const Choice& shape, const Vec3& up) {
  const Parameters& p = shape.parameters;
  const char* point = shape.kind == "plane" ? "point" : "centre";
  if (shape.kind != "plane" && shape.kind != "disc" && shape.kind != "rectangle") return std::nullopt;
  if (!p.has("normal") || !p.has(point) || !parallel(p.vector("normal"), up)) return std::nullopt;
  return p.vector(point).dot(up);
}

} // namespace

std::optional<VortexTank> tankOf(const Scene& scene) {
  VortexTank tank;
  if (scene.gravity.norm() > 0) {
    tank.gravity = scene.gravity.norm();
    tank.up = -scene.gravity / tank.gravity;
  }
  const Parameters* cylinder = nullptr;
  for (const auto& wall : scene.walls)
    if (!cylinder && wall.shape.kind == "cylinder" && parallel(wall.shape.parameters.vector("axis"), tank.up))
      cylinder = &wall.shape.parameters;
  if (!cylinder) return std::nullopt;
  tank.radius = cylinder->number("radius");
  tank.onAxis = cylinder->vector("base");
  const double base = tank.onAxis.dot(tank.up), height = cylinder->number("height");
  const bool upright = cylinder->vector("axis").dot(tank.up) > 0;
  const double low = upright ? base : base - height, high = upright ? base + height : base;
  tank.floor = low;
  tank.top = high;
  for (const auto& wall : scene.walls)
    if (const auto z = floorHeight(wall.shape, tank.up); z && *z < 0.5 * (low + high))
      tank.floor = std::max(tank.floor, *z);
  return tank;
}

} // namespace sandglass::analysis
