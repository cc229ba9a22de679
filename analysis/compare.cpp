#include "analysis/compare.h"

#include "analysis/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace sandglass::analysis {

TwoSampleTest compareSamples(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  TwoSampleTest test;
  if (a.empty() || b.empty()) return test;
  const auto na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double x = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= x)
      ++i;
    while (j < b.size() && b[j] <= x)
      ++j;
    test.distance =
        std::max(test.distance, std::abs(static_cast<double>(i) / na - static_cast<double>(j) / nb));
  }
  const double root = std::sqrt(na * nb / (na + nb)), t = (root + 0.12 + 0.11 / root) * test.distance;
  if (t < 0.2) return test; // the series converges slowly there, and the chance is 1 to twelve digits
  double sum = 0;
  for (int k = 1; k <= 100; ++k)
    sum += (k % 2 ? 2 : -2) * std::exp(-2.0 * k * k * t * t);
  test.probability = std::clamp(sum, 0.0, 1.0);
  return test;
}

FrameDifference difference(const Frame& a, const Frame& b) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::unordered_map<std::int64_t, std::size_t> index;
  for (std::size_t i = 0; i < b.size(); ++i)
    index.emplace(b.id[i], i);
  FrameDifference d{a.time, b.time - a.time, 0, nan, nan, nan};
  double largest = 0, sum = 0, velocity = 0;
  const bool moving = a.has(quantity::velocity) && b.has(quantity::velocity);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto it = index.find(a.id[i]);
    if (it == index.end()) continue;
    Vec3 h = b.position[it->second] - a.position[i];
    for (int k = 0; k < 3; ++k)
      if (a.domain.periodic[static_cast<std::size_t>(k)]) {
        const double length = a.domain.upper[k] - a.domain.lower[k];
        h[k] -= length * std::round(h[k] / length);
      }
    ++d.common;
    largest = std::max(largest, h.norm());
    sum += h.squaredNorm();
    if (moving)
      velocity += (b.vector(quantity::velocity)[it->second] - a.vector(quantity::velocity)[i]).squaredNorm();
  }
  if (d.common == 0) return d;
  d.largest = largest;
  d.rms = std::sqrt(sum / static_cast<double>(d.common));
  if (moving) d.velocityRms = std::sqrt(velocity / static_cast<double>(d.common));
  return d;
}

Table compareDistributions(const Frame& a, const Frame& b) {
  Table table;
  table.name = "distributions";
  table.title = "Distributions of the last frames";
  table.definition =
      "two-sample Kolmogorov-Smirnov test over grains, taken as independent: largest distance of the "
      "distribution functions, and the chance of a larger one if both were of one distribution";
  table.rowTitle = "quantity";
  table.columns = {{"mean of A", ""}, {"mean of B", ""}, {"distance", ""}, {"probability", ""}};
  const auto known = grainScalarNames(b);
  for (const auto& name : grainScalarNames(a)) {
    if (name == "id" || std::find(known.begin(), known.end(), name) == known.end()) continue;
    const auto x = grainScalar(a, name), y = grainScalar(b, name);
    const auto constant = [](const std::vector<double>& v) {
      return v.empty() || *std::min_element(v.begin(), v.end()) == *std::max_element(v.begin(), v.end());
    };
    if (constant(x) && constant(y)) continue;
    const TwoSampleTest test = compareSamples(x, y);
    const std::string unit = unitOf(name);
    table.rowNames.push_back(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
    table.rows.push_back({mean(x), mean(y), test.distance, test.probability});
  }
  return table;
}

} // namespace sandglass::analysis
