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
  const SweepPlan& plan = table_.plan();
  std::map<int, SweepPoint> points;
  for (auto& point : table_.points())
    points[point.id] = std::move(point);
  std::vector<std::unique_ptr<Job>> jobs;
  SweepProgress progress;
  for (const auto& row : table_.rows()) {
    if ((row.run - 1) % options_.shares != options_.share) continue;
    ++progress.runs;
    progress.done += row.status == SweepStatus::done;
    progress.failed += row.status == SweepStatus::failed;
    if (row.status != SweepStatus::waiting) continue;
    auto job = std::make_unique<Job>();
    job->run = row.run;
    job->seed = row.seed;
    job->point = points.at(row.point);
    jobs.push_back(std::move(job));
  }
  if (jobs.empty()) return !stop_;
  const std::size_t before = progress.runs - jobs.size();

  std::mutex mutex; // of the table, of what follows
  std::condition_variable changed;
  std::size_t taken = 0;
  int idle = 0;
  std::exception_ptr failure;
  const auto worker = [&] {
    for (;;) {
      Job* job = nullptr;
      {
        const std::lock_guard lock(mutex);
        if (!stop_ && taken < jobs.size()) {
          job = jobs[taken++].get();
          ++progress.going;
        }
      }
      if (!job) break;
      const auto outcome =
          runPoint(plan, job->point, job->seed, stop_, [job](double f) { job->fraction = f; });
      const std::lock_guard lock(mutex);
      --progress.going;
      if (!outcome) continue;
      try {
        table_.record(job->run, *outcome);
        job->over = true;
        if (outcome->status == SweepStatus::failed) {
          ++progress.failed;
          if (progress.failed <= sentencesTold)
            report(options_.log, LogLevel::warning,
                   fmt::format("run {} (point {}, seed {}) failed: {}", job->run, job->point.id, job->seed,
                               outcome->fault));
        } else {
          ++progress.done;
          if (plan.refineLevels > 0) table_.column(plan.refineBy); // refuses now, not after the last run
        }
      } catch (...) {
        failure = std::current_exception();
        stop_ = true;
      }
    }
    const std::lock_guard lock(mutex);
    ++idle;
    changed.notify_all();
  };
  const auto cores = std::max(1u, std::thread::hardware_concurrency());
  const int workers = static_cast<int>(std::min<std::size_t>(
      jobs.size(), options_.threads > 0 ? static_cast<unsigned>(options_.threads) : cores));
  std::vector<std::thread> pool;
  for (int k = 0; k < workers; ++k)
    pool.emplace_back(worker);
  const auto start = Clock::now();
  {
    std::unique_lock lock(mutex);
    const auto tell = [&] {
      double share = 0;
      for (const auto& job : jobs)
        share += job->over ? 1.0 : job->fraction.load();
      progress.fraction = (static_cast<double>(before) + share) / static_cast<double>(progress.runs);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      progress.secondsLeft = share > 0.05 ? seconds * (static_cast<double>(jobs.size()) - share) / share : -1;
      const SweepProgress now = progress;
      lock.unlock();
      if (options_.onProgress) options_.onProgress(now);
      lock.lock();
    };
    while (!changed.wait_for(lock, std::chrono::milliseconds(100), [&] { return idle == workers; }))
      tell();
    tell();
  }
  for (auto& thread : pool)
    thread.join();
  if (failure) std::rethrow_exception(failure);
  return !stop_;
}

} // namespace sandglass::analysis
