#pragma once
// What is open (a scene, a run, a file of frames) and the simulation of it, if one goes on. Lives in the
// window's thread; files are opened in another.

#include "app/desktop/opening.h"
#include "app/desktop/simulation.h"

#include <QObject>
#include <QString>
#include <QThreadPool>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sandglass::desktop {

struct SessionOptions {
  std::filesystem::path runsFolder = "out"; ///< new runs go below it, named after their scene
  std::filesystem::path folder;             ///< folder of the next new run; empty: a new one in runsFolder
  int threads = 0;                          ///< of the simulation; 0: all cores
  std::optional<ImportSettings> import;     ///< for files of other programs; absent: what lies beside them
};

class Session : public QObject {
  Q_OBJECT
public:
  explicit Session(SessionOptions options);
  ~Session() override;

  void open(const QString& path); ///< opened() or openFailed() follows
  const Opened& current() const { return current_; }
  QString asked() const { return asked_; } ///< the path that open() had last
  /// Files of other programs are read with what lies beside them from now on.
  void forgetImport() { options_.import.reset(); }
  bool isOpening() const { return opened_ != opening_; }
  bool isOpen() const { return !current_.path.empty(); }

  bool runs() const { return running_; }
  bool isPaused() const { return runs() && simulation_->isPaused(); }
  bool canStart() const { return current_.scene && !runs(); }
  void start(bool paused = false); ///< goes on where a run has a checkpoint
  void pause(bool on);
  void step(int steps); ///< starts paused when nothing runs
  void stop();
  void limitSpeed(double ratio); ///< simulated over wall time; 0: as fast as can be
  double speedLimit() const { return speedLimit_; }
  /// Changes the running simulation before its next step; the event is added to the scene. A sentence when it
  /// cannot be, else nothing.
  QString change(const EventSpec& event);
  /// Another scene in place of the one that is open: Run starts a new run. Not while one goes on.
  void setScene(Scene scene, const QString& text, const QString& resolved);
  /// The run behind a row of a sweep, started where its frames were not kept.
  void openSweepRun(const std::filesystem::path& sweep, int run);
  void setSweep(std::shared_ptr<const SweepData> sweep) { current_.sweep = std::move(sweep); } ///< read anew
  /// A new run that shares the past of the one in `source` up to `step`, opened here and paused there.
  void openBranch(const std::filesystem::path& source, std::int64_t step);
  void stopAndWait();                          ///< the checkpoint is written afterwards
  FramePtr liveFrame() const { return live_; } ///< newest of the simulation; null when none runs
  const std::optional<Progress>& progress() const { return progress_; }

Q_SIGNALS:
  void opened();
  void openFailed(const QStringList& sentences);
  void stateChanged(); ///< started, paused, stopped
  void frameArrived(); ///< liveFrame() is a new one
  void progressArrived();
  void samplesArrived();
  void sceneChanged(); ///< by a change of the running simulation
  void logged(int level, const QString& text);
  void runEnded(bool complete, const QString& fault);

private:
  void openBy(const std::function<Opened()>& read);
  void lookOn(quint64 order); ///< through a long foreign file, piece by piece
  void fetch();
  void ended(bool complete, const QString& fault);
  void retire();

  SessionOptions options_;
  QString asked_;
  Opened current_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::unique_ptr<Simulation>> retired_; ///< stopping; nobody listens any more
  FramePtr live_;
  std::optional<Progress> progress_;
  quint64 opening_ = 0, opened_ = 0; ///< the newest order wins
  bool resuming_ = false, running_ = false, knownPaused_ = false;
  double speedLimit_ = 0;
  std::int64_t pauseAt_ = -1; ///< of the next start
  QThreadPool pool_;
};

} // namespace sandglass::desktop
