#pragma once
// Everything that a run leaves behind: probes and series.csv, frames, checkpoints, scene.toml, log.txt.
// With an empty folder nothing is written, and probes and frames still reach the callers.

#include "sim/base/log.h"
#include "sim/io/series.h"
#include "sim/run/checkpoint_store.h"
#include "sim/run/folder_lock.h"
#include "sim/run/frame_queue.h"
#include "sim/run/probe.h"
#include "sim/run/run.h"
#include "sim/run/schedule.h"

#include <fstream>
#include <functional>
#include <optional>

namespace sandglass {

class RunRecorder {
public:
  /// Frame segments that there were when a checkpoint was written; nothing when it does not say.
  static std::optional<std::uint64_t> segmentsAt(const Solver::State& state);
  /// Refuses a folder that holds a run (InputError) unless `options` say resume or overwrite.
  RunRecorder(const Scene& scene, const RunOptions& options, double stepSize, Log log);

  /// What the newest checkpoint holds, when resuming and there is one; the folder then is as it was at that
  /// checkpoint: later frames and rows are gone.
  std::optional<Solver::State> restore();
  /// Begins to write; after restore().
  void open();

  std::int64_t nextDue(std::int64_t step) const; ///< next step with a sample, a frame or a checkpoint
  bool frameDue(std::int64_t step) const { return frames_.isDue(step); }
  bool checkpointDue(std::int64_t step) const { return checkpoints_.isDue(step); }

  /// Samples the probes that are due (all of them at the `last` step), once a step.
  void sample(const Solver& solver, bool last, const std::function<void(const ProbeSample&)>& onSample);
  /// Rows of discharged.csv for those that passed an outlet which records.
  void left(const std::vector<LeftGrain>& grains, double stepSize);
  /// Writes a frame unless this step has one already; false then.
  bool needsFrame(std::int64_t step) const { return step != lastFrame_; }
  void write(FramePtr frame);
  /// Closes the segment, then writes solver and run state.
  void checkpoint(Solver& solver, Solver::State runState);

  /// After the scene has got an event.
  void writeScene() const;

  std::size_t frameCount() const { return frameCount_; }
  const Log& log() const { return log_; } ///< to the caller's log and log.txt
  /// "the last good checkpoint is FILE", or that there is none.
  std::string lastCheckpoint() const;

private:
  struct Entry {
    std::string name;
    Schedule schedule;
    std::unique_ptr<Probe> probe;
  };
  bool writes() const { return !folder_.empty(); }
  void prepareFolder(const RunOptions& options);
  void load(const Solver::State& state);

  const Scene& scene_;
  std::filesystem::path folder_;
  Log log_;
  std::shared_ptr<std::ofstream> logFile_;
  Schedule frames_, checkpoints_;
  std::vector<Entry> probes_;
  std::optional<FolderLock> lock_;
  std::optional<CheckpointStore> store_;
  std::optional<SeriesWriter> series_, discharged_;
  std::optional<FrameQueue> queue_;
  std::filesystem::path lastCheckpoint_;
  bool resume_ = false;
  std::int64_t lastFrame_ = -1, lastSample_ = -1; ///< steps
  std::uint64_t frameCount_ = 0, segments_ = 0, seriesBytes_ = 0, dischargedBytes_ = 0;
};

/// Interval [s] of checkpoints when the scene leaves it open: twenty in a run whose length is known.
double checkpointInterval(const Scene& scene, double stepSize);

} // namespace sandglass
