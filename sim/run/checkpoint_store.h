#pragma once
// checkpoints/ of a run: <step, 12 digits>.checkpoint. The two newest stay, and spaced ones, at most twenty
// and the first: once there are more, every second, fourth, ... of the schedule stays.

#include "sim/base/log.h"
#include "sim/run/schedule.h"
#include "sim/solvers/solver.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace sandglass {

class CheckpointStore {
public:
  CheckpointStore(std::filesystem::path runFolder, Schedule schedule);
  std::filesystem::path write(std::int64_t step, const Solver::State& state);
  struct Found {
    std::filesystem::path file;
    Solver::State state;
  };
  /// The newest that is whole; torn ones are passed over with a warning.
  std::optional<Found> newest(const Log& log) const;

private:
  void thinOut() const;
  std::filesystem::path folder_;
  Schedule schedule_;
};

/// Step in the name of a checkpoint file; -1 when it is none.
std::int64_t checkpointStep(const std::filesystem::path& file);

/// Checkpoints of a run folder in ascending order of step.
std::vector<std::filesystem::path> checkpointFiles(const std::filesystem::path& runFolder);

} // namespace sandglass
