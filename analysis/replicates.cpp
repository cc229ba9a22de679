#include "analysis/replicates.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sandglass::analysis {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::set<std::string> quantityNames(const std::vector<Replicate>& runs) {
  std::set<std::string> names;
  for (const auto& run : runs)
    for (const auto& [name, value] : run.quantities)
      names.insert(name);
  return names;
}

double quantityOf(const Replicate& run, const std::string& name) {
  const auto it = run.quantities.find(name);
  return it == run.quantities.end() ? none : it->second;
}

std::string unitOfQuantity(const Units& units, const std::string& name) {
  const auto it = units.find(name);
  return it == units.end() ? "" : it->second;
}

/// Linear between samples; `time` lies within them.
double massAt(const DischargeData& data, double time) {
  const auto after = std::upper_bound(data.time.begin(), data.time.end(), time);
  if (after == data.time.begin()) return data.mass.front();
  if (after == data.time.end()) return data.mass.back();
  const auto k = static_cast<std::size_t>(after - data.time.begin());
  const double part = (time - data.time[k - 1]) / (data.time[k] - data.time[k - 1]);
  return data.mass[k - 1] + part * (data.mass[k] - data.mass[k - 1]);
}

} // namespace

Spread spreadOf(std::span<const double> values, double confidence) {
  Spread spread;
  spread.count = values.size();
  spread.mean = values.empty() ? none : mean(values);
  spread.standardDeviation = spread.halfWidth = none;
  if (values.size() < 2) return spread;
  const auto n = static_cast<double>(values.size());
  spread.standardDeviation = std::sqrt(variance(values));
  spread.halfWidth = studentFactor(confidence, n - 1) * spread.standardDeviation / std::sqrt(n);
  return spread;
}

Table replicateTable(const std::vector<Replicate>& runs, const Units& units) {
  Table table;
  table.name = "replicates";
  table.title = "What each run ended with";
  table.definition = "one row for each seed";
  table.columns.push_back({"seed", ""});
  const auto names = quantityNames(runs);
  for (const auto& name : names)
    table.columns.push_back({name, unitOfQuantity(units, name)});
  for (const auto& run : runs) {
    auto& row = table.rows.emplace_back();
    row.push_back(static_cast<double>(run.seed));
    for (const auto& name : names)
      row.push_back(quantityOf(run, name));
  }
  return table;
}

Table replicateSummary(const std::vector<Replicate>& runs, const Units& units, double confidence) {
  Table table;
  table.name = "summary";
  table.title = "Mean over the seeds";
  table.definition =
      fmt::format("mean and standard deviation (n - 1) over runs that differ in their seed alone; "
                  "the interval of {:g} % is Student's, mean +- half width",
                  100 * confidence);
  table.rowTitle = "quantity";
  table.columns = {{"mean", ""},
                   {"standard_deviation", ""},
                   {fmt::format("half_width_{:g}", 100 * confidence), ""},
                   {"runs", ""}};
  for (const auto& name : quantityNames(runs)) {
    std::vector<double> values;
    for (const auto& run : runs)
      if (const double value = quantityOf(run, name); !std::isnan(value)) values.push_back(value);
    if (values.empty()) continue;
    const Spread s = spreadOf(values, confidence);
    const std::string unit = unitOfQuantity(units, name);
    table.rowNames.push_back(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
    table.rows.push_back({s.mean, s.standardDeviation, s.halfWidth, static_cast<double>(s.count)});
  }
  return table;
}

Curve meanDischarge(const std::vector<Replicate>& runs, double confidence) {
  std::vector<const DischargeData*> all;
  for (const auto& run : runs)
    if (run.discharge.time.size() > 1) all.push_back(&run.discharge);
  if (all.empty()) throw InputError("no run has a curve of its discharged mass, so there is no mean curve");
  double end = all.front()->time.back();
  for (const auto* data : all)
    end = std::min(end, data->time.back());

  Curve curve;
  curve.name = "discharge_mean";
  curve.title = "Discharged mass, mean over seeds";
  curve.definition = fmt::format(
      "mean of {} runs; band: standard error of the mean; broken lines: Student's interval of {:g} %; "
      "time since the stage began in which grains first left, to the end of the first run to end",
      all.size(), 100 * confidence);
  curve.x = {"time", "s"};
  curve.y = {"discharged mass", "kg"};
  Series middle{"mean", {}, {}, {}}, lower{fmt::format("{:g} % lower", 100 * confidence), {}, {}, {}},
      upper{fmt::format("{:g} % upper", 100 * confidence), {}, {}, {}};
  for (const double time : all.front()->time) {
    if (time > end) break;
    std::vector<double> masses;
    for (const auto* data : all)
      masses.push_back(massAt(*data, time));
    const Spread s = spreadOf(masses, confidence);
    middle.x.push_back(time);
    middle.y.push_back(s.mean);
    if (s.count < 2) continue;
    middle.error.push_back(s.standardDeviation / std::sqrt(static_cast<double>(s.count)));
    lower.y.push_back(s.mean - s.halfWidth);
    upper.y.push_back(s.mean + s.halfWidth);
  }
  lower.x = upper.x = middle.x;
  curve.series.push_back(std::move(middle));
  if (all.size() > 1) {
    curve.series.push_back(std::move(lower));
    curve.series.push_back(std::move(upper));
  }
  curve.numbers["runs"] = static_cast<double>(all.size());
  return curve;
}

} // namespace sandglass::analysis
