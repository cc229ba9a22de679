#include "analysis/sweep/sweep_design.h"

#include "sim/base/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

namespace sandglass::analysis {

namespace {

/// 0 for the ends of a row of halvings, 1 for what lies between them, ...
int depthOf(std::size_t index, std::size_t count) {
  const int most = std::bit_width(count - 1);
  return index == 0 ? 0 : most - std::countr_zero(index);
}

SweepValue between(const SweepAxis& axis, std::int64_t lattice, std::int64_t unit) {
  const auto index = static_cast<std::size_t>(lattice / unit);
  if (axis.isText()) return axis.texts[index];
  if (lattice % unit == 0) return axis.numbers[index];
  const double share = static_cast<double>(lattice % unit) / static_cast<double>(unit);
  const double low = axis.numbers[index], high = axis.numbers[index + 1];
  if (!axis.logarithmic) return low + share * (high - low);
  return std::exp(std::log(low) + share * (std::log(high) - std::log(low)));
}

SweepPoint pointAt(const SweepPlan& plan, std::vector<std::int64_t> lattice, int level) {
  SweepPoint point;
  point.level = level;
  for (std::size_t a = 0; a < plan.axes.size(); ++a)
    point.values.push_back(between(plan.axes[a], lattice[a], std::int64_t{1} << plan.refineLevels));
  point.lattice = std::move(lattice);
  for (auto& value : deriveValues(plan, point.values))
    point.values.push_back(std::move(value));
  return point;
}

std::vector<SweepPoint> grid(const SweepPlan& plan) {
  const std::size_t axes = plan.axes.size();
  std::vector<std::pair<int, std::vector<std::size_t>>> order; // depth, index along each axis
  std::vector<std::size_t> index(axes, 0);
  for (bool more = true; more;) {
    int depth = 0;
    for (std::size_t a = 0; a < axes; ++a)
      depth = std::max(depth, depthOf(index[a], plan.axes[a].size()));
    order.emplace_back(depth, index);
    more = false;
    for (std::size_t a = axes; a-- > 0 && !more;) {
      more = ++index[a] < plan.axes[a].size();
      if (!more) index[a] = 0;
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SweepPoint> points;
  for (const auto& [depth, at] : order) {
    std::vector<std::int64_t> lattice;
    for (const std::size_t i : at)
      lattice.push_back(static_cast<std::int64_t>(i) << plan.refineLevels);
    points.push_back(pointAt(plan, std::move(lattice), 0));
  }
  return points;
}

std::vector<SweepPoint> samples(const SweepPlan& plan) {
  const std::size_t n = plan.points;
  const bool hypercube = plan.sampling == SweepSampling::latinHypercube;
  std::vector<SweepPoint> points(n);
  for (std::size_t a = 0; a < plan.axes.size(); ++a) {
    const SweepAxis& axis = plan.axes[a];
    RandomStream random(plan.samplingSeed, RandomPurpose::analysisSample, a);
    std::vector<std::size_t> strata(n); // which of n equal parts of the axis each point lies in
    std::iota(strata.begin(), strata.end(), std::size_t{0});
    for (std::size_t k = n; hypercube && k > 1; --k)
      std::swap(strata[k - 1], strata[std::min(k - 1, static_cast<std::size_t>(random.uniform() * k))]);
    for (std::size_t k = 0; k < n; ++k) {
      const double share = hypercube
                               ? (static_cast<double>(strata[k]) + random.uniform()) / static_cast<double>(n)
                               : random.uniform();
      if (axis.isText()) {
        const auto which = static_cast<std::size_t>(share * static_cast<double>(axis.texts.size()));
        points[k].values.emplace_back(axis.texts[std::min(which, axis.texts.size() - 1)]);
      } else {
        const double low = axis.numbers.front(), high = axis.numbers.back();
        points[k].values.emplace_back(axis.logarithmic
                                          ? std::exp(std::log(low) + share * (std::log(high) - std::log(low)))
                                          : low + share * (high - low));
      }
    }
  }
  for (auto& point : points)
    for (auto& value : deriveValues(plan, point.values))
      point.values.push_back(std::move(value));
  return points;
}

} // namespace

std::vector<SweepPoint> firstPoints(const SweepPlan& plan) {
  auto points = plan.sampling == SweepSampling::grid ? grid(plan) : samples(plan);
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k].id = static_cast<int>(k) + 1;
  return points;
}

std::vector<SweepPoint>
refinedPoints(const SweepPlan& plan, const std::vector<SweepPoint>& points, int level,
              const std::function<bool(const SweepPoint&, const SweepPoint&)>& differ) {
  std::map<std::vector<std::int64_t>, const SweepPoint*> known;
  for (const auto& point : points)
    known[point.lattice] = &point;
  const std::int64_t step = std::int64_t{1} << (plan.refineLevels - level + 1);
  std::vector<SweepPoint> added;
  std::map<std::vector<std::int64_t>, bool> taken;
  for (const auto& point : points)
    for (std::size_t a = 0; a < plan.axes.size(); ++a) {
      if (plan.axes[a].isText()) continue;
      auto next = point.lattice;
      next[a] += step;
      const auto neighbour = known.find(next);
      if (neighbour == known.end() || !differ(point, *neighbour->second)) continue;
      auto middle = point.lattice;
      middle[a] += step / 2;
      if (known.contains(middle) || !taken.try_emplace(middle, true).second) continue;
      added.push_back(pointAt(plan, std::move(middle), level));
    }
  for (std::size_t k = 0; k < added.size(); ++k)
    added[k].id = static_cast<int>(points.size() + k) + 1;
  return added;
}

} // namespace sandglass::analysis
