#pragma once
// Ctrl-C and termination while runs go on.

#include "sim/run/run.h"

namespace sandglass::cli {

/// While one lives, the first signal asks for a clean stop, the second leaves the program at once; the last
/// checkpoint is whole at any moment. One at a time.
class StopSignals {
public:
  /// `run`: is told to stop by the signal itself; without, somebody must look at asked().
  explicit StopSignals(Run* run = nullptr);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool asked();
};

} // namespace sandglass::cli
