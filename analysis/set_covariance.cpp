#include "analysis/set_covariance.h"

#include "analysis/quasi_random.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

SetCovariance::SetCovariance(const Region& region, double reach, std::uint64_t seed, int points)
    : spacing_(reach / half), share_(static_cast<std::size_t>(side) * side * side) {
  std::vector<Vec3> inside;
  const QuasiRandom3 sequence(seed, 0x636f76ULL);
  // A region that fills less than a thousandth of its box is left with fewer points.
  for (std::uint64_t n = 0; n < 1000 * static_cast<std::uint64_t>(points); ++n) {
    const auto u = sequence(n);
    const Vec3 x = region.box().min() + region.box().sizes().cwiseProduct(Vec3(u[0], u[1], u[2]));
    if (!region.contains(x)) continue;
    inside.push_back(x);
    if (static_cast<int>(inside.size()) == points) break;
  }
  points_ = std::max<int>(1, static_cast<int>(inside.size()));
  // gamma(h) = gamma(-h): half of the nodes do; those out of reach of any cell that is asked for, none.
  constexpr int nodes = side * side * side;
  const double farthest = reach + 2 * spacing_ * std::sqrt(3.0);
  tbb::parallel_for(0, nodes / 2 + 1, [&](int node) {
    const Vec3 h = spacing_ * Vec3(node % side - half, node / side % side - half, node / side / side - half);
    if (h.norm() > farthest) return;
    int hits = 0;
    for (const auto& x : inside)
      hits += region.contains(x + h);
    const double share = static_cast<double>(hits) / points_;
    share_[static_cast<std::size_t>(node)] = share_[static_cast<std::size_t>(nodes - 1 - node)] = share;
  });
}

double SetCovariance::operator()(const Vec3& h) const {
  return (4 * interpolated(h, 1) - interpolated(h, 2)) / 3;
}

double SetCovariance::interpolated(const Vec3& h, int stride) const {
  std::array<int, 3> low;
  Vec3 f;
  for (int k = 0; k < 3; ++k) {
    const double s = std::clamp(h[k] / spacing_ + half, 0.0, 2.0 * half) / stride;
    const int cell = std::min(static_cast<int>(s), 2 * half / stride - 1);
    low[k] = stride * cell;
    f[k] = s - cell;
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const int node = ((low[2] + k * stride) * side + low[1] + j * stride) * side + low[0] + i * stride;
    sum += (i ? f.x() : 1 - f.x()) * (j ? f.y() : 1 - f.y()) * (k ? f.z() : 1 - f.z()) *
           share_[static_cast<std::size_t>(node)];
  }
  return sum;
}

} // namespace sandglass::analysis
