#include "app/desktop/simulation.h"

#include "sim/base/error.h"

#include <utility>

namespace sandglass::desktop {

namespace {

constexpr double liveInterval = 0.2; ///< [s wall] between frames that are offered for drawing

} // namespace

Simulation::Simulation(Scene scene, const SimulationOptions& options, std::shared_ptr<FrameStore> store)
    : store_(std::move(store)), resume_(options.resume), isPaused_(options.paused) {
  RunOptions run;
  run.folder = options.folder;
  run.threads = options.threads;
  run.resume = options.resume;
  run.liveInterval = liveInterval;
  run.pauseAt = options.pauseAt;
  pauseAt_ = options.pauseAt;
  run_ = std::make_unique<Run>(std::move(scene), run, [this](LogLevel level, const std::string& text) {
    {
      const std::lock_guard lock(mutex_);
      messages_.emplace_back(level, text);
    }
    notify();
  });
  run_->onLiveFrame = [this](FramePtr frame) {
    if (std::exchange(resume_, false)) store_->restartFrom(frame->time);
    if (frame->step == pauseAt_) isPaused_ = true; // the run does this by itself
    if (frame->step >= pauseAt_) pauseAt_ = -1;
    frame_.put(std::move(frame));
    notify();
  };
  run_->onSavedFrame = [this](FramePtr frame) {
    store_->append(std::move(frame));
    notify();
  };
  run_->onSample = [this](const ProbeSample& sample) {
    const std::lock_guard lock(mutex_);
    samples_.push_back(sample); // fetched with the next frame or progress
  };
  run_->onProgress = [this](const Progress& progress) {
    progress_.put(progress);
    notify();
  };
  run_->onChanged = [this](const EventSpec& event) {
    {
      const std::lock_guard lock(mutex_);
      changes_.push_back(event);
    }
    notify();
  };
  run_->limitSpeed(options.speedLimit);
  run_->pause(options.paused);
  thread_ = std::thread([this] { work(); });
}

Simulation::~Simulation() {
  run_->stop();
  thread_.join();
}

void Simulation::work() {
  bool complete = false;
  QString fault;
  try {
    complete = run_->execute() == RunOutcome::finished;
  } catch (const std::exception& e) {
    fault = QString::fromUtf8(e.what());
  }
  isFinished_ = true;
  Q_EMIT changed();
  Q_EMIT finished(complete, fault);
}

void Simulation::notify() {
  if (!told_.exchange(true)) Q_EMIT changed();
}

void Simulation::pause(bool on) {
  isPaused_ = on;
  run_->pause(on);
}

void Simulation::step(int steps) {
  pause(true);
  run_->stepOnce(steps);
}

void Simulation::stop() {
  run_->stop();
}

std::vector<ProbeSample> Simulation::takeSamples() {
  told_ = false;
  const std::lock_guard lock(mutex_);
  return std::exchange(samples_, {});
}

std::vector<EventSpec> Simulation::takeChanges() {
  const std::lock_guard lock(mutex_);
  return std::exchange(changes_, {});
}

std::vector<std::pair<LogLevel, std::string>> Simulation::takeMessages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

} // namespace sandglass::desktop
