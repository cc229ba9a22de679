#include "app/cli/replicate_runs.h"

#include "analysis/replicates.h"
#include "analysis/run_facts.h"
#include "analysis/series_data.h"
#include "app/cli/console.h"
#include "app/cli/result_files.h"
#include "app/cli/stop_signals.h"
#include "sim/base/error.h"
#include "sim/base/version.h"
#include "sim/io/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>

namespace sandglass::cli {

namespace {

namespace fs = std::filesystem;

enum class JobState { waiting, running, finished, stopped, failed };

struct Job {
  Scene scene;
  fs::path folder;
  std::unique_ptr<Run> run; ///< while it is running
  JobState state = JobState::waiting;
  bool before = false; ///< was finished when it was looked at
  RunSummary summary;
  std::string fault;
  bool wrongInput = false;
  std::atomic<double> fraction{0};
};

/// Takes jobs one by one; a pool of these makes several go on at once.
class Pool {
public:
  Pool(std::vector<std::unique_ptr<Job>>& jobs, int threadsEach, bool overwrite, Log log)
      : jobs_(jobs), threadsEach_(threadsEach), overwrite_(overwrite), log_(std::move(log)) {}

  void work(int workers) {
    std::vector<std::thread> pool;
    for (int k = 0; k < workers; ++k)
      pool.emplace_back([this] {
        while (Job* job = next())
          runOne(*job);
        const std::lock_guard lock(mutex_);
        ++idle_;
        changed_.notify_all();
      });
    watch(workers);
    for (auto& thread : pool)
      thread.join();
  }

private:
  Job* next() {
    const std::lock_guard lock(mutex_);
    if (stopping_ || taken_ == jobs_.size()) return nullptr;
    Job* job = jobs_[taken_++].get();
    job->state = JobState::running;
    return job;
  }

  void runOne(Job& job) {
    RunOptions options;
    options.folder = job.folder;
    options.threads = threadsEach_;
    options.resume = !overwrite_;
    options.overwrite = overwrite_;
    const std::string name = job.folder.filename().string();
    auto run =
        std::make_unique<Run>(job.scene, options, [this, name](LogLevel level, const std::string& text) {
          if (level == LogLevel::info) return; // to each run's log.txt
          const std::lock_guard lock(mutex_);
          report(log_, level, fmt::format("{}: {}", name, text));
        });
    run->onProgress = [&job](const Progress& p) { job.fraction = p.fraction; };
    {
      const std::lock_guard lock(mutex_);
      job.run = std::move(run);
      if (stopping_) job.run->stop();
    }
    RunOutcome outcome = RunOutcome::stopped;
    std::string fault;
    bool wrongInput = false;
    try {
      outcome = job.run->execute();
    } catch (const InputError& error) {
      wrongInput = true;
      fault = error.what();
    } catch (const std::exception& error) {
      fault = error.what();
    }
    std::unique_ptr<Run> over;
    {
      const std::lock_guard lock(mutex_);
      job.summary = job.run->summary();
      job.before = job.summary.grainSteps == 0;
      job.fault = fault;
      job.wrongInput = wrongInput;
      job.state = !fault.empty()                    ? JobState::failed
                  : outcome == RunOutcome::finished ? JobState::finished
                                                    : JobState::stopped;
      over = std::move(job.run); // its memory is given back outside the lock
    }
  }

  /// Until all workers are idle: progress, and stopping when a signal asks.
  void watch(int workers) {
    using Clock = std::chrono::steady_clock;
    ProgressBar bar(fmt::format("{} runs", jobs_.size()));
    const auto start = Clock::now();
    double first = -1;
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, std::chrono::milliseconds(100), [&] { return idle_ == workers; })) {
      if (StopSignals::asked() && !stopping_) {
        stopping_ = true;
        for (auto& job : jobs_)
          if (job->run) job->run->stop();
      }
      double sum = 0;
      std::size_t done = 0, going = 0;
      for (const auto& job : jobs_) {
        const bool over = job->state > JobState::running;
        sum += over ? 1.0 : job->fraction.load();
        done += over ? 1 : 0;
        going += job->state == JobState::running ? 1 : 0;
      }
      const double share = sum / static_cast<double>(jobs_.size());
      if (first < 0) first = share; // what was there before took none of this time
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      bar.update(share, share - first > 1e-3 ? seconds * (1 - share) / (share - first) : -1,
                 fmt::format("{} done, {} going on", done, going));
    }
    bar.finish();
  }

  std::vector<std::unique_ptr<Job>>& jobs_;
  int threadsEach_;
  bool overwrite_;
  Log log_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t taken_ = 0;
  int idle_ = 0;
  bool stopping_ = false;
};

std::vector<std::unique_ptr<Job>> makeJobs(const Scene& scene, const ReplicateOptions& options) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const auto more = static_cast<std::uint64_t>(options.count - 1);
  if (scene.seed > most - more)
    throw InputError(
        fmt::format("{}: seed is {}, but {} replicates count on from it beyond {}; choose a smaller seed",
                    scene.file, scene.seed, options.count, most));
  std::vector<std::unique_ptr<Job>> jobs;
  for (std::uint64_t k = 0; k <= more; ++k) {
    auto job = std::make_unique<Job>();
    job->scene = scene;
    job->scene.seed = scene.seed + k;
    job->folder = options.folder / fmt::format("seed_{}", job->scene.seed);
    jobs.push_back(std::move(job));
  }
  return jobs;
}

/// Start of the stage in which the first mass was discharged; of the last one when none was.
double openingOf(const RunSummary& summary, const analysis::DischargeData& data) {
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < data.mass.size() && std::isinf(first); ++i)
    if (data.mass[i] > 0) first = data.time[i];
  double opened = 0;
  for (const double start : summary.stageStarts)
    if (start < first) opened = start;
  return opened;
}

/// What a finished run leaves: the last value of each probe, the fitted rate of each flow_rate probe, totals.
analysis::Replicate resultsOf(const Job& job, analysis::Units& units) {
  analysis::Replicate result;
  result.seed = job.scene.seed;
  const RunSummary& s = job.summary;
  const auto set = [&](const std::string& name, double value, const std::string& unit) {
    result.quantities[name] = value;
    units[name] = unit;
  };
  set("end_time", s.time, "s");
  set("grains_at_end", static_cast<double>(s.grains), "");
  set("grains_discharged", static_cast<double>(s.flow.grainsDischarged), "");
  set("mass_discharged", s.flow.massDischarged, "kg");
  const auto columns = readSeries(job.folder / "series.csv");
  const std::string flowProbe = analysis::factsOf(job.scene).flowProbe;
  for (const auto& probe : job.scene.probes) {
    const std::string& kind = probe.what.kind;
    for (const auto& [name, column] : columns) {
      if (!name.starts_with(probe.name + ".") || column.value.empty()) continue;
      const std::string value = name.substr(probe.name.size() + 1);
      if (kind == "flow_rate" && value == "rate") continue; // of the last interval alone: the fit says more
      set(name, column.value.back(),
          value == "mass"                ? "kg"
          : kind == "energies"           ? "J"
          : value.starts_with("force.")  ? "N"
          : value.starts_with("torque.") ? "N m"
          : value == "power"             ? "W"
          : value.ends_with("work")      ? "J"
                                         : "");
    }
    if (kind != "flow_rate") continue;
    auto data = analysis::dischargeOf(columns, probe.name, (job.folder / "series.csv").string());
    try {
      set(probe.name + ".discharge_rate", analysis::fitDischarge(data).rate, "kg/s");
    } catch (const InputError&) { // too little left for a rate; the number of runs in the summary shows it
    }
    if (probe.name != flowProbe) continue;
    result.opened = openingOf(s, data);
    const auto from = std::lower_bound(data.time.begin(), data.time.end(), result.opened) - data.time.begin();
    result.discharge.time.assign(data.time.begin() + from, data.time.end());
    result.discharge.mass.assign(data.mass.begin() + from, data.mass.end());
    for (double& t : result.discharge.time)
      t -= result.opened;
  }
  return result;
}

bool sameNumbers(const std::map<std::string, double>& a, const std::map<std::string, double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    const bool both = std::isnan(one.second) && std::isnan(other.second);
    return one.first == other.first && (both || one.second == other.second);
  });
}

void printTable(const analysis::Table& summary) {
  std::size_t width = 8;
  for (const auto& name : summary.rowNames)
    width = std::max(width, name.size());
  fmt::print("{:<{}}  {:>12}  {:>12}  {:>12}  {:>4}\n", "quantity", width, "mean", "std. dev.", "+- 95 %",
             "runs");
  const auto number = [](double v) { return std::isnan(v) ? std::string("-") : fmt::format("{:.6g}", v); };
  for (std::size_t r = 0; r < summary.rows.size(); ++r) {
    const auto& row = summary.rows[r];
    fmt::print("{:<{}}  {:>12}  {:>12}  {:>12}  {:>4}\n", summary.rowNames[r], width, number(row[0]),
               number(row[1]), number(row[2]), row[3]);
  }
}

void writeResults(const std::vector<std::unique_ptr<Job>>& jobs, const fs::path& folder) {
  std::vector<analysis::Replicate> results;
  analysis::Units units;
  std::map<std::string, std::string> provenance{{"version", programVersion()}};
  std::string seeds;
  for (const auto& job : jobs) {
    if (job->state != JobState::finished) continue;
    results.push_back(resultsOf(*job, units));
    seeds += fmt::format("{}{}", seeds.empty() ? "" : " ", job->scene.seed);
    provenance.try_emplace("scene_of_first", sceneHash(job->scene));
  }
  if (results.empty()) return;
  provenance["seeds"] = seeds;
  ResultFiles files(folder, false);
  auto each = analysis::replicateTable(results, units);
  auto summary = analysis::replicateSummary(results, units);
  each.provenance = summary.provenance = provenance;
  files.write(each);
  files.write(summary);
  printTable(summary);
  if (results.size() > 1 && std::all_of(results.begin(), results.end(), [&](const auto& result) {
        return sameNumbers(result.quantities, results.front().quantities);
      }))
    report(consoleLog(), LogLevel::warning,
           fmt::format(
               "all {} runs ended with equal numbers, so the intervals of 0 say nothing of chance: nothing "
               "in the scene is random, or no probe shows it",
               results.size()));
  if (std::none_of(results.begin(), results.end(), [](const auto& r) { return r.discharge.time.size() > 1; }))
    return;
  auto curve = analysis::meanDischarge(results);
  curve.provenance = provenance;
  files.write(curve);
}

} // namespace

int runReplicates(const Scene& scene, const ReplicateOptions& options) {
  auto jobs = makeJobs(scene, options);
  const int cores = options.threads > 0 ? options.threads
                                        : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int workers = std::min(cores, options.count);
  fmt::print("{} runs, {} at once with {} thread{} each, into {}\n", options.count, workers, cores / workers,
             cores / workers == 1 ? "" : "s", options.folder.string());
  std::fflush(stdout);
  const StopSignals signals;
  Pool(jobs, cores / workers, options.overwrite, consoleLog()).work(workers);

  std::vector<std::string> wrong;
  std::size_t finished = 0, before = 0, failed = 0;
  for (const auto& job : jobs) {
    if (job->state == JobState::failed) {
      ++failed;
      if (job->wrongInput)
        wrong.push_back(fmt::format("{}: {}", job->folder.filename().string(), job->fault));
      else
        fmt::print(stderr, "sandglass: {}: {}\n", job->folder.filename().string(), job->fault);
    }
    finished += job->state == JobState::finished ? 1 : 0;
    before += job->state == JobState::finished && job->before ? 1 : 0;
  }
  if (finished > 0) writeResults(jobs, options.folder);
  fmt::print("{} of {} runs are finished{}; results in {}\n", finished, jobs.size(),
             before > 0 ? fmt::format(" ({} were before)", before) : "", options.folder.string());
  if (!wrong.empty()) throw InputError(wrong);
  if (finished == jobs.size()) return 0;
  if (failed == 0) fmt::print("stopped; the same command goes on\n");
  return 1;
}

} // namespace sandglass::cli
