#include "sim/scene/check_wedge.h"

#include "sim/math/sector.h"
#include "sim/scene/check_parts.h"
#include "sim/walls/wall_motion.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

/// Points spread evenly in a box: additive recurrence with the powers of the root of x^4 = x + 1.
template <class Visit> void eachPoint(const Eigen::AlignedBox3d& box, int count, Visit&& visit) {
  constexpr double g = 1.22074408460575947536;
  for (int i = 1; i <= count; ++i) {
    const Vec3 unit(std::fmod(i / g, 1.0), std::fmod(i / (g * g), 1.0), std::fmod(i / (g * g * g), 1.0));
    visit(Vec3(box.min() + unit.cwiseProduct(box.sizes())));
  }
}

/// A shape that is not its own image differs from it in distance near every point of the difference; the
/// points stand so close that a difference of a hundredth of the shape's size is met.
bool sameWhenTurned(const WallShape& shape, const Sector& sector, const Eigen::AlignedBox3d& space) {
  const Eigen::AlignedBox3d bounds = shape.bounds();
  Eigen::AlignedBox3d box = bounds.intersection(space);
  for (int turn = 1; turn < sector.count(); ++turn) // all images of the space are the shape's space, too
    for (int c = 0; c < 8; ++c)
      box.extend(sector.turned(space.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)), turn));
  const double size = box.sizes().maxCoeff(), tolerance = 1e-7 * size;
  bool same = true;
  const auto equal = [&](double a, double b) { return a == b || std::abs(a - b) <= tolerance; };
  eachPoint(box, 1000, [&](const Vec3& x) {
    const Vec3 turned = sector.turned(x, 1);
    same = same && equal(shape.signedDistance(x), shape.signedDistance(turned));
    WallShape::Touches here, there;
    shape.touches(x, size, here);
    shape.touches(turned, size, there);
    double nearest[2] = {size, size};
    for (int i = 0; i < here.count; ++i)
      nearest[0] = std::min(nearest[0], here.at[i].distance);
    for (int i = 0; i < there.count; ++i)
      nearest[1] = std::min(nearest[1], there.at[i].distance);
    same = same && equal(nearest[0], nearest[1]);
  });
  return same;
}

/// Whether it makes no difference to turn first and move then.
bool movesAlike(const WallMotion& motion, const Sector& sector, const Eigen::AlignedBox3d& space) {
  const double tolerance = 1e-9 * space.sizes().maxCoeff();
  bool alike = true;
  for (const double time : {0.0, 0.137, 1.29, 7.41}) {
    const WallPose pose = motion.pose(time);
    eachPoint(space, 20, [&](const Vec3& x) {
      alike = alike &&
              (pose.toSpace(sector.turned(x, 1)) - sector.turned(pose.toSpace(x), 1)).norm() <= tolerance;
    });
  }
  return alike;
}

bool along(const Vec3& v, int axis) {
  return v[(axis + 1) % 3] == 0.0 && v[(axis + 2) % 3] == 0.0;
}

void checkWalls(const Scene& scene, const Sector& sector, FaultList& faults) {
  const Eigen::AlignedBox3d space(scene.domain.lower, scene.domain.upper);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const WallSpec& wall = scene.walls[i];
    const std::string path = partPath("wall", wall.name, i);
    if (faults.has(path)) continue;
    const auto kind = std::find_if(wallKinds().begin(), wallKinds().end(),
                                   [&](const WallKind& k) { return k.name == wall.shape.kind; });
    if (kind != wallKinds().end() && !sameWhenTurned(*kind->make(wall.shape.parameters), sector, space))
      faults.about(path,
                   fmt::format("is not its own image under the wedge's turn by {:.6g} degrees about {}; take "
                               "walls that turn into themselves (cylinders, cones, discs about that "
                               "axis, planes across it) or the whole circle",
                               360.0 / sector.count(), scene.wedge->axis));
    else if (const auto motion = makeMotion(wall.motion.kind, wall.motion.parameters);
             motion && !movesAlike(*motion, sector, space))
      faults.about(path + ".motion",
                   fmt::format("is not its own image under the wedge's turns; with a wedge walls "
                               "can move along {0} or turn about it",
                               scene.wedge->axis));
  }
}

} // namespace

void checkWedge(const Scene& scene, FaultList& faults) {
  if (!scene.wedge || faults.has("wedge") || faults.has("domain")) return;
  const double angle = scene.wedge->angle, circles = 2.0 * std::numbers::pi / angle;
  if (std::abs(circles - std::round(circles)) > 1e-9 * circles || circles < 1.5)
    return faults.wrong(
        "wedge.angle",
        fmt::format("but a full circle is {:.6g} times that, and must be a whole number from 2 "
                    "of wedges; take for example {:.6g} degrees",
                    circles, 360.0 / std::max(2.0, std::round(circles))));
  const Sector sector = scene.sector();
  const std::string& axis = scene.wedge->axis;
  if (!faults.has("gravity") && !along(scene.gravity, sector.axis()))
    faults.wrong("gravity",
                 fmt::format("but with a wedge it must point along its axis {}; change one of them", axis));
  for (std::size_t i = 0; i < scene.events.size(); ++i)
    if (scene.events[i].gravity && !along(*scene.events[i].gravity, sector.axis()))
      faults.wrong(partPath("event", "", i) + ".gravity",
                   fmt::format("but with a wedge it must point along its axis {}", axis));
  for (std::size_t k = 0; k < 3; ++k)
    if (scene.domain.periodic[k]) {
      faults.wrong("domain.periodic", "but with a wedge no direction can be periodic; remove one of them");
      break;
    }
  for (std::size_t i = 0; i < scene.outlets.size(); ++i) {
    const OutletSpec& outlet = scene.outlets[i];
    const std::string path = partPath("outlet", outlet.name, i);
    if (!faults.has(path + ".normal") && !along(outlet.normal, sector.axis()))
      faults.wrong(path + ".normal", fmt::format("but with a wedge it must point along its axis {}", axis));
    if (outlet.recycle && !faults.has(path + ".recycle"))
      faults.about(path + ".recycle", "puts grains into a box, which a wedge cannot have; remove it");
  }
  checkWalls(scene, sector, faults);
}

} // namespace sandglass
