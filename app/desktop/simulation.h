#pragma once
// A run in a thread of its own, seen from the window: newest frame, samples and progress are left in slots,
// and changed() says that there is something to fetch. The run never waits for the window.

#include "app/desktop/frame_store.h"
#include "app/desktop/one_slot.h"
#include "sim/run/run.h"

#include <QObject>
#include <QString>

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace sandglass::desktop {

struct SimulationOptions {
  std::filesystem::path folder; ///< of the run; empty: nothing is written
  bool resume = false;          ///< go on from the newest checkpoint in the folder
  bool paused = false;          ///< begin paused
  int threads = 0;              ///< 0: all cores
  std::int64_t pauseAt = -1;    ///< step at which it pauses by itself
  double speedLimit = 0;        ///< see Run::limitSpeed
};

class Simulation : public QObject {
  Q_OBJECT
public:
  /// Starts at once. Saved frames are appended to `store`.
  Simulation(Scene scene, const SimulationOptions& options, std::shared_ptr<FrameStore> store);
  ~Simulation() override; ///< stops and waits

  void pause(bool on);
  bool isPaused() const { return isPaused_; }
  void step(int steps);
  void stop(); ///< does not wait; finished() follows
  void limitSpeed(double ratio) { run_->limitSpeed(ratio); }
  /// Before the next step; throws InputError for what cannot be.
  void change(const EventSpec& event) { run_->change(event); }

  // What came since the last call.
  std::optional<FramePtr> takeFrame() { return frame_.take(); }
  std::optional<Progress> takeProgress() { return progress_.take(); }
  std::vector<ProbeSample> takeSamples();
  std::vector<EventSpec> takeChanges(); ///< that have got their step
  std::vector<std::pair<LogLevel, std::string>> takeMessages();

  bool isFinished() const { return isFinished_; }

Q_SIGNALS:                                            // from the simulation's thread
  void changed();                                     ///< once until everything has been fetched
  void finished(bool complete, const QString& fault); ///< complete: to the end, not stopped

private:
  void work();
  void notify();

  std::shared_ptr<FrameStore> store_;
  std::unique_ptr<Run> run_;
  bool resume_;
  std::int64_t pauseAt_ = -1;
  OneSlot<FramePtr> frame_;
  OneSlot<Progress> progress_;
  std::mutex mutex_;
  std::vector<ProbeSample> samples_;
  std::vector<EventSpec> changes_;
  std::vector<std::pair<LogLevel, std::string>> messages_;
  std::atomic<bool> told_{false}, isPaused_{false}, isFinished_{false};
  std::thread thread_;
};

} // namespace sandglass::desktop
