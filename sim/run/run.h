#pragma once
// Drives a solver through the stages of a scene: probes, frames, checkpoints, progress, cancellation.
// The command line and the desktop use this same class; the desktop calls execute() in a thread of its own.

#include "sim/base/log.h"
#include "sim/frame/frame.h"
#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace sandglass {

/// How a Run gets its solver; makeSolver() unless told otherwise.
using SolverFactory = std::function<std::unique_ptr<Solver>(const Scene&, const SolverOptions&)>;

struct RunOptions {
  std::filesystem::path folder; ///< empty: nothing is written
  int threads = 0;              ///< 0: all cores
  bool resume = false;          ///< go on from the newest checkpoint in `folder`; from the start if none
  std::int64_t pauseAt = -1;    ///< step at which the run pauses by itself; negative: none
  bool wallLoads = true;        ///< frames tell what grains do to walls (SolverOptions)
  bool overwrite = false;       ///< delete the run that `folder` holds; else a run there is refused
  double liveInterval = 0;      ///< [s wall], offer a Frame to onLiveFrame at most this often; 0: never
  double checkpointWallInterval =
      600;                     ///< [s wall] of computing at most between checkpoints; no bit depends on it
  SolverFactory solverFactory; ///< empty: makeSolver
};

/// What one probe saw at one time. series.csv has a column `<probe>.<value>` for each.
struct ProbeSample {
  std::string probe;
  double time = 0;
  std::map<std::string, double> values; ///< "translational", "mass", "rate", "force.x", ...
};

struct Progress {
  std::string stage;
  double time = 0; ///< [s] simulated
  std::int64_t step = 0;
  std::size_t grains = 0;
  double fraction = 0;    ///< of the whole run, 0..1, an estimate
  double secondsLeft = 0; ///< wall time, an estimate; negative when unknown
  double grainStepsPerSecond = 0;
};

enum class RunOutcome { finished, stopped };

/// What a run has done, for the last line of the command line.
struct RunSummary {
  std::size_t stagesDone = 0, stages = 0, frames = 0;
  std::vector<double> stageStarts; ///< [s], of the stages that have begun
  double time = 0;                 ///< [s] simulated
  std::int64_t steps = 0;          ///< since the start of the run
  std::size_t grains = 0;          ///< present at the end
  Flow flow;
  double wallSeconds = 0; ///< of this execute(), pauses left out
  double grainSteps = 0;  ///< of this execute()
};

class Run {
public:
  Run(Scene scene, RunOptions options, Log log = {});
  ~Run();

  // Called from the thread of execute(); set before it starts.
  std::function<void(FramePtr)> onLiveFrame;  ///< newest state, at most every liveInterval
  std::function<void(FramePtr)> onSavedFrame; ///< each frame of the output interval
  std::function<void(const ProbeSample&)> onSample;
  std::function<void(const Progress&)> onProgress;
  std::function<void(const EventSpec&)> onChanged; ///< a change() has got its step

  /// Runs to the end or until stop(). Throws RunError (state kept in the last good checkpoint), InputError
  /// when the folder holds another run or grains cannot be placed. To be called once.
  RunOutcome execute();

  // Safe from any thread and from a signal handler (atomics only).
  void stop() { stop_ = true; } ///< finish the step, write a checkpoint, return
  void pause(bool on) { paused_ = on; }
  void stepOnce(int steps) { single_ += steps; } ///< while paused: advance this many steps
  /// Simulated seconds in a second of wall time at most; 0: as many as can be. No bit depends on it.
  void limitSpeed(double ratio) { speedLimit_ = ratio; }

  /// Something changes before the next step, paused or not: its step is set then, the scene gets it as an
  /// event, and scene.toml in the folder is written anew. Safe from any thread. Throws InputError for a wall
  /// that the scene does not have and for what is no number.
  void change(EventSpec event);

  const Scene& scene() const;
  RunSummary summary() const; ///< from the thread of execute(), at any time

private:
  RunOutcome loop();
  bool takeChanges();
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::atomic<bool> stop_{false}, paused_{false};
  std::atomic<int> single_{0};
  std::atomic<double> speedLimit_{0};
  std::mutex changesMutex_;
  std::vector<EventSpec> changes_; ///< not taken yet
};

} // namespace sandglass
