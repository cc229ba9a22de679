#include "sim/contact/solver_wall.h"

#include "sim/base/error.h"
#include "sim/walls/posed_shape.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

/// A moving wall's list is made to last about this many steps of its motion...
constexpr double stepsOfTravel = 64;
/// ... but reaches no further than this share of a grain's diameter.
constexpr double mostTravel = 0.5;

/// Middle of a shape; 0 along directions in which it has no end.
Vec3 middle(const WallShape& shape) {
  const Eigen::AlignedBox3d box = shape.bounds();
  Vec3 at = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (std::isfinite(box.min()[k]) && std::isfinite(box.max()[k]))
      at[k] = 0.5 * (box.min()[k] + box.max()[k]);
  return at;
}

/// Bound on how far the surface within `radius` of the reference lies between two poses.
double travel(const WallPose& a, const WallPose& b, const Vec3& restReference, double radius) {
  double way = (a.toSpace(restReference) - b.toSpace(restReference)).norm();
  // A turn by an angle moves a point at distance r by at most 2 r sin(angle / 2) = r |Ra - Rb| / sqrt(2).
  if (a.turned || b.turned) way += radius * (a.rotation - b.rotation).norm() / std::sqrt(2.0);
  return way;
}

} // namespace

std::vector<SolverWall> makeSolverWalls(const Scene& scene) {
  std::vector<SolverWall> walls;
  for (const WallSpec& spec : scene.walls) {
    SolverWall wall;
    wall.name = spec.name;
    const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                       [&](const Material& m) { return m.name == spec.material; });
    if (material == scene.materials.end())
      throw InputError(fmt::format("there is no material '{}'", spec.material));
    wall.material = static_cast<int>(material - scene.materials.begin());
    for (const WallKind& kind : wallKinds())
      if (kind.name == spec.shape.kind) wall.shape = kind.make(spec.shape.parameters);
    if (!wall.shape) throw InputError(fmt::format("there is no wall kind '{}'", spec.shape.kind));
    wall.motion = makeMotion(spec.motion.kind, spec.motion.parameters);
    if (!wall.motion || !wall.motion->ownReference(wall.restReference))
      wall.restReference = middle(*wall.shape);
    wall.velocity.reference = wall.contactVelocity.reference = wall.restReference;
    wall.counted = std::any_of(scene.probes.begin(), scene.probes.end(), [&](const ProbeSpec& probe) {
      return probe.what.kind == "wall_force" && probe.what.parameters.text("wall") == spec.name;
    });
    walls.push_back(std::move(wall));
  }
  placeWalls(walls, 0.0, 0.0);
  return walls;
}

void placeWalls(std::vector<SolverWall>& walls, double time, double dt) {
  for (SolverWall& wall : walls) {
    if (!wall.motion) continue;
    const WallMotion& motion = *wall.motion;
    const auto velocityAt = [&](double when) {
      const double elapsed = motion.elapsed(when, wall.marks);
      WallVelocity v = motion.velocity(elapsed, wall.restReference);
      v.linear *= wall.marks.pace;
      v.spin *= wall.marks.pace;
      if (!motion.running(when, wall.marks)) v.linear = v.spin = Vec3::Zero();
      return v;
    };
    wall.time = time;
    wall.pose = poseAt(wall, time);
    wall.velocity = velocityAt(time);
    wall.contactVelocity = dt > 0.0 ? velocityAt(time - 0.5 * dt) : wall.velocity;
  }
}

WallPose poseAt(const SolverWall& wall, double time) {
  return wall.motion ? wall.motion->pose(wall.motion->elapsed(time, wall.marks)) : wall.pose;
}

void markStage(std::vector<SolverWall>& walls, const std::string& stage, double time) {
  for (SolverWall& wall : walls) {
    if (!wall.motion) continue;
    if (wall.motion->clock().stage == stage) wall.marks.began = std::min(wall.marks.began, time);
    if (wall.motion->clock().untilStage == stage) wall.marks.ended = std::min(wall.marks.ended, time);
  }
}

void allowTravel(std::vector<SolverWall>& walls, double dt, double skin, double meanDiameter, double radius) {
  for (SolverWall& wall : walls) {
    if (!wall.motion) continue;
    const double speed =
        wall.motion->running(wall.time, wall.marks) ? wall.marks.pace * wall.motion->topSpeed(radius) : 0.0;
    wall.allowance = 0.5 * skin + std::min(stepsOfTravel * dt * speed, mostTravel * meanDiameter);
    wall.listedTime = wall.time;
  }
}

bool wallsTravelledTooFar(const std::vector<SolverWall>& walls, double radius) {
  for (const SolverWall& wall : walls) {
    if (!wall.motion || !wall.active) continue;
    if (travel(wall.pose, poseAt(wall, wall.listedTime), wall.restReference, radius) > wall.allowance)
      return true;
  }
  return false;
}

double farthestReach(const std::vector<SolverWall>& walls, const Domain& domain) {
  double farthest = 0.0;
  const Eigen::AlignedBox3d box(domain.lower, domain.upper);
  for (const SolverWall& wall : walls)
    for (int corner = 0; wall.motion && corner < 8; ++corner)
      farthest = std::max(
          farthest,
          (box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - wall.restReference).norm());
  return farthest;
}

double fastestWall(const Scene& scene) {
  const std::vector<SolverWall> walls = makeSolverWalls(scene);
  const double radius = farthestReach(walls, scene.domain);
  double fastest = 0.0;
  for (const SolverWall& wall : walls)
    if (wall.motion) fastest = std::max(fastest, wall.motion->topSpeed(radius));
  return fastest;
}

FrameWall frameWall(const SolverWall& wall, const Vec3& force, const Vec3& torqueAboutOrigin) {
  FrameWall out;
  out.name = wall.name;
  out.shape = wall.motion ? posed(wall.shape, wall.pose) : wall.shape;
  out.active = wall.active;
  out.force = force;
  out.reference = wall.velocity.reference;
  out.torque = torqueAboutOrigin - out.reference.cross(force);
  out.velocity = wall.velocity.linear;
  out.spin = wall.velocity.spin;
  out.rotation = Eigen::Quaterniond(wall.pose.rotation);
  out.translation = wall.pose.translation;
  out.moving = wall.motion != nullptr;
  out.work = wall.tally.work;
  out.power = wall.tally.power;
  out.wearWork = wall.tally.wearWork;
  out.collisions = wall.tally.collisions;
  return out;
}

} // namespace sandglass
