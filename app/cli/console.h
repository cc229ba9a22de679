#pragma once
// What the command line prints: log lines and progress.

#include "sim/base/log.h"

#include <chrono>
#include <string>

namespace sandglass::cli {

/// Information to standard output, warnings and errors to standard error.
Log consoleLog();

/// A bar with time left where a terminal is attached, a plain line now and then elsewhere. Shows nothing for
/// work shorter than a second.
class ProgressBar {
public:
  explicit ProgressBar(std::string what);
  ~ProgressBar();
  /// `fraction` 0..1; `secondsLeft` negative when unknown; `detail` is appended.
  void update(double fraction, double secondsLeft, const std::string& detail);
  void finish();

private:
  std::string what_;
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
  int lastTenth_ = -1;
};

} // namespace sandglass::cli
