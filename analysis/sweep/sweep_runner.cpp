#include "analysis/sweep/sweep_runner.h"

#include "analysis/sweep/sweep_design.h"
#include "analysis/sweep/sweep_run.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

namespace sandglass::analysis {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t sentencesTold = 10; ///< of failed runs; all are in the table

struct Job {
  int run = 0;
  std::uint64_t seed = 0;
  SweepPoint point;
  std::atomic<double> fraction{0}; ///< -1: not begun
  bool over = false;
};

/// What a point's runs agree on: the commonest text (the first of the alphabet among equals), or the mean.
SweepValue consensus(const std::vector<const SweepRow*>& runs, std::size_t column) {
  std::map<std::string, int> texts;
  double sum = 0;
  int numbers = 0;
  for (const auto* run : runs) {
    if (run->status == SweepStatus::failed)
      ++texts["failed"];
    else if (const auto* text = std::get_if<std::string>(&run->values[column]))
      ++texts[*text];
    else if (const auto* x = std::get_if<double>(&run->values[column]))
      sum += *x, ++numbers;
  }
  if (numbers > 0) return sum / numbers;
  SweepValue best;
  int most = 0;
  for (const auto& [text, count] : texts)
    if (count > most) best = text, most = count;
  return best;
}

/// The runs of a table that wait, worked off by some threads; the thread that calls tells of progress.
class Crew {
public:
  Crew(SweepTable& table, const SweepRunnerOptions& options, std::atomic<bool>& stop)
      : table_(table), plan_(table.plan()), options_(options), stop_(stop) {
    std::map<int, SweepPoint> points;
    for (auto& point : table.points())
      points[point.id] = std::move(point);
    for (const auto& row : table.rows()) {
      if ((row.run - 1) % options.shares != options.share) continue;
      ++progress_.runs;
      progress_.done += row.status == SweepStatus::done;
      progress_.failed += row.status == SweepStatus::failed;
      if (row.status != SweepStatus::waiting) continue;
      auto job = std::make_unique<Job>();
      job->run = row.run;
      job->seed = row.seed;
      job->point = points.at(row.point);
      jobs_.push_back(std::move(job));
    }
  }

  /// Until all are over or given up. Rethrows what a worker met.
  void work() {
    if (jobs_.empty()) return;
    const auto cores = std::max(1u, std::thread::hardware_concurrency());
    const int workers = static_cast<int>(std::min<std::size_t>(
        jobs_.size(), options_.threads > 0 ? static_cast<unsigned>(options_.threads) : cores));
    std::vector<std::thread> pool;
    for (int k = 0; k < workers; ++k)
      pool.emplace_back([this] { workOn(); });
    {
      std::unique_lock lock(mutex_);
      const auto idle = [&] { return idle_ == workers; };
      while (!changed_.wait_for(lock, std::chrono::milliseconds(100), idle))
        tell(lock);
      tell(lock);
    }
    for (auto& thread : pool)
      thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

private:
  void workOn() {
    while (Job* job = next()) {
      const auto outcome =
          runPoint(plan_, job->point, job->seed, stop_, [job](double f) { job->fraction = f; });
      const std::lock_guard lock(mutex_);
      --progress_.going;
      if (!outcome) continue;
      try {
        record(*job, *outcome);
      } catch (...) {
        failure_ = std::current_exception();
        stop_ = true;
      }
    }
    const std::lock_guard lock(mutex_);
    ++idle_;
    changed_.notify_all();
  }

  Job* next() {
    const std::lock_guard lock(mutex_);
    if (stop_ || taken_ == jobs_.size()) return nullptr;
    ++progress_.going;
    return jobs_[taken_++].get();
  }

  void record(Job& job, const SweepOutcome& outcome) {
    table_.record(job.run, outcome);
    job.over = true;
    if (outcome.status != SweepStatus::failed) {
      ++progress_.done;
      if (plan_.refineLevels > 0) table_.column(plan_.refineBy); // refuses now, not after the last run
      return;
    }
    ++progress_.failed;
    if (progress_.failed <= sentencesTold)
      report(options_.log, LogLevel::warning,
             fmt::format("run {} (point {}, seed {}) failed: {}", job.run, job.point.id, job.seed,
                         outcome.fault));
  }

  /// Lets go of the lock while the listener is at it.
  void tell(std::unique_lock<std::mutex>& lock) {
    double share = 0;
    for (const auto& job : jobs_)
      share += job->over ? 1.0 : job->fraction.load();
    const auto before = static_cast<double>(progress_.runs - jobs_.size());
    progress_.fraction = (before + share) / static_cast<double>(progress_.runs);
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    progress_.secondsLeft = share > 0.05 ? seconds * (static_cast<double>(jobs_.size()) - share) / share : -1;
    const SweepProgress now = progress_;
    lock.unlock();
    if (options_.onProgress) options_.onProgress(now);
    lock.lock();
  }

  SweepTable& table_;
  const SweepPlan& plan_;
  const SweepRunnerOptions& options_;
  std::atomic<bool>& stop_;
  const Clock::time_point start_ = Clock::now();
  std::vector<std::unique_ptr<Job>> jobs_;
  std::mutex mutex_; // of the table, of what follows
  std::condition_variable changed_;
  SweepProgress progress_;
  std::size_t taken_ = 0;
  int idle_ = 0;
  std::exception_ptr failure_;
};

} // namespace

SweepRunner::SweepRunner(SweepTable& table, SweepRunnerOptions options)
    : table_(table), options_(std::move(options)) {}

bool SweepRunner::execute() {
  do {
    if (!work()) return false;
  } while (options_.shares == 1 && refine(table_));
  return true;
}

bool SweepRunner::refine(SweepTable& table) {
  const SweepPlan& plan = table.plan();
  const auto rows = table.rows();
  int level = 0;
  std::map<int, std::vector<const SweepRow*>> byPoint;
  for (const auto& row : rows) {
    if (row.status == SweepStatus::waiting) return false;
    byPoint[row.point].push_back(&row);
    level = std::max(level, row.level);
  }
  if (const std::string known = table.info("refined"); !known.empty())
    level = std::max(level, std::stoi(known));
  if (level >= plan.refineLevels) return false;
  const std::size_t column = table.column(plan.refineBy);
  std::map<int, SweepValue> found;
  for (const auto& [point, runs] : byPoint)
    found[point] = consensus(runs, column);
  const auto points = table.points();
  const auto added = refinedPoints(plan, points, level + 1, [&](const SweepPoint& a, const SweepPoint& b) {
    const SweepValue &x = found[a.id], &y = found[b.id];
    if (const auto* p = std::get_if<double>(&x), *q = std::get_if<double>(&y); p && q)
      return std::abs(*p - *q) > plan.refineDifference;
    return x != y;
  });
  table.note("refined", std::to_string(level + 1));
  if (added.empty()) return refine(table); // neighbours that agree here may have finer ones that do not
  table.add(added);
  return true;
}

bool SweepRunner::work() {
  Crew(table_, options_, stop_).work();
  return !stop_;
}

} // namespace sandglass::analysis
