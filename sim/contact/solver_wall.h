#pragma once
// The walls of a scene as a solver sees them: shape, material, where their motion has carried them, and what
// is summed over a run.

#include "sim/frame/frame.h"
#include "sim/scene/scene.h"
#include "sim/walls/wall_motion.h"
#include "sim/walls/wall_shape.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

/// Sums over a run. Of walls that move, and of those that a probe looks at (`counted`); else 0.
struct WallTally {
  double work = 0;             ///< [J] done by the moving wall on the grains
  double power = 0;            ///< [W] of it now
  double wearWork = 0;         ///< [J] of the tangential forces along the slip; counted walls only
  std::int64_t collisions = 0; ///< contacts begun; counted walls only
};

struct SolverWall {
  std::string name;
  std::shared_ptr<const WallShape> shape; ///< in the wall's own frame
  int material = 0;
  bool active = true;
  bool counted = false;

  std::shared_ptr<const WallMotion> motion; ///< null: never moves
  Vec3 restReference = Vec3::Zero();        ///< point of reference in the wall's frame [m]
  MotionMarks marks;
  double time = 0; ///< [s] of pose and velocity: that of the forces
  WallPose pose;
  WallVelocity velocity;
  WallVelocity contactVelocity; ///< at the time of the grains' velocities, half a step before, for the laws
  double allowance = 0;         ///< [m] that its surface may move before grains near it are listed anew
  double listedTime = 0;        ///< [s] when they were
  WallTally tally;

  /// As WallShape::touches(), in space.
  void touches(const Vec3& centre, double reach, WallShape::Touches& out) const {
    if (!motion) {
      shape->touches(centre, reach, out);
      return;
    }
    const int first = out.count;
    shape->touches(pose.toBody(centre), reach, out);
    if (pose.turned)
      for (int k = first; k < out.count; ++k)
        out.at[k].normal = pose.rotation * out.at[k].normal;
  }
};

/// At rest, where the scene puts them at time 0.
std::vector<SolverWall> makeSolverWalls(const Scene& scene);

/// To the time of the forces; grains' velocities are those of `dt` / 2 before.
void placeWalls(std::vector<SolverWall>& walls, double time, double dt);
/// Where the wall was at another time.
WallPose poseAt(const SolverWall& wall, double time);

/// A stage begins now: clocks that wait for it start or stop.
void markStage(std::vector<SolverWall>& walls, const std::string& stage, double time);

/// Grains near walls are being listed: each moving wall may go on by its allowance before that must
/// be done again. Half a skin at least, and enough for some steps of its motion; no grain is further than
/// `radius` from any wall's reference.
void allowTravel(std::vector<SolverWall>& walls, double dt, double skin, double meanDiameter, double radius);

/// Whether some wall has moved by more than its allowance since.
bool wallsTravelledTooFar(const std::vector<SolverWall>& walls, double radius);

/// Distance of the furthest corner of the domain from any moving wall's reference [m].
double farthestReach(const std::vector<SolverWall>& walls, const Domain& domain);

/// Largest speed of a wall within that distance of its reference, at any time [m/s].
double fastestWall(const Scene& scene);

/// As a frame shows it; force and torque are those on the wall [N], about the coordinates' origin [N m].
FrameWall frameWall(const SolverWall& wall, const Vec3& force, const Vec3& torqueAboutOrigin);

} // namespace sandglass
