#pragma once
// Sums over ordered pairs in bins of distance, each pair with a weight of its own: what g(r) by the
// estimators E2 and E4 and of pairs of species needs. Pairs without weights: neighbours.h is faster.

#include "analysis/cell_grid.h"
#include "analysis/neighbours.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace sandglass::analysis {

struct PairSums {
  std::vector<std::uint64_t> counts; ///< pairs
  std::vector<double> weights;       ///< sums of the weights
};

/// i over `references`, j over `points` and all periodic images; with `same` the two are one set, and a point
/// is not its own neighbour. weight(i, j, h, r) with h from i to j, 0 <= weight < 2^20. Weights are added in
/// fixed point (steps of 2^-30), so that no order of threads changes a bit.
template <class Weight>
PairSums sumPairs(std::span<const Vec3> references, std::span<const Vec3> points, bool same,
                  const Domain& domain, const PairCountOptions& options, Weight&& weight) {
  struct Bin {
    std::uint64_t count = 0, sum = 0;
  };
  const CellGrid grid(points, domain, options.rMax / 4);
  const std::array<int, 3> axes = grid.axes();
  const std::size_t bins = static_cast<std::size_t>(options.bins);
  const double r2 = options.rMax * options.rMax, inverseWidth = options.bins / options.rMax;
  tbb::enumerable_thread_specific<std::vector<Bin>> partial([&] { return std::vector<Bin>(bins); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, references.size(), 64), [&](const auto& range) {
    auto& histogram = partial.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::array<double, 3> c{references[i][axes[0]], references[i][axes[1]], references[i][axes[2]]};
      grid.around(c, options.rMax, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
        const bool home = shift[0] == 0 && shift[1] == 0 && shift[2] == 0;
        for (std::size_t s = begin; s < end; ++s) {
          Vec3 h;
          for (int k = 0; k < 3; ++k)
            h[axes[k]] = grid.coordinates(k)[s] + shift[k] - c[k];
          const double d2 = h.squaredNorm();
          if (d2 >= r2) continue;
          const std::size_t j = grid.original(s);
          if (same && j == i && (home || !options.selfImages)) continue;
          const double r = std::sqrt(d2);
          const std::size_t bin = std::min(bins - 1, static_cast<std::size_t>(r * inverseWidth));
          ++histogram[bin].count;
          histogram[bin].sum += static_cast<std::uint64_t>(weight(i, j, h, r) * 0x1p30 + 0.5);
        }
      });
    }
  });
  PairSums sums{std::vector<std::uint64_t>(bins), std::vector<double>(bins)};
  std::vector<std::uint64_t> total(bins);
  for (const auto& histogram : partial)
    for (std::size_t b = 0; b < bins; ++b) {
      sums.counts[b] += histogram[b].count;
      total[b] += histogram[b].sum;
    }
  for (std::size_t b = 0; b < bins; ++b)
    sums.weights[b] = static_cast<double>(total[b]) * 0x1p-30;
  return sums;
}

} // namespace sandglass::analysis
