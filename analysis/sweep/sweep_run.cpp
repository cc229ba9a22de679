#include "analysis/sweep/sweep_run.h"

#include "analysis/discharge.h"
#include "analysis/run_facts.h"
#include "analysis/series_data.h"
#include "analysis/state_map.h"
#include "analysis/sweep/vortex_columns.h"
#include "analysis/vortex/vortex_knobs.h"
#include "sim/base/error.h"
#include "sim/io/series.h"
#include "sim/run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <map>

namespace sandglass::analysis {

namespace {

constexpr std::size_t curvePoints = 250;
constexpr std::size_t mapFrames = 8; ///< of the last that the state map looks at

/// What probes saw, by column, in memory.
using Samples = std::map<std::string, SeriesColumn>;

std::string unitOfProbe(const std::string& kind, const std::string& value) {
  if (value == "mass") return "kg";
  if (value == "rate") return "kg/s";
  if (kind == "energies") return "J";
  if (value.starts_with("force.")) return "N";
  if (value.starts_with("torque.")) return "N m";
  if (value == "power") return "W";
  return value.ends_with("work") ? "J" : "";
}

class Collector {
public:
  Collector(const SweepPlan& plan, const Scene& scene) : plan_(plan), scene_(scene) {
    if (!tellsVortex(plan, scene)) return;
    const RunFacts facts = factsOf(scene);
    vortex_.emplace(tankOf(plan.thresholds, facts), grainThresholdsOf(plan.thresholds), facts.grainDensity);
  }

  void frame(const FramePtr& frame) {
    if (vortex_) vortex_->add(*frame);
    last_ = frame;
    if (!plan_.stateMap) return;
    recent_.push_back(frame);
    if (recent_.size() > mapFrames * mapStride) recent_.pop_front();
  }

  void sample(const ProbeSample& s) {
    for (const auto& [name, value] : s.values) {
      SeriesColumn& column = samples_[s.probe + "." + name];
      column.time.push_back(s.time);
      column.value.push_back(value);
    }
  }

  void finish(const RunSummary& summary, SweepOutcome& out) const {
    const auto set = [&](const char* name, const char* unit, const char* description, SweepValue value) {
      out.results.push_back({{name, unit, SweepRole::result, false, description}, std::move(value)});
    };
    set("end_time", "s", "simulated", summary.time);
    set("steps", "", "of the run", static_cast<double>(summary.steps));
    set("grains", "", "at the end", static_cast<double>(summary.grains));
    set("grains_discharged", "", "that left", static_cast<double>(summary.flow.grainsDischarged));
    set("mass_discharged", "kg", "that left", summary.flow.massDischarged);
    probes(out);
    if (vortex_) {
      for (auto& column : vortexColumns(*vortex_, *last_, rulesOf(plan_.thresholds)))
        out.results.push_back(std::move(column));
      for (auto& curve : vortexCurves(*vortex_, rulesOf(plan_.thresholds)))
        out.curves.push_back(thinned(std::move(curve), curvePoints));
    }
    if (plan_.stateMap) stateMap(out);
    out.last = last_;
  }

private:
  static constexpr std::size_t mapStride = 20;

  void probes(SweepOutcome& out) const {
    for (const auto& probe : scene_.probes)
      for (const auto& [name, column] : samples_) {
        if (!name.starts_with(probe.name + ".") || column.value.empty()) continue;
        const std::string value = name.substr(probe.name.size() + 1),
                          unit = unitOfProbe(probe.what.kind, value);
        out.results.push_back(
            {{name, unit, SweepRole::result, false, "last value of the probe"}, column.value.back()});
        Curve curve;
        curve.name = name;
        curve.title = name;
        curve.x = {"time", "s"};
        curve.y = {value, unit};
        curve.series = {{name, column.time, column.value, {}}};
        out.curves.push_back(thinned(std::move(curve), curvePoints));
        if (probe.what.kind != "flow_rate" || value != "mass") continue;
        SweepValue rate;
        try {
          DischargeData data;
          data.time = column.time;
          data.mass = column.value;
          rate = fitDischarge(data).rate;
        } catch (const InputError&) { // too little left for a rate
        }
        out.results.push_back({{probe.name + ".discharge_rate", "kg/s", SweepRole::result, false,
                                "slope of the discharged mass in its even range"},
                               rate});
      }
  }

  void stateMap(SweepOutcome& out) const {
    const RunFacts facts = factsOf(scene_);
    StateOptions options;
    double sum = 0;
    for (const double r : last_->scalar(quantity::radius))
      sum += 2 * r / static_cast<double>(last_->size());
    options.diameter = sum;
    options.density = facts.grainDensity;
    options.gravity = facts.gravity;
    options.up = facts.up;
    StateMap map(options);
    // Every mapStride-th of the last frames: grains must have time to rearrange in between.
    for (std::size_t k = (recent_.size() - 1) % mapStride; k < recent_.size(); k += mapStride)
      map.add(*recent_[k]);
    std::array<double, 3> mean{};
    for (const auto& at : map.shares())
      for (std::size_t s = 0; s < 3; ++s)
        mean[s] += at.share[s] / static_cast<double>(map.shares().size());
    const char* names[] = {"solid", "liquid", "gas"};
    for (std::size_t s = 0; s < 3; ++s)
      out.results.push_back({{names[s], "", SweepRole::result, false,
                              "share of the grains in the state map, mean of the last frames"},
                             mean[s]});
  }

  const SweepPlan& plan_;
  const Scene& scene_;
  std::optional<VortexMeasures> vortex_;
  FramePtr last_;
  std::deque<FramePtr> recent_;
  Samples samples_;
};

} // namespace

bool tellsVortex(const SweepPlan& plan, const Scene& scene) {
  if (plan.states != "auto") return plan.states == "vortex";
  return tankOf(scene) && std::any_of(scene.fields.begin(), scene.fields.end(), [](const FieldSpec& field) {
           return field.what.kind.ends_with("_vortex");
         });
}

Curve thinned(Curve curve, std::size_t most) {
  for (auto& s : curve.series) {
    if (s.x.size() <= most) continue;
    Series few{s.name, {}, {}, {}};
    for (std::size_t k = 0; k < most; ++k) {
      const std::size_t at = k * (s.x.size() - 1) / (most - 1);
      few.x.push_back(s.x[at]);
      few.y.push_back(s.y[at]);
    }
    s = std::move(few);
  }
  return curve;
}

std::optional<SweepOutcome> runPoint(const SweepPlan& plan, const SweepPoint& point, std::uint64_t seed,
                                     const std::atomic<bool>& stop,
                                     const std::function<void(double fraction)>& onProgress) {
  const auto start = std::chrono::steady_clock::now();
  SweepOutcome outcome;
  try {
    Scene scene = sceneOf(plan, point, seed);
    if (plan.sampleInterval > 0) scene.output.frameInterval = plan.sampleInterval;
    scene.output.quantities = {quantity::velocity, quantity::spin, quantity::mass};
    scene.output.contacts = false;
    Collector collector(plan, scene);
    RunOptions options;
    options.threads = 1;
    options.wallLoads = false;
    Run run(scene, options);
    run.onSavedFrame = [&](const FramePtr& frame) { collector.frame(frame); };
    run.onSample = [&](const ProbeSample& sample) { collector.sample(sample); };
    run.onProgress = [&](const Progress& p) {
      if (stop) run.stop();
      if (onProgress) onProgress(p.fraction);
    };
    if (run.execute() == RunOutcome::stopped) return std::nullopt;
    collector.finish(run.summary(), outcome);
  } catch (const std::exception& fault) {
    if (stop) return std::nullopt;
    outcome = SweepOutcome{};
    outcome.status = SweepStatus::failed;
    outcome.fault = fault.what();
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

} // namespace sandglass::analysis
