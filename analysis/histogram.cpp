#include "analysis/histogram.h"

#include <cmath>

namespace sandglass::analysis {

Histogram::Histogram(double low, double high, int bins)
    : low_(low), width_((high - low) / bins), counts_(static_cast<std::size_t>(bins)) {}

void Histogram::add(double value) {
  ++total_;
  const double bin = std::floor((value - low_) / width_);
  if (bin >= 0 && bin < static_cast<double>(counts_.size())) ++counts_[static_cast<std::size_t>(bin)];
}

Series Histogram::density(const std::string& name) const {
  Series series{name, {}, {}, {}};
  const double unit = total_ > 0 ? 1 / (static_cast<double>(total_) * width_) : 0;
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    const auto count = static_cast<double>(counts_[k]);
    series.x.push_back(low_ + (static_cast<double>(k) + 0.5) * width_);
    series.y.push_back(count * unit);
    series.error.push_back(std::sqrt(count) * unit);
  }
  return series;
}

} // namespace sandglass::analysis
