#include "sim/run/schedule.h"

#include <cmath>

namespace sandglass {

std::int64_t Schedule::due(std::int64_t k) const {
  if (!(interval_ > 0)) return never;
  const double step = std::round(static_cast<double>(k) * (interval_ / stepSize_));
  return step < 9e18 ? static_cast<std::int64_t>(step) : never;
}

std::int64_t Schedule::index(std::int64_t step) const {
  if (!(interval_ > 0)) return -1;
  // The quotient is off by one at most; due() decides.
  auto k = static_cast<std::int64_t>(static_cast<double>(step) * stepSize_ / interval_) + 1;
  while (k >= 0 && due(k) > step)
    --k;
  while (due(k + 1) <= step)
    ++k;
  return k;
}

bool Schedule::isDue(std::int64_t step) const {
  const std::int64_t k = index(step);
  return k >= 0 && due(k) == step;
}

std::int64_t Schedule::next(std::int64_t step) const {
  if (!(interval_ > 0)) return never;
  return due(index(step) + 1);
}

} // namespace sandglass
