#include "analysis/bond_angles.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass::analysis {

namespace {
constexpr std::array<int, 3> all{-1, -1, -1};
constexpr double degree = std::numbers::pi / 180;
} // namespace

BondAngles::Counts BondAngles::fresh() const {
  const auto bins = static_cast<std::size_t>(options_.bins);
  return {std::vector<std::uint64_t>(bins), std::vector<std::uint64_t>(bins), 0};
}

void BondAngles::add(const Frame& frame, const Region& region) {
  const NeighbourList list = neighboursWithin(frame.position, frame.domain, options_.cutoff);
  const bool partial = options_.species && frame.has(quantity::species) && frame.speciesNames.size() > 1;
  const auto* species = partial ? &frame.scalar(quantity::species) : nullptr;
  if (regionText_.empty()) regionText_ = region.description();
  names_ = frame.speciesNames;

  struct Work {
    ByKind counts;
    std::uint64_t middles = 0, neighbours = 0;
  };
  tbb::enumerable_thread_specific<Work> works([&] { return Work{{{all, fresh()}}, 0, 0}; });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, frame.size(), 256), [&](const auto& range) {
    Work& work = works.local();
    Counts& total = work.counts[all];
    std::vector<Vec3> bond;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const double radius = frame.has(quantity::radius) ? frame.scalar(quantity::radius)[i] : 0;
      if (!region.containsGrain(frame.position[i], radius)) continue;
      const auto near = list.indices(i);
      bond.clear();
      for (const Vec3& v : list.vectors(i))
        bond.push_back(v.normalized());
      ++work.middles;
      work.neighbours += bond.size();
      for (std::size_t j = 0; j + 1 < bond.size(); ++j)
        for (std::size_t k = j + 1; k < bond.size(); ++k) {
          const double c = std::clamp(bond[j].dot(bond[k]), -1.0, 1.0);
          const auto bins = static_cast<double>(options_.bins);
          const auto bin = [&](double share) {
            return static_cast<std::size_t>(std::clamp(share * bins, 0.0, bins - 1));
          };
          const std::size_t t = bin(std::acos(c) / std::numbers::pi), u = bin(0.5 * (c + 1));
          ++total.theta[t], ++total.cosine[u], ++total.total;
          if (!species) continue;
          const int a = static_cast<int>((*species)[near[j]]), b = static_cast<int>((*species)[near[k]]);
          const std::array<int, 3> kind{std::min(a, b), static_cast<int>((*species)[i]), std::max(a, b)};
          auto [it, isNew] = work.counts.try_emplace(kind);
          if (isNew) it->second = fresh();
          ++it->second.theta[t], ++it->second.cosine[u], ++it->second.total;
        }
    }
  });
  ByKind sum{{all, fresh()}};
  for (const auto& work : works) {
    middles_ += work.middles;
    neighbours_ += work.neighbours;
    for (const auto& [kind, counts] : work.counts) {
      auto [it, isNew] = sum.try_emplace(kind);
      if (isNew) it->second = fresh();
      for (std::size_t b = 0; b < counts.theta.size(); ++b) {
        it->second.theta[b] += counts.theta[b];
        it->second.cosine[b] += counts.cosine[b];
      }
      it->second.total += counts.total;
    }
  }
  frames_.push_back(std::move(sum));
}

/// form 0: density over degrees or cosines; 1: over what random directions would give.
Series BondAngles::series(const std::string& name, const std::array<int, 3>& kind, bool cosine,
                          int form) const {
  Series series{name, {}, {}, {}};
  const int bins = options_.bins;
  for (int b = 0; b < bins; ++b) {
    double counted = 0, total = 0;
    std::vector<double> each;
    // Random directions: shares of the sphere between two angles, or equal shares of the cosine.
    const double low = 180.0 * b / bins, high = 180.0 * (b + 1) / bins;
    const double random = cosine ? 1.0 / bins : 0.5 * (std::cos(low * degree) - std::cos(high * degree));
    const double unit = form == 1 ? 1 / random : cosine ? 0.5 * bins : bins / 180.0;
    for (const auto& frame : frames_) {
      const auto it = frame.find(kind);
      if (it == frame.end() || it->second.total == 0) continue;
      const auto n =
          static_cast<double>((cosine ? it->second.cosine : it->second.theta)[static_cast<std::size_t>(b)]);
      counted += n;
      total += static_cast<double>(it->second.total);
      each.push_back(unit * n / static_cast<double>(it->second.total));
    }
    series.x.push_back(cosine ? -1 + (2.0 * b + 1) / bins : 0.5 * (low + high));
    series.y.push_back(total > 0 ? unit * counted / total : 0);
    series.error.push_back(each.size() >= 4 ? blockedStandardError(each)
                           : total > 0      ? unit * std::sqrt(counted) / total
                                            : 0);
  }
  return series;
}

std::vector<Curve> BondAngles::results() const {
  std::uint64_t angles = 0;
  ByKind kinds;
  for (const auto& frame : frames_)
    for (const auto& [kind, counts] : frame) {
      kinds.try_emplace(kind);
      if (kind == all) angles += counts.total;
    }
  if (angles == 0)
    throw InputError(
        "no grain in the region has two neighbours within the cut-off: choose other frames, wider "
        "limits, or a larger cut-off");
  std::vector<Curve> curves;
  const auto curve = [&](const std::string& name, const std::string& title, Axis x, Axis y, bool cosine,
                         int form, const std::string& what) {
    Curve c;
    c.name = name;
    c.title = title;
    c.x = std::move(x);
    c.y = std::move(y);
    c.frames = frames_.size();
    c.definition = fmt::format(
        "{}; angles j-i-k over pairs j < k of neighbours nearer than {}; i in W: {}; {}", what,
        options_.cutoffText.empty() ? fmt::format("{:.4g} m", options_.cutoff) : options_.cutoffText,
        regionText_, frames_.size() >= 4 ? "error: blocks of frames" : "error: counting, a lower bound");
    c.numbers = {{"angles", static_cast<double>(angles)},
                 {"cutoff", options_.cutoff},
                 {"neighbours", static_cast<double>(neighbours_) / static_cast<double>(middles_)}};
    for (const auto& [kind, unused] : kinds) {
      std::string label = "all";
      const auto nameOf = [&](int s) {
        return static_cast<std::size_t>(s) < names_.size() ? names_[static_cast<std::size_t>(s)]
                                                           : std::to_string(s);
      };
      if (kind != all) label = fmt::format("{}-({})-{}", nameOf(kind[0]), nameOf(kind[1]), nameOf(kind[2]));
      c.series.push_back(series(label, kind, cosine, form));
    }
    curves.push_back(std::move(c));
  };
  curve("bond_angles", "Bond angles", {"theta", "deg"}, {"P(theta)", "1/deg"}, false, 0,
        "P(theta), integral 1 over 180 degrees");
  curve("bond_angles_over_sin", "Bond angles over random directions", {"theta", "deg"},
        {"P / (sin(theta) / 2)", ""}, false, 1,
        "P(theta) over that of random directions, sin(theta) / 2; each bin by its exact share");
  curves.back().marks.push_back({"random directions", 1.0, false});
  curve("bond_angles_cosine", "Cosines of bond angles", {"cos(theta)", ""}, {"density", ""}, true, 0,
        "density of cos(theta), integral 1; random directions 1/2");
  curves.back().marks.push_back({"random directions", 0.5, false});
  return curves;
}

} // namespace sandglass::analysis
