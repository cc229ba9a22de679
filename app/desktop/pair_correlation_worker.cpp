#include "app/desktop/pair_correlation_worker.h"

#include "analysis/pair_correlation.h"
#include "app/desktop/background.h"
#include "sim/base/error.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

namespace sandglass::desktop {

namespace {

constexpr int nice = 5; // the rest below bounds its share; a higher one would starve it beside a busy run
constexpr double shortestInterval = 2; ///< [s] between results
constexpr double restShare = 20;       ///< rests this many times as long as it computed

} // namespace

PairCorrelationWorker::PairCorrelationWorker() : thread_([this] { work(); }) {}

PairCorrelationWorker::~PairCorrelationWorker() {
  in_.close();
  thread_.join();
}

void PairCorrelationWorker::compute(FramePtr frame, const Vec3& up, bool restart, bool beside) {
  if (restart) ++epoch_;
  in_.put({std::move(frame), up, epoch_, ++asked_, beside});
}

void PairCorrelationWorker::work() {
  lowerPriority(nice);
  tbb::task_arena arena(1);
  while (const auto order = in_.wait()) {
    const double before = threadSeconds();
    const Outcome outcome = arena.execute([&] { return outcomeOf(*order); });
    const double seconds = threadSeconds() - before;
    if (order->epoch == epoch_ && out_.put(outcome)) Q_EMIT ready();
    done_ = order->number;
    const std::chrono::duration<double> rest(
        std::max(shortestInterval, order->beside ? restShare * seconds : 0));
    if (!in_.rest(rest)) return;
  }
}

PairCorrelationWorker::Outcome PairCorrelationWorker::outcomeOf(const Order& order) const {
  analysis::PairCorrelationOptions options;
  options.bins = 120;
  options.pointsPerShell = 20000; // a panel needs no more than its line is wide
  if (order.up.norm() > 0) options.region.up = order.up.normalized();
  try {
    auto curve = analysis::pairCorrelation(*order.frame, options).g;
    curve.title.clear(); // the panel has its own
    for (auto& series : curve.series) {
      series.name.clear();
      for (std::size_t k = 0; k < series.error.size(); ++k) // where no pair was found there is nothing to see
        if (series.y[k] == 0) series.error[k] = 0;
    }
    return {std::move(curve), {}};
  } catch (const Error& e) {
    return {std::nullopt, QString::fromUtf8(e.what())};
  }
}

} // namespace sandglass::desktop
