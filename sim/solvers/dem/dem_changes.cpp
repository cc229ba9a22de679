// What changes while a run goes on: walls, gravity, fields, stages. Each at a step boundary, with the
// velocities of that instant kept.

#include "sim/base/error.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

namespace sandglass {

namespace {

/// A wall that goes to and fro within few steps would be seen at a few places of its way, or at one alone.
void refuseUnresolved(const WallSpec& wall, double pace, double dt) {
  constexpr double fewest = 10; // steps a period
  if (wall.motion.kind != "oscillate") return;
  const double frequency = pace * wall.motion.parameters.number("frequency");
  if (frequency * dt * fewest > 1.0)
    throw InputError(
        fmt::format("the wall '{}' oscillates {:.3g} times a second, with {:.3g} steps of {:.3g} s a "
                    "period, but {:g} are needed; lower its frequency or time_step",
                    wall.name, frequency, 1.0 / (frequency * dt), dt, fewest));
}

} // namespace

void DemSolver::refuseFastWalls(double fastest) const {
  for (const WallSpec& wall : scene_.walls)
    refuseUnresolved(wall, 1.0, dt_);
  if (fastest * dt_ > scene_.accuracy.maximumTravel * smallestRadius_)
    throw InputError(fmt::format(
        "a wall moves at up to {:.3g} m/s, {:.3g} m in a step of {:.3g} s, more than {:g} times "
        "the smallest radius ({:.3g} m, accuracy.maximum_travel), and could jump over a grain; slow "
        "it down or lower time_step",
        fastest, fastest * dt_, dt_, scene_.accuracy.maximumTravel, smallestRadius_));
}

void DemSolver::removeWall(const std::string& name) {
  for (SolverWall& w : walls_)
    if (w.name == name) {
      changeAhead();
      w.active = false;
      return;
    }
  throw InputError(fmt::format("there is no wall '{}' to remove", name));
}

void DemSolver::setWallPace(const std::string& name, double pace) {
  for (SolverWall& w : walls_)
    if (w.name == name && w.motion) {
      refuseFastWalls(pace * w.motion->topSpeed(wallRadius_));
      for (const WallSpec& wall : scene_.walls)
        if (wall.name == name) refuseUnresolved(wall, pace, dt_);
      changeAhead(); // grains near it are listed for its new speed
      w.motion->setPace(w.marks, pace, time());
      placeWalls(walls_, time(), 0.0);
      return;
    }
  throw InputError(fmt::format("there is no wall '{}' with a motion whose pace could change", name));
}

void DemSolver::setGravity(const Vec3& gravity) {
  prepare();
  // Velocities are half a step behind: those of the full step stay when the kick that leads there is changed.
  const Vec3 kick = halfStep() * (gravity_ - gravity);
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    if (heldFast(i)) continue;
    Quad& v = grains_.motion[i];
    v = {v.x + kick.x(), v.y + kick.y(), v.z + kick.z(), v.w};
  }
  gravity_ = gravity;
  atFullStep_.valid = false;
}

void DemSolver::setField(const std::string& name, double factor) {
  prepare();
  // As for gravity: velocities of the full step stay when the half kick that leads there becomes another one.
  std::vector<Quad> before, torqueBefore, after, torqueAfter;
  evaluate(before, torqueBefore);
  fields_.setFactor(name, factor);
  evaluate(after, torqueAfter);
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    if (heldFast(i)) continue;
    Quad& v = grains_.motion[i];
    const Vec3 kick = halfStep() * v.w * (before[i].vec() - after[i].vec());
    v = {v.x + kick.x(), v.y + kick.y(), v.z + kick.z(), v.w};
    if (!grains_.turning) continue;
    Quad& u = grains_.roll[i];
    const Vec3 turn =
        halfStep() * grains_.place[i].w / grains_.inertia(i) * (torqueBefore[i].vec() - torqueAfter[i].vec());
    u = {u.x + turn.x(), u.y + turn.y(), u.z + turn.z(), u.w};
  }
  atFullStep_.valid = false;
}

void DemSolver::beginStage(const std::string& name) {
  markStage(walls_, name, time());
  placeWalls(walls_, time(), 0.0);
  if (!stale_) atFullStep_.valid = false;
}

} // namespace sandglass
