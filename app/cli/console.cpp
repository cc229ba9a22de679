#include "app/cli/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace sandglass::cli {

Log consoleLog() {
  return [](LogLevel level, const std::string& message) {
    if (level == LogLevel::info) {
      fmt::print("{}\n", message);
      std::fflush(stdout);
    } else {
      fmt::print(stderr, "{}{}\n", level == LogLevel::warning ? "warning: " : "error: ", message);
    }
  };
}

namespace {

std::string duration(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s % 3600 / 60);
}

} // namespace

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()),
      last_(start_) {}

ProgressBar::~ProgressBar() {
  finish();
}

void ProgressBar::update(double fraction, double secondsLeft, const std::string& detail) {
  using namespace std::chrono;
  const auto now = steady_clock::now();
  if (now - start_ < 1s) return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const std::string left = secondsLeft >= 0 ? duration(secondsLeft) + " left  " : "";
  if (terminal_) {
    if (shown_ && now - last_ < 100ms) return;
    constexpr int width = 30;
    const int filled = static_cast<int>(fraction * width);
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3.0f} %  {}{}\x1b[K", what_, "", filled, "", width - filled,
               100 * fraction, left, detail);
    std::fflush(stderr);
  } else {
    const int tenth = static_cast<int>(fraction * 10);
    if (tenth == lastTenth_ && now - last_ < 30s) return;
    lastTenth_ = tenth;
    fmt::print(stderr, "{}: {:.0f} %, {}{}\n", what_, 100 * fraction, left, detail);
  }
  shown_ = true;
  last_ = now;
}

void ProgressBar::finish() {
  if (shown_ && terminal_) fmt::print(stderr, "\n");
  shown_ = false;
}

} // namespace sandglass::cli
