#include "tests/validate/hopper/runs.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"
#include "sim/run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <iostream>
#include <mutex>
#include <thread>

namespace sandglass::validate {

namespace {

constexpr double quickSize = 2;   ///< of the grains, in a quick look
constexpr double quickStep = 1.5; ///< of the time step

/// Highest centre within a quarter of the outlet of its middle, grains in flight left out (those that have no
/// other within one and a half diameters below them).
double surfaceAbove(const Frame& frame, double reach, double diameter) {
  std::vector<double> heights;
  for (const Vec3& x : frame.position)
    if (std::abs(x.x()) < reach && x.y() > 0) heights.push_back(x.y());
  std::sort(heights.begin(), heights.end());
  double top = 0;
  for (const double h : heights) {
    if (h - top > 1.5 * diameter) break;
    top = h;
  }
  return top;
}

} // namespace

Mean meanOf(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  if (values.size() < 2) return {analysis::mean(values), 0};
  return {analysis::mean(values),
          analysis::studentFactor(0.95, n - 1) * std::sqrt(analysis::variance(values) / n)};
}

HopperRun HopperRuns::run(const HopperBed& asked, std::uint64_t seed) const {
  const HopperBed bed = quick_ ? asked.coarser(quickSize) : asked;
  HopperRun result;
  result.seed = seed;
  RunOptions options;
  options.threads = 1;
  Run run(bed.scene(seed, quick_ ? quickStep : 1), options);
  std::vector<std::pair<double, double>> above; // time, mass in the box above the outlet
  run.onSample = [&](const ProbeSample& s) {
    if (s.probe == "outflow") {
      result.discharged.time.push_back(s.time);
      result.discharged.mass.push_back(s.values.at("mass"));
    } else if (s.probe == "above_outlet") {
      above.emplace_back(s.time, s.values.at("mass"));
    }
  };
  run.onSavedFrame = [&](FramePtr f) {
    if (f->stage != "discharge") {
      result.opened = f->time;
      double top = 0;
      for (const Vec3& x : f->position)
        top = std::max(top, x.y());
      result.fillHeight = top;
    } else {
      result.heightTime.push_back(f->time);
      result.heightAboveOutlet.push_back(surfaceAbove(*f, 0.25 * bed.outlet, bed.diameter));
    }
    result.last = f;
  };
  run.execute();
  const Flow& flow = run.summary().flow;
  result.massEntered = flow.massEntered;
  double present = 0;
  for (const double m : result.last->scalar(quantity::mass))
    present += m;
  result.imbalance = (flow.massEntered - flow.massDischarged - present) / flow.massEntered;

  analysis::DischargeOptions fit;
  fit.shares = {0.1, 0.5};
  fit.totalMass = result.massEntered;
  analysis::DischargeFit slope;
  try {
    slope = analysis::fitDischarge(result.discharged, fit);
  } catch (const InputError&) {
    if (!quick_) throw;
    slope.rate = 1e-6; // the large grains of a quick look arch over a narrow outlet
  }
  result.rate = slope.rate / bed.depth;
  result.halfWidth = slope.halfWidth / bed.depth;
  double sum = 0;
  int samples = 0;
  for (const auto& [time, mass] : above)
    if (time >= slope.startTime && time <= slope.endTime) {
      sum += mass;
      ++samples;
    }
  result.flowingDensity = sum / std::max(samples, 1) / (bed.outlet * 0.75 * bed.outlet * bed.depth);
  return result;
}

void HopperRuns::execute() {
  struct Task {
    const std::string* key;
    const HopperBed* bed;
    std::size_t place;
    double cost;
  };
  std::vector<Task> tasks;
  for (const auto& [key, bed] : asked_) {
    runs_[key].resize(seeds_.size());
    const double duration =
        (bed.emptied ? 1 : 0.55) * bed.totalMass() / std::pow(bed.outlet, 1.5) / bed.depth;
    for (std::size_t k = 0; k < seeds_.size(); ++k)
      tasks.push_back(
          {&key, &bed, k, bed.totalMass() / std::pow(bed.diameter, 3) * duration / bed.timeStep()});
  }
  // The longest first, so that the last ones end together.
  std::stable_sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) { return a.cost > b.cost; });
  std::atomic<std::size_t> next{0}, done{0};
  std::exception_ptr failure;
  std::mutex guard;
  std::vector<std::jthread> workers;
  for (unsigned w = 0; w < std::max(1u, std::thread::hardware_concurrency()); ++w)
    workers.emplace_back([&] {
      for (std::size_t k; (k = next++) < tasks.size();)
        try {
          HopperRun result = run(*tasks[k].bed, seeds_[tasks[k].place]);
          const std::lock_guard lock(guard);
          std::cerr << fmt::format("{}/{}: {}, seed {}: {:.1f} +- {:.1f} g/(cm s)\n", ++done, tasks.size(),
                                   *tasks[k].key, result.seed, 10 * result.rate, 10 * result.halfWidth);
          runs_[*tasks[k].key][tasks[k].place] = std::move(result);
        } catch (...) {
          const std::lock_guard lock(guard);
          std::cerr << *tasks[k].key << " failed\n";
          failure = std::current_exception();
          next = tasks.size();
        }
    });
  workers.clear();
  if (failure) std::rethrow_exception(failure);
}

Mean HopperRuns::rate(const HopperBed& bed) const {
  std::vector<double> rates;
  for (const HopperRun& r : of(bed))
    rates.push_back(10 * r.rate); // kg/(m s) to g/(cm s)
  return meanOf(rates);
}

Mean HopperRuns::ratio(const HopperBed& above, const HopperBed& below) const {
  // The seeds of two beds have nothing in common: errors of the means add in squares.
  const Mean a = rate(above), b = rate(below);
  const double q = a.value / b.value;
  return {q, q * std::hypot(a.halfWidth / a.value, b.halfWidth / b.value)};
}

std::string HopperRuns::csv() const {
  std::string text =
      "bed,seed,rate_g_per_cm_s,half_width_95,mass_g,opened_s,fill_height_cm,flowing_density_g_per_"
      "cm3,mass_imbalance\n";
  for (const auto& [key, runs] : runs_)
    for (const HopperRun& r : runs)
      text += fmt::format("\"{}\",{},{:.3f},{:.3f},{:.4f},{:.4f},{:.3f},{:.4f},{:.2g}\n", key, r.seed,
                          10 * r.rate, 10 * r.halfWidth, 1e3 * r.massEntered, r.opened, 100 * r.fillHeight,
                          1e-3 * r.flowingDensity, r.imbalance);
  return text;
}

} // namespace sandglass::validate
