#include "app/desktop/session.h"

#include "sim/base/error.h"
#include "sim/run/branch.h"

#include <algorithm>
#include <utility>

namespace sandglass::desktop {

Session::Session(SessionOptions options) : options_(std::move(options)) {
  pool_.setMaxThreadCount(1);
}

Session::~Session() {
  pool_.waitForDone();
}

void Session::open(const QString& path) {
  asked_ = path;
  openBy([path, import = options_.import] { return openAny(path.toStdString(), import); });
}

void Session::openBranch(const std::filesystem::path& source, std::int64_t step) {
  const auto runs = options_.runsFolder;
  auto branched = std::make_shared<std::int64_t>(-1);
  openBy([=] {
    const auto folder = newRunFolder(source.has_parent_path() ? source.parent_path() : runs,
                                     source / (source.filename().string() + "-branch.toml"));
    *branched = branchRun(source, step, folder).step;
    return openAny(folder);
  });
  const auto once = std::make_shared<QMetaObject::Connection>();
  *once = connect(this, &Session::opened, this, [this, once, branched] {
    disconnect(*once);
    if (*branched < 0) return;
    pauseAt_ = *branched;
    start();
  });
}

void Session::openSweepRun(const std::filesystem::path& sweep, int run) {
  openBy([=] { return desktop::openSweepRun(sweep, run); });
  const auto once = std::make_shared<QMetaObject::Connection>();
  *once = connect(this, &Session::opened, this, [this, once] {
    disconnect(*once);
    if (current_.store->size() == 0) start();
  });
}

void Session::openBy(const std::function<Opened()>& read) {
  const quint64 order = ++opening_;
  pool_.start([this, order, read] {
    QStringList faults;
    auto result = std::make_shared<Opened>();
    try {
      *result = read();
    } catch (const InputError& e) {
      for (const auto& sentence : e.sentences())
        faults << QString::fromStdString(sentence);
    } catch (const std::exception& e) {
      faults << QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(this, [this, order, faults, result] {
      if (order != opening_) return;
      opened_ = order;
      if (!faults.isEmpty()) {
        Q_EMIT openFailed(faults);
        return;
      }
      retire();
      current_ = std::move(*result);
      live_.reset();
      progress_.reset();
      Q_EMIT opened();
      Q_EMIT stateChanged();
      lookOn(order);
    });
  });
}

void Session::lookOn(quint64 order) {
  const auto store = current_.store;
  pool_.start([this, order, store] {
    if (!store->complete()) store->refresh();
    QStringList remarks;
    const bool over = store->complete();
    if (over)
      for (const auto& remark : store->remarks())
        remarks << QString::fromStdString(remark);
    QMetaObject::invokeMethod(this, [this, order, over, remarks] {
      if (order != opening_) return;
      for (const auto& remark : remarks)
        Q_EMIT logged(static_cast<int>(LogLevel::warning), remark);
      if (over) return;
      Q_EMIT stateChanged();
      lookOn(order);
    });
  });
}

void Session::start(bool paused) {
  if (!canStart()) return;
  retired_.clear(); // waits: one of them may still write to this folder
  simulation_.reset();
  SimulationOptions options;
  options.threads = options_.threads;
  options.paused = paused;
  options.resume = current_.canResume;
  options.speedLimit = speedLimit_;
  options.pauseAt = std::exchange(pauseAt_, -1);
  if (current_.runFolder.empty()) {
    current_.runFolder =
        options_.folder.empty() ? newRunFolder(options_.runsFolder, current_.path) : options_.folder;
    options_.folder.clear(); // the next scene gets one of its own
  }
  options.folder = current_.runFolder;
  if (!options.resume) {
    current_.store = std::make_shared<FrameStore>(current_.runFolder);
    current_.series.clear();
  }
  resuming_ = options.resume;
  running_ = true;
  knownPaused_ = paused;
  simulation_ = std::make_unique<Simulation>(*current_.scene, options, current_.store);
  connect(simulation_.get(), &Simulation::changed, this, &Session::fetch);
  connect(simulation_.get(), &Simulation::finished, this, &Session::ended);
  // What it told before somebody listened is fetched by hand.
  QMetaObject::invokeMethod(this, &Session::fetch, Qt::QueuedConnection);
  Q_EMIT logged(static_cast<int>(LogLevel::info),
                QString("The run is kept in %1.").arg(QString::fromStdString(current_.runFolder.string())));
  Q_EMIT stateChanged();
}

void Session::pause(bool on) {
  if (!runs()) return;
  simulation_->pause(on);
  knownPaused_ = on;
  Q_EMIT stateChanged();
}

void Session::step(int steps) {
  if (!runs()) start(true);
  if (!runs()) return;
  simulation_->step(steps);
  knownPaused_ = true;
  Q_EMIT stateChanged();
}

void Session::stop() {
  if (runs()) simulation_->stop();
}

void Session::limitSpeed(double ratio) {
  speedLimit_ = ratio;
  if (runs()) simulation_->limitSpeed(ratio);
}

QString Session::change(const EventSpec& event) {
  if (!runs()) return "Nothing runs that could be changed; run the scene, or branch from a frame.";
  try {
    simulation_->change(event);
    return {};
  } catch (const Error& e) {
    return QString::fromUtf8(e.what());
  }
}

void Session::setScene(Scene scene, const QString& text, const QString& resolved) {
  if (runs()) return;
  const bool same = current_.scene && sceneHash(*current_.scene) == sceneHash(scene);
  current_.scene = std::move(scene);
  current_.sceneText = text;
  current_.resolved = resolved;
  if (same) return;
  current_.runFolder.clear();
  current_.canResume = false;
  if (current_.store->size() > 0) {
    current_.store = std::make_shared<FrameStore>(current_.path);
    current_.series.clear();
    live_.reset();
    progress_.reset();
  }
  Q_EMIT stateChanged();
}

void Session::stopAndWait() {
  running_ = false;
  simulation_.reset();
  retired_.clear();
}

void Session::retire() {
  running_ = false;
  if (!simulation_) return;
  simulation_->disconnect(this);
  simulation_->stop();
  connect(simulation_.get(), &Simulation::finished, this,
          [this] { std::erase_if(retired_, [this](const auto& s) { return s.get() == sender(); }); });
  if (!simulation_->isFinished()) retired_.push_back(std::move(simulation_));
  simulation_.reset();
}

void Session::fetch() {
  if (!simulation_) return;
  const auto samples = simulation_->takeSamples();
  for (const auto& [level, text] : simulation_->takeMessages())
    Q_EMIT logged(static_cast<int>(level), QString::fromStdString(text));
  const auto frame = simulation_->takeFrame();
  if (frame && std::exchange(resuming_, false)) current_.series.restartFrom((*frame)->time);
  for (const auto& sample : samples)
    current_.series.add(sample);
  if (!samples.empty()) Q_EMIT samplesArrived();
  const auto changes = simulation_->takeChanges();
  auto& events = current_.scene->events;
  for (const auto& event : changes) // as Run does
    events.insert(std::upper_bound(events.begin(), events.end(), event.step,
                                   [](std::int64_t step, const EventSpec& e) { return step < e.step; }),
                  event);
  if (!changes.empty()) {
    current_.resolved = QString::fromStdString(writeScene(*current_.scene));
    Q_EMIT sceneChanged();
  }
  if (const auto progress = simulation_->takeProgress()) {
    progress_ = *progress;
    Q_EMIT progressArrived();
  }
  if (frame) {
    live_ = *frame;
    Q_EMIT frameArrived();
  }
  if (knownPaused_ != isPaused()) { // by itself, at the step of a branch
    knownPaused_ = isPaused();
    Q_EMIT stateChanged();
  }
}

void Session::ended(bool complete, const QString& fault) {
  if (sender() != simulation_.get()) return;
  fetch();
  running_ = false;
  current_.canResume = hasCheckpoint(current_.runFolder);
  const auto store = current_.store;
  pool_.start([store] {
    try {
      store->refresh();
    } catch (const Error&) {
      // Opening the run again tells what is wrong with its files.
    }
  });
  Q_EMIT runEnded(complete, fault);
  Q_EMIT stateChanged();
}

} // namespace sandglass::desktop
