#pragma once
// Prescribed motion of a wall: a closed form of simulated time, so that a run goes on from the time alone.
// To add one: a class and its description in wall_motion.cpp, and a line in motionKinds().

#include "sim/scene/parameters.h"
#include "sim/walls/wall_pose.h"

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

/// When a wall's clock runs. It shows 0 until its stage has begun and `start` has passed, and stands still
/// for good after `duration` or once `untilStage` has begun.
struct MotionClock {
  std::string stage, untilStage;                             ///< empty: the run's beginning, and never
  double start = 0;                                          ///< [s]
  double duration = std::numeric_limits<double>::infinity(); ///< [s]
};

/// Times at which the stages that a clock waits for began [s]; infinite until then.
struct MotionMarks {
  double began = std::numeric_limits<double>::infinity();
  double ended = std::numeric_limits<double>::infinity();
  // How fast the clock goes: 0 stands still. It showed `shown` at the time `changed`, when that was set [s].
  double pace = 1, changed = 0, shown = 0;
};

class WallMotion {
public:
  explicit WallMotion(MotionClock clock) : clock_(std::move(clock)) {}
  virtual ~WallMotion() = default;

  const MotionClock& clock() const { return clock_; }
  /// Time on the wall's clock [s].
  double elapsed(double time, const MotionMarks& marks) const;
  /// The clock goes on from what it shows at `time`, `pace` (0 or more) times as fast as simulated time.
  void setPace(MotionMarks& marks, double pace, double time) const;
  bool running(double time, const MotionMarks& marks) const;

  /// Pose after `elapsed` seconds of motion; continuous, and where the scene puts the wall for `elapsed` = 0
  /// but for an oscillation with a phase.
  virtual WallPose pose(double elapsed) const = 0;
  /// Velocity while the clock runs at pace 1. `reference` is the wall's point of reference in its own frame.
  virtual WallVelocity velocity(double elapsed, const Vec3& reference) const = 0;
  /// A point that the motion singles out for moments (on the axis of a rotation); false if none.
  virtual bool ownReference(Vec3&) const { return false; }
  /// Largest speed of any of its points within `radius` of the reference [m/s].
  virtual double topSpeed(double radius) const = 0;

private:
  double passed(double time, const MotionMarks& marks) const;

  MotionClock clock_;
};

struct MotionKind {
  std::string name;
  std::string description;
  std::vector<ParameterSpec> parameters;
  /// Throws InputError (a phrase without file and line) when the values contradict each other.
  std::function<std::shared_ptr<const WallMotion>(const Parameters&)> make;
};

/// All kinds, in the order of the documentation.
const std::vector<MotionKind>& motionKinds();
/// Null for "" (a wall that stands still). Throws InputError for a kind that does not exist.
std::shared_ptr<const WallMotion> makeMotion(const std::string& kind, const Parameters& parameters);

} // namespace sandglass
