#pragma once
// Works a sweep's table off: as many runs at once as there are cores, each on one, a row in the table as soon
// as a run is over, rounds of refinement when all of a level are.

#include "analysis/sweep/sweep_table.h"
#include "sim/base/log.h"

#include <atomic>
#include <functional>

namespace sandglass::analysis {

struct SweepProgress {
  std::size_t runs = 0, done = 0, failed = 0, going = 0;
  double fraction = 0;     ///< 0..1 of the runs that are known of
  double secondsLeft = -1; ///< an estimate; negative when unknown
};

struct SweepRunnerOptions {
  int threads = 0; ///< runs at once; 0: all cores
  /// Of several processes that share a sweep: only runs with (id - 1) % shares == share, and no refinement.
  int share = 0, shares = 1;
  Log log;                                              ///< failed runs
  std::function<void(const SweepProgress&)> onProgress; ///< ten times a second, from the calling thread
};

class SweepRunner {
public:
  SweepRunner(SweepTable& table, SweepRunnerOptions options);

  /// True when nothing is left to do, false when stopped. Rethrows faults of the table.
  bool execute();
  void stop() { stop_ = true; } ///< from any thread; runs that go on are given up

  /// Adds the next round of refinement when all runs are over; false: there is none.
  static bool refine(SweepTable& table);

private:
  bool work();
  SweepTable& table_;
  SweepRunnerOptions options_;
  std::atomic<bool> stop_{false};
};

} // namespace sandglass::analysis
