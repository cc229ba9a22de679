#include "analysis/neighbour_list.h"

#include "analysis/cell_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace sandglass::analysis {

namespace {

struct Near {
  std::uint32_t index;
  Vec3 vector;
  double d2;
};

/// Points in blocks; each block makes its own piece of the list, the pieces are then joined.
template <class Accept>
NeighbourList build(std::span<const Vec3> points, const Domain& domain, double cutoff, Accept&& accept) {
  const CellGrid grid(points, domain, cutoff / 2);
  const auto axes = grid.axes();
  const std::size_t n = points.size();
  // Sorted points are near each other in memory, so lists are made in that order and placed afterwards.
  constexpr std::size_t block = 1024;
  const std::size_t blocks = (n + block - 1) / block;
  std::vector<std::vector<Near>> piece(blocks);
  NeighbourList list;
  list.start.assign(n + 1, 0);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    auto& mine = piece[b];
    mine.reserve(block * 16);
    for (std::size_t s = b * block; s < std::min(n, (b + 1) * block); ++s) {
      const std::uint32_t i = grid.original(s);
      const std::array<double, 3> c{grid.coordinates(0)[s], grid.coordinates(1)[s], grid.coordinates(2)[s]};
      const std::size_t first = mine.size();
      grid.around(c, cutoff, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
        for (std::size_t t = begin; t < end; ++t) {
          Vec3 h;
          for (int k = 0; k < 3; ++k)
            h[axes[k]] = grid.coordinates(k)[t] + shift[k] - c[k];
          const double d2 = h.squaredNorm();
          const std::uint32_t j = grid.original(t);
          if (d2 >= cutoff * cutoff || d2 == 0 || !accept(i, j, d2)) continue;
          mine.push_back({j, h, d2});
        }
      });
      std::sort(
          mine.begin() + static_cast<std::ptrdiff_t>(first), mine.end(),
          [](const Near& a, const Near& b) { return a.index != b.index ? a.index < b.index : a.d2 < b.d2; });
      list.start[i + 1] = mine.size() - first;
    }
  });
  std::partial_sum(list.start.begin(), list.start.end(), list.start.begin());
  list.index.resize(list.start.back());
  list.vector.resize(list.start.back());
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    std::size_t from = 0;
    for (std::size_t s = b * block; s < std::min(n, (b + 1) * block); ++s) {
      const std::uint32_t i = grid.original(s);
      for (std::size_t k = list.start[i]; k < list.start[i + 1]; ++k, ++from) {
        list.index[k] = piece[b][from].index;
        list.vector[k] = piece[b][from].vector;
      }
    }
    std::vector<Near>().swap(piece[b]);
  });
  return list;
}

} // namespace

NeighbourList neighboursWithin(std::span<const Vec3> points, const Domain& domain, double cutoff) {
  return build(points, domain, cutoff, [](std::uint32_t, std::uint32_t, double) { return true; });
}

NeighbourList neighboursByGap(std::span<const Vec3> points, std::span<const double> radii,
                              const Domain& domain, double share) {
  const double largest = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
  return build(points, domain, 2 * share * largest, [&](std::uint32_t i, std::uint32_t j, double d2) {
    const double reach = share * (radii[i] + radii[j]);
    return d2 < reach * reach;
  });
}

std::vector<int> components(const NeighbourList& list, const std::function<bool(std::size_t)>& member,
                            const std::function<bool(std::size_t, std::size_t)>& linked) {
  const std::size_t n = list.size();
  std::vector<int> component(n, -1);
  std::vector<std::size_t> stack;
  int count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (component[i] >= 0 || !member(i)) continue;
    component[i] = count;
    stack.assign(1, i);
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      for (std::size_t k = list.start[at]; k < list.start[at + 1]; ++k) {
        const std::size_t j = list.index[k];
        if (component[j] >= 0 || !member(j) || !linked(at, k)) continue;
        component[j] = count;
        stack.push_back(j);
      }
    }
    ++count;
  }
  return component;
}

} // namespace sandglass::analysis
