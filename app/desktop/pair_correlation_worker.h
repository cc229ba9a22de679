#pragma once
// g(r) of the frame that is shown, in a thread of its own: one thread wide, at low priority, never begun for
// a frame that is outdated, and resting long enough to stay a small guest beside a running simulation.

#include "analysis/result.h"
#include "app/desktop/one_slot.h"
#include "sim/frame/frame.h"

#include <QObject>
#include <QString>

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

namespace sandglass::desktop {

class PairCorrelationWorker : public QObject {
  Q_OBJECT
public:
  PairCorrelationWorker();
  ~PairCorrelationWorker() override;

  /// Replaces a frame that waits; the result of one being worked on is dropped when `restart` is set.
  /// `up`: against gravity, where the free surface is looked for; zero when there is no gravity.
  /// `beside`: a simulation runs, to which most of the processor belongs.
  void compute(FramePtr frame, const Vec3& up, bool restart, bool beside);

  /// The newest result and why there is none.
  struct Outcome {
    std::optional<analysis::Curve> curve;
    QString fault;
  };
  bool isIdle() const { return done_ == asked_; } ///< nothing waits and nothing is being worked on
  std::optional<Outcome> take() { return out_.take(); }

Q_SIGNALS: // from the worker's thread
  void ready();

private:
  struct Order {
    FramePtr frame;
    Vec3 up;
    std::uint64_t epoch = 0, number = 0;
    bool beside = false;
  };
  void work();
  Outcome outcomeOf(const Order& order) const;

  std::atomic<std::uint64_t> epoch_{0};
  std::atomic<std::uint64_t> asked_{0}, done_{0}; ///< numbers of the newest orders
  OneSlot<Order> in_;
  OneSlot<Outcome> out_;
  std::thread thread_;
};

} // namespace sandglass::desktop
