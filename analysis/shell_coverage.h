#pragma once
// How much of the spherical shells about grain centres lies in the region: the correction of estimator E3.

#include "analysis/region.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sandglass::analysis {

struct ShellCoverageOptions {
  double rMax = 0;     ///< [m]
  int bins = 100;      ///< shells of equal thickness
  int directions = 32; ///< quasi-random points in each shell of each centre
  std::int64_t pointsPerShell =
      200000; ///< cap over all centres: fewer directions (down to 4), then fewer centres
  std::uint64_t seed = 1;
};

struct ShellCoverage {
  std::vector<double> share; ///< mean over the centres of |shell and region| / |shell|
  std::vector<double> error; ///< standard error of that, as for independent points (an upper bound)
};

/// Shells that are inside the region for certain cost nothing. Counts are integers: equal for any number of
/// threads.
ShellCoverage shellCoverage(const Region& region, std::span<const Vec3> centres,
                            const ShellCoverageOptions& options);

} // namespace sandglass::analysis
