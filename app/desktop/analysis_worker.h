#pragma once
// The analyses of the panels, in a thread of their own: one thread wide, at low priority, never begun for a
// frame that is outdated, and resting long enough to stay a small guest beside a running simulation.

#include "app/desktop/analyses.h"
#include "app/desktop/one_slot.h"

#include <QObject>
#include <QString>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace sandglass::desktop {

class AnalysisWorker : public QObject {
  Q_OBJECT
public:
  AnalysisWorker();
  ~AnalysisWorker() override;

  /// Replaces an order of the same analysis that waits; its result is dropped when one with `restart` set
  /// comes meanwhile. `beside`: a simulation runs, to which most of the processor belongs.
  void compute(const PanelAnalysis& analysis, AnalysisInput input, bool restart, bool beside);

  /// Drops all orders and results, that which is being worked on too: another run is shown.
  void forget();
  /// It rests after an order beside a simulation, and no longer once none goes on.
  void setSimulationRuns(bool runs);

  struct Outcome {
    std::optional<analysis::Results> results; ///< curves begin their definitions with the frame's time
    QString fault;                            ///< why there is none
  };
  bool isIdle() const;               ///< nothing waits, is being worked on, or has not been taken
  std::map<QString, Outcome> take(); ///< the newest results by id

Q_SIGNALS: // from the worker's thread
  void ready();

private:
  struct Order {
    const PanelAnalysis* analysis = nullptr;
    AnalysisInput input;
    std::uint64_t epoch = 0, number = 0;
    bool beside = false;
  };
  void work();
  std::optional<Order> next();
  bool simulationPauses() const; ///< by an order that waits; the mutex is held
  static Outcome outcomeOf(const Order& order);

  std::atomic<std::uint64_t> asked_{0}, done_{0}; ///< numbers of orders; replaced ones count as done
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<QString, Order> orders_;
  std::map<QString, std::uint64_t> epochs_;
  std::map<QString, Outcome> results_;
  bool simulationRuns_ = false, quit_ = false;
  std::thread thread_;
};

} // namespace sandglass::desktop
