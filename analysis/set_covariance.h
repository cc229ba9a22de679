#pragma once
// How much of a region overlaps its own shifted copy: the correction of estimator E2.

#include "analysis/region.h"

#include <cstdint>
#include <vector>

namespace sandglass::analysis {

/// gamma(h) / |W| with gamma(h) = |{x in W : x + h in W}|, the set covariance, for |h| up to `reach`.
/// By `points` quasi-random points in W at the nodes of a grid over h. Between them linear, extrapolated from
/// two spacings (Richardson), which is exact for boxes but for the sampling: gamma is a product of linear
/// functions of |h_k|, and both grids have a node at 0 along each axis.
class SetCovariance {
public:
  SetCovariance(const Region& region, double reach, std::uint64_t seed, int points = 2048);

  double operator()(const Vec3& h) const;
  int points() const { return points_; }

private:
  double interpolated(const Vec3& h, int stride) const;
  static constexpr int half = 12; ///< nodes on either side of 0; even
  static constexpr int side = 2 * half + 1;
  double spacing_;
  int points_ = 0;
  std::vector<double> share_;
};

} // namespace sandglass::analysis
