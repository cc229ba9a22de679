#include "analysis/kinds/grain_statistics.h"

#include "analysis/histogram.h"
#include "analysis/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sandglass::analysis {

void GrainStatistics::add(std::span<const double> values, std::span<const char> used) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (used[i] && !std::isnan(values[i])) {
      all_.push_back(values[i]);
      sum += values[i], n += 1;
    }
  if (n > 0) means_.push_back(sum / n);
}

double GrainStatistics::mean() const {
  return all_.empty() ? std::numeric_limits<double>::quiet_NaN() : analysis::mean(all_);
}

double GrainStatistics::error() const {
  return means_.size() >= 4 ? blockedStandardError(means_) : std::numeric_limits<double>::quiet_NaN();
}

double GrainStatistics::deviation() const {
  return std::sqrt(variance(all_));
}

void GrainStatistics::addNumbers(Curve& curve) const {
  curve.frames = means_.size();
  curve.numbers["grains"] = static_cast<double>(all_.size());
  curve.numbers["mean"] = mean();
  curve.numbers["standard_deviation"] = deviation();
  if (const double e = error(); std::isfinite(e)) curve.numbers["mean_error"] = e;
}

Curve GrainStatistics::distribution(const std::string& name, const std::string& title, const Axis& axis,
                                    const std::string& definition, int bins) const {
  Curve curve;
  curve.name = name;
  curve.title = title;
  curve.definition = definition;
  curve.x = axis;
  curve.y = {"density", axis.unit.empty() ? "" : "1/(" + axis.unit + ")"};
  if (all_.empty()) return curve;
  const auto [low, high] = std::minmax_element(all_.begin(), all_.end());
  const double pad =
      std::max(0.005 * (*high - *low), 1e-9 * std::max(1e-300, std::abs(*high) + std::abs(*low)));
  Histogram histogram(*low - pad, *high + pad, bins);
  for (const double v : all_)
    histogram.add(v);
  curve.series.push_back(histogram.density(""));
  addNumbers(curve);
  return curve;
}

Curve GrainStatistics::shares(const std::string& name, const std::string& title, const Axis& axis,
                              const std::string& definition) const {
  Curve curve;
  curve.name = name;
  curve.title = title;
  curve.definition = definition;
  curve.x = axis;
  curve.y = {"share", ""};
  std::map<int, double> counts;
  for (const double v : all_)
    counts[static_cast<int>(std::lround(v))] += 1;
  Series series;
  const auto n = static_cast<double>(all_.size());
  for (const auto& [value, count] : counts) {
    series.x.push_back(value);
    series.y.push_back(count / n);
    series.error.push_back(std::sqrt(count) / n);
  }
  curve.series.push_back(std::move(series));
  addNumbers(curve);
  return curve;
}

std::string withError(double value, double error) {
  if (std::isnan(value)) return "none";
  return std::isfinite(error) ? fmt::format("{:.4g} +- {:.1g}", value, error) : fmt::format("{:.4g}", value);
}

} // namespace sandglass::analysis
