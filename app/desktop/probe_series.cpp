#include "app/desktop/probe_series.h"

#include "sim/io/series.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr std::size_t drawnPoints = 600; ///< as many as a panel has pixels; more would only cost time
constexpr std::size_t flowSpans = 80;

const ProbeSpec* firstOfKind(const Scene& scene, const std::string& kind) {
  const auto it = std::find_if(scene.probes.begin(), scene.probes.end(),
                               [&](const ProbeSpec& p) { return p.what.kind == kind; });
  return it == scene.probes.end() ? nullptr : &*it;
}

} // namespace

void ProbeSeries::add(const ProbeSample& sample) {
  for (const auto& [name, value] : sample.values) {
    Column& column = columns_[sample.probe + "." + name];
    column.time.push_back(sample.time);
    column.value.push_back(value);
  }
}

void ProbeSeries::restartFrom(double time) {
  for (auto& [name, column] : columns_) {
    const auto keep = static_cast<std::size_t>(
        std::upper_bound(column.time.begin(), column.time.end(), time) - column.time.begin());
    column.time.resize(keep);
    column.value.resize(keep);
  }
}

void ProbeSeries::load(const std::filesystem::path& runFolder) {
  const auto file = runFolder / "series.csv";
  if (!std::filesystem::exists(file)) return;
  columns_.clear();
  for (auto& [name, column] : readSeries(file))
    columns_[name] = {std::move(column.time), std::move(column.value)};
}

const ProbeSeries::Column* ProbeSeries::find(const std::string& probe, const std::string& value) const {
  const auto it = columns_.find(probe + "." + value);
  return it == columns_.end() || it->second.time.empty() ? nullptr : &it->second;
}

std::optional<analysis::Curve> ProbeSeries::energies(const Scene& scene) const {
  const ProbeSpec* probe = firstOfKind(scene, "energies");
  if (!probe) return std::nullopt;
  analysis::Curve curve;
  curve.name = "energies";
  curve.x = {"time", "s"};
  curve.y = {"energy", "J"};
  for (const char* kind : {"translational", "rotational", "elastic"}) {
    const Column* column = find(probe->name, kind);
    if (!column) continue;
    analysis::Series series{kind, {}, {}, {}};
    const std::size_t stride = 1 + column->time.size() / drawnPoints;
    const std::size_t last = column->time.size() - 1;
    for (std::size_t k = last % stride; k <= last; k += stride) { // the newest is always there
      series.x.push_back(column->time[k]);
      series.y.push_back(column->value[k]);
    }
    curve.series.push_back(std::move(series));
  }
  if (curve.series.empty()) return std::nullopt;
  return curve;
}

std::optional<analysis::Curve> ProbeSeries::flowRate(const Scene& scene) const {
  const ProbeSpec* probe = firstOfKind(scene, "flow_rate");
  const Column* mass = probe ? find(probe->name, "mass") : nullptr;
  if (!mass || mass->time.size() < 2) return std::nullopt;
  analysis::Curve curve;
  curve.name = "flow_rate";
  curve.x = {"time", "s"};
  curve.y = {"flow rate", "g/s"};
  analysis::Series series;
  const std::size_t stride = 1 + (mass->time.size() - 1) / flowSpans;
  double span = 0;
  for (std::size_t k = (mass->time.size() - 1) % stride; k + stride < mass->time.size(); k += stride) {
    span = mass->time[k + stride] - mass->time[k];
    if (!(span > 0)) continue;
    series.x.push_back((mass->time[k] + mass->time[k + stride]) / 2);
    series.y.push_back(1e3 * (mass->value[k + stride] - mass->value[k]) / span);
  }
  if (series.x.empty()) return std::nullopt;
  curve.definition =
      fmt::format("Mass through '{}' per time, means over {:.3g} ms.", probe->name, 1e3 * span);
  curve.series.push_back(std::move(series));
  return curve;
}

} // namespace sandglass::desktop
