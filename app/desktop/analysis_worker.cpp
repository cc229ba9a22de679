#include "app/desktop/analysis_worker.h"

#include "app/desktop/background.h"
#include "sim/base/error.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace sandglass::desktop {

namespace {

constexpr int nice = 5; // the rest below bounds its share; a higher one would starve it beside a busy run
constexpr double shortestInterval = 2; ///< [s] between results beside a simulation
constexpr double restShare = 20;       ///< rests this many times as long as it computed

} // namespace

AnalysisWorker::AnalysisWorker() : thread_([this] { work(); }) {}

AnalysisWorker::~AnalysisWorker() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void AnalysisWorker::compute(const PanelAnalysis& analysis, AnalysisInput input, bool restart, bool beside) {
  const std::lock_guard lock(mutex_);
  const QString id = QString::fromStdString(analysis.id);
  if (restart) ++epochs_[id];
  if (orders_.contains(id)) ++done_;
  orders_[id] = {&analysis, std::move(input), epochs_[id], ++asked_, beside};
  changed_.notify_all();
}

void AnalysisWorker::forget() {
  const std::lock_guard lock(mutex_);
  for (auto& [id, epoch] : epochs_)
    ++epoch;
  done_ += orders_.size();
  orders_.clear();
  results_.clear();
}

void AnalysisWorker::setSimulationRuns(bool runs) {
  const std::lock_guard lock(mutex_);
  simulationRuns_ = runs;
  changed_.notify_all();
}

bool AnalysisWorker::isIdle() const {
  const std::lock_guard lock(mutex_);
  return done_ == asked_ && results_.empty();
}

std::map<QString, AnalysisWorker::Outcome> AnalysisWorker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(results_, {});
}

std::optional<AnalysisWorker::Order> AnalysisWorker::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return quit_ || !orders_.empty(); });
  if (quit_) return std::nullopt;
  const auto oldest = std::min_element(orders_.begin(), orders_.end(), [](const auto& a, const auto& b) {
    return a.second.number < b.second.number;
  });
  return std::move(orders_.extract(oldest).mapped());
}

bool AnalysisWorker::simulationPauses() const {
  return std::any_of(orders_.begin(), orders_.end(), [](const auto& o) { return !o.second.beside; });
}

void AnalysisWorker::work() {
  lowerPriority(nice);
  tbb::task_arena arena(1);
  while (const auto order = next()) {
    const double before = threadSeconds();
    Outcome outcome = arena.execute([&] { return outcomeOf(*order); });
    const double seconds = threadSeconds() - before;
    std::unique_lock lock(mutex_);
    const QString id = QString::fromStdString(order->analysis->id);
    if (order->epoch == epochs_[id]) {
      const bool first = results_.empty();
      results_[id] = std::move(outcome);
      if (first) Q_EMIT ready();
    }
    ++done_;
    if (!order->beside) continue;
    const std::chrono::duration<double> rest(std::max(shortestInterval, restShare * seconds));
    changed_.wait_for(lock, rest, [&] { return quit_ || !simulationRuns_ || simulationPauses(); });
  }
}

AnalysisWorker::Outcome AnalysisWorker::outcomeOf(const Order& order) {
  try {
    analysis::Results results = order.analysis->compute(order.input);
    for (auto& curve : results.curves) {
      if (curve.series.size() == 1) curve.series[0].name.clear();
      // Beside a simulation the picture is ahead of its curves.
      curve.definition = fmt::format("t = {:.4g} s. {}", order.input.frame->time, curve.definition);
      curve.provenance.insert(order.input.frame->provenance.begin(), order.input.frame->provenance.end());
    }
    return {std::move(results), {}};
  } catch (const Error& e) {
    return {std::nullopt, QString::fromUtf8(e.what())};
  }
}

} // namespace sandglass::desktop
