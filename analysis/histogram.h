#pragma once
// Values to densities.

#include "analysis/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// Counts in equal bins over [low, high); values outside are counted apart. Counts stay integers.
class Histogram {
public:
  Histogram(double low, double high, int bins);

  void add(double value);
  std::int64_t total() const { return total_; } ///< with those outside

  /// Probability density against the middles of the bins: count / (total * width), so that the integral is
  /// the share that lies in the range. Error: sqrt(count) likewise, a lower bound where values are
  /// correlated.
  Series density(const std::string& name) const;

private:
  double low_, width_;
  std::vector<std::int64_t> counts_;
  std::int64_t total_ = 0;
};

} // namespace sandglass::analysis
