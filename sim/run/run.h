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
#include <string>
#include <vector>

namespace sandglass {

struct RunOptions {
  std::filesystem::path folder;   ///< empty: nothing is written
  int threads = 0;                ///< 0: all cores
  bool resume = false;            ///< go on from the newest checkpoint in `folder`
  double liveInterval = 0;        ///< [s wall], offer a Frame to onLiveFrame at most this often; 0: never
};

/// One row of series.csv: time and the values of one probe.
struct ProbeSample {
  std::string probe;
  double time = 0;
  std::map<std::string, double> values; ///< "translational", "mass", "rate", "force.x", ...
};

struct Progress {
  std::string stage;
  double time = 0;                ///< [s] simulated
  std::int64_t step = 0;
  std::size_t grains = 0;
  double fraction = 0;            ///< of the whole run, 0..1, an estimate
  double secondsLeft = 0;         ///< wall time, an estimate; negative when unknown
  double grainStepsPerSecond = 0;
};

enum class RunOutcome { finished, stopped };

class Run {
public:
  Run(Scene scene, RunOptions options, Log log = {});
  ~Run();

  // Called from the thread of execute(); set before it starts.
  std::function<void(FramePtr)> onLiveFrame;   ///< newest state, at most every liveInterval
  std::function<void(FramePtr)> onSavedFrame;  ///< each frame of the output interval
  std::function<void(const ProbeSample&)> onSample;
  std::function<void(const Progress&)> onProgress;

  /// Runs to the end or until stop(). Throws RunError (state kept in the last good checkpoint).
  RunOutcome execute();

  // Safe from any thread and from a signal handler (atomics only).
  void stop() { stop_ = true; }               ///< finish the step, write a checkpoint, return
  void pause(bool on) { paused_ = on; }
  void stepOnce(int steps) { single_ += steps; } ///< while paused: advance this many steps

  const Scene& scene() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::atomic<bool> stop_{false}, paused_{false};
  std::atomic<int> single_{0};
};

} // namespace sandglass
