#pragma once
// How much the window costs a run, and whether it stays awake meanwhile.

#include "desktop_harness.h"

#include <algorithm>
#include <chrono>
#include <set>

namespace sandglass::test {

/// Grain-steps per second of wall time between the first progress report and the last.
class SpeedMeter {
public:
  using Clock = std::chrono::steady_clock;
  void see(const Progress& p) {
    const auto now = Clock::now();
    if (reports_++ == 0) start_ = now, first_ = p;
    end_ = now;
    last_ = p;
  }
  double steps() const { return static_cast<double>(last_.step - first_.step); }
  double speed() const { return static_cast<double>(last_.grains) * steps() / seconds(); }
  double seconds() const { return std::chrono::duration<double>(end_ - start_).count(); }

private:
  int reports_ = 0;
  Clock::time_point start_, end_;
  Progress first_, last_;
};

struct Turn {
  double speed = 0; ///< grain-steps/s
  double seconds = 0, steps = 0;
  double pictures = 0; ///< new ones a second
  double stall = 0;    ///< [s] longest of the event loop while the run goes on
  double memory = 0;   ///< [bytes] most that the process held
};

/// The most that the process has held so far counts anew from now on.
inline void forgetPeakMemory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}
inline double peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stod(line.substr(6));
  return 0;
}

inline Turn headlessTurn(const std::filesystem::path& scene, const std::filesystem::path& folder,
                         int threads) {
  forgetPeakMemory();
  RunOptions options;
  options.folder = folder;
  options.threads = threads;
  Run run(readScene(scene.string()), options);
  SpeedMeter meter;
  run.onProgress = [&](const Progress& p) { meter.see(p); };
  run.execute();
  return {meter.speed(), meter.seconds(), meter.steps(), 0, 0, peakMemory()};
}

/// The same run in a window of 1440 by 900 with three live panels beside the picture: energies, g(r) and a
/// histogram.
inline Turn windowTurn(const std::filesystem::path& scene, const std::filesystem::path& folder, int threads) {
  using Clock = SpeedMeter::Clock;
  forgetPeakMemory();
  Desktop desktop(folder, threads);
  desktop.window->resize(1440, 900);
  auto* histogram = desktop.window->dock("histogram");
  desktop.window->addDockWidget(Qt::RightDockWidgetArea, histogram);
  histogram->show();
  desktop.open(scene);
  waitFor([&] { return desktop.window->isSettled(); }); // the preview
  SpeedMeter meter;
  std::set<std::int64_t> frames; // steps of those that were shown
  Clock::time_point firstPicture, lastPicture;
  QObject::connect(&desktop.session(), &desktop::Session::progressArrived,
                   [&] { meter.see(*desktop.session().progress()); });
  Turn turn;
  QElapsedTimer beat;
  QTimer heart;
  heart.setTimerType(Qt::PreciseTimer);
  heart.setInterval(5);
  QObject::connect(&heart, &QTimer::timeout, [&] {
    turn.stall = std::max(turn.stall, 1e-9 * static_cast<double>(beat.nsecsElapsed()) - 5e-3);
    beat.start();
    const auto frame = desktop.window->shownFrame();
    if (!frame || !frames.insert(frame->step).second) return;
    lastPicture = Clock::now();
    if (frames.size() == 1) firstPicture = lastPicture;
  });
  QEventLoop loop;
  QObject::connect(&desktop.session(), &desktop::Session::runEnded, &loop, &QEventLoop::quit);
  desktop.key(Qt::Key_F5);
  beat.start();
  heart.start();
  loop.exec();
  heart.stop();
  turn.speed = meter.speed();
  turn.seconds = meter.seconds();
  turn.steps = meter.steps();
  turn.memory = peakMemory();
  // From the first to the last: the shaders of the first are compiled while the run begins.
  const std::chrono::duration<double> shown = lastPicture - firstPicture;
  turn.pictures = frames.size() > 1 ? static_cast<double>(frames.size() - 1) / shown.count() : 0;
  return turn;
}

} // namespace sandglass::test
