#include "analysis/cell_grid.h"

#include <limits>

namespace sandglass::analysis {

CellGrid::CellGrid(std::span<const Vec3> points, const Domain& domain, double cellSize, double fineness) {
  const std::size_t n = points.size();
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const auto& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  if (n == 0) lower = upper = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (domain.periodic[k]) {
      lower[k] = domain.lower[k];
      upper[k] = domain.upper[k];
    }
  // Rows run along the longest axis: long runs vectorise.
  const Vec3 extent = upper - lower;
  std::sort(order_.begin(), order_.end(), [&](int a, int b) { return extent[a] < extent[b]; });

  const double most = 4.0 * static_cast<double>(n) + 64;
  for (double size = cellSize;; size *= 1.26) {
    double cells = 1;
    for (int k = 0; k < 3; ++k) {
      Axis& g = axes_[k];
      g.origin = lower[order_[k]];
      g.length = extent[order_[k]];
      g.periodic = domain.periodic[order_[k]];
      const double width = k == 2 ? size / fineness : size;
      const double wanted =
          std::max(1.0, g.periodic ? std::floor(g.length / width) : std::ceil(g.length / width));
      g.count = static_cast<int>(std::min(wanted, 1e6));
      g.width = g.length > 0 ? g.length / g.count : width;
      g.perWidth = 1 / g.width;
      cells *= wanted;
    }
    if (cells <= most) break;
  }

  const auto cellIndex = [&](const Vec3& p) {
    std::size_t c = 0;
    for (int k = 0; k < 3; ++k)
      c = c * axes_[k].count + cellOf(k, p[order_[k]]);
    return c;
  };
  const std::size_t cells = static_cast<std::size_t>(axes_[0].count) * axes_[1].count * axes_[2].count;
  start_.assign(cells + 1, 0);
  std::vector<std::size_t> cell(n);
  for (std::size_t i = 0; i < n; ++i)
    ++start_[(cell[i] = cellIndex(points[i])) + 1];
  for (std::size_t c = 0; c < cells; ++c)
    start_[c + 1] += start_[c];
  auto next = start_;
  original_.resize(n);
  for (auto& x : x_)
    x.resize(n + padding, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = next[cell[i]]++;
    original_[at] = static_cast<std::uint32_t>(i);
    for (int k = 0; k < 3; ++k)
      x_[k][at] = points[i][order_[k]];
  }
}

} // namespace sandglass::analysis
