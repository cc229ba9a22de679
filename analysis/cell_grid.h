#pragma once
// Points sorted into cells. Rows of cells along one axis are contiguous in memory, so that a search visits
// few long runs of points instead of many cells.

#include "sim/frame/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace sandglass::analysis {

class CellGrid {
public:
  /// `cellSize` is a wish [m]: periodic axes are divided evenly, and there are never many more cells than
  /// points. Points must lie in the domain along periodic axes.
  /// Along the rows cells are `fineness` times shorter, so that runs end closer to the ball that is looked
  /// at.
  CellGrid(std::span<const Vec3> points, const Domain& domain, double cellSize, double fineness = 1);

  std::size_t size() const { return original_.size(); }
  /// Index that the sorted point had in the caller's array.
  std::uint32_t original(std::size_t sorted) const { return original_[sorted]; }
  /// Coordinates along the grid's own three axes (the last is the row axis). `padding` more numbers, zeros,
  /// follow the last, so that loops may read whole vectors.
  static constexpr std::size_t padding = 8;
  const double* coordinates(int axis) const { return x_[axis].data(); }
  /// Coordinate (0 x, 1 y, 2 z) that each axis of the grid is.
  const std::array<int, 3>& axes() const { return order_; }
  double period(int axis) const { return axes_[axis].periodic ? axes_[axis].length : 0; }

  /// Calls run(begin, end, shift) for runs of sorted points that hold all points within r of `centre` (in
  /// grid axes), and some farther ones; a point's image is its coordinates plus shift. With `forwardFrom` >=
  /// 0, the sorted index of the centre itself, of each pair and its mirror image only one is visited.
  template <class Run>
  void around(const std::array<double, 3>& centre, double r, std::int64_t forwardFrom, Run&& run) const {
    const auto [a0, a1] = cellRange(0, centre[0], r);
    const int homeA = cellOf(0, centre[0]), homeB = cellOf(1, centre[1]);
    for (int a = forwardFrom >= 0 ? homeA : a0; a <= a1; ++a) {
      const double gapA = gap(0, a, centre[0]);
      const double leftA = r * r - gapA * gapA;
      if (leftA < 0) continue;
      const auto [b0, b1] = cellRange(1, centre[1], std::sqrt(leftA));
      const int fromB = forwardFrom >= 0 && a == homeA ? std::max(b0, homeB) : b0;
      for (int b = fromB; b <= b1; ++b) {
        const double gapB = gap(1, b, centre[1]);
        const double left = leftA - gapB * gapB;
        if (left < 0) continue;
        const bool own = forwardFrom >= 0 && a == homeA && b == homeB;
        const auto [c0, c1] = cellRange(2, centre[2], std::sqrt(left));
        const int na = axes_[0].count, nb = axes_[1].count, nc = axes_[2].count;
        const int ka = floorDiv(a, na), kb = floorDiv(b, nb);
        const std::size_t row = (static_cast<std::size_t>(a - ka * na) * nb + (b - kb * nb)) * nc;
        for (int k = floorDiv(c0, nc); k <= floorDiv(c1, nc); ++k) {
          if (own && k < 0) continue;
          const std::size_t first = row + (std::max(c0, k * nc) - k * nc);
          const std::size_t last = row + (std::min(c1, k * nc + nc - 1) - k * nc);
          std::size_t begin = start_[first];
          if (own && k == 0) begin = std::max(begin, static_cast<std::size_t>(forwardFrom) + 1);
          const std::size_t end = start_[last + 1];
          if (begin < end)
            run(begin, end,
                std::array<double, 3>{ka * axes_[0].length, kb * axes_[1].length, k * axes_[2].length});
        }
      }
    }
  }

private:
  struct Axis {
    double origin = 0, length = 0, width = 1, perWidth = 1;
    int count = 1;
    bool periodic = false;
  };
  static int floorDiv(int a, int b) {
    if (static_cast<unsigned>(a) < static_cast<unsigned>(b)) return 0; // mostly; a division is slow
    return a >= 0 ? a / b : -((b - 1 - a) / b);
  }
  int cellOf(int axis, double x) const {
    const Axis& g = axes_[axis];
    return std::clamp(static_cast<int>(std::floor((x - g.origin) * g.perWidth)), 0, g.count - 1);
  }
  /// Cells, unwrapped, that [x - r, x + r] touches; a hair more, against rounding at cell borders.
  std::pair<int, int> cellRange(int axis, double x, double r) const {
    const Axis& g = axes_[axis];
    const double reach = r + 1e-9 * g.width;
    int from = static_cast<int>(std::floor((x - reach - g.origin) * g.perWidth));
    int to = static_cast<int>(std::floor((x + reach - g.origin) * g.perWidth));
    if (!g.periodic) {
      from = std::max(from, 0);
      to = std::min(to, g.count - 1);
    }
    return {from, to};
  }
  double gap(int axis, int cell, double x) const {
    const Axis& g = axes_[axis];
    const double low = g.origin + cell * g.width;
    return std::max({0.0, low - x - 1e-9 * g.width, x - low - g.width * (1 + 1e-9)});
  }

  std::array<Axis, 3> axes_;
  std::array<int, 3> order_{0, 1, 2}; ///< grid axis -> coordinate
  std::array<std::vector<double>, 3> x_;
  std::vector<std::uint32_t> original_;
  std::vector<std::size_t> start_;
};

} // namespace sandglass::analysis
