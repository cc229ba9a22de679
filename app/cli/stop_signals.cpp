#include "app/cli/stop_signals.h"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace sandglass::cli {

namespace {

std::atomic<Run*> running{nullptr};
std::atomic<bool> stopAsked{false};

void onSignal(int number) {
  if (stopAsked.exchange(true)) _exit(128 + number);
  if (Run* run = running.load()) run->stop();
  constexpr char hint[] =
      "\nsandglass: finishing the step and writing a checkpoint; once more to leave at once\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, hint, sizeof hint - 1);
}

void handle(void (*handler)(int)) {
  for (const int number : {SIGINT, SIGTERM})
    std::signal(number, handler);
}

} // namespace

StopSignals::StopSignals(Run* run) {
  stopAsked = false;
  running = run;
  handle(onSignal);
}

StopSignals::~StopSignals() {
  handle(SIG_DFL);
  running = nullptr;
}

bool StopSignals::asked() {
  return stopAsked;
}

} // namespace sandglass::cli
