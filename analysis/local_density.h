#pragma once
// Number density about each point, for weights: the correction of estimator E4.

#include "analysis/region.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sandglass::analysis {

/// For each point the number of others within `radius` (images count) and the volume of that ball inside the
/// region [m^3], by 128 quasi-random points where the ball is not inside for certain.
struct LocalDensity {
  std::vector<int> count;
  std::vector<double> volume;
};
LocalDensity localDensity(const Region& region, std::span<const Vec3> points, double radius,
                          std::uint64_t seed);

} // namespace sandglass::analysis
