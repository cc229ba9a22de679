#pragma once
// When something that repeats at an interval is due, in whole steps. Stateless: the answer depends on the
// interval, the step size and the step alone, so a resumed run sees the same steps and no error adds up.

#include <algorithm>
#include <cstdint>
#include <limits>

namespace sandglass {

class Schedule {
public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  Schedule() = default;
  /// Due at the steps nearest to 0, interval, 2 interval, ... [s]; an interval shorter than a step: at every
  /// step; interval <= 0: never.
  Schedule(double interval, double stepSize)
      : interval_(interval > 0 ? std::max(interval, stepSize) : 0), stepSize_(stepSize) {}

  /// The k-th due step, k = 0, 1, ...
  std::int64_t due(std::int64_t k) const;
  /// Number k of the last due step <= `step`; -1 when there is none.
  std::int64_t index(std::int64_t step) const;
  bool isDue(std::int64_t step) const;
  /// The first due step > `step`.
  std::int64_t next(std::int64_t step) const;

private:
  double interval_ = 0, stepSize_ = 0;
};

} // namespace sandglass
