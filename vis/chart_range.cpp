#include "vis/chart_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

namespace {

class Extent {
public:
  void include(double v) {
    if (!std::isfinite(v)) return;
    low_ = std::min(low_, v);
    high_ = std::max(high_, v);
  }
  Span withAir(double air, double nearZero) const {
    if (!(low_ <= high_)) return {};
    if (low_ == high_) {
      const double half = low_ == 0 ? 1 : 0.5 * std::abs(low_);
      return {low_ - half, high_ + half};
    }
    const double room = air * (high_ - low_);
    const bool fromZero = low_ >= 0 && low_ < nearZero * high_;
    const bool toZero = high_ <= 0 && high_ > nearZero * low_;
    return {fromZero ? 0 : low_ - room, toZero ? 0 : high_ + room};
  }

private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -std::numeric_limits<double>::infinity();
};

} // namespace

ChartRange chartRange(const analysis::Curve& curve) {
  Extent x, y;
  for (const auto& series : curve.series) {
    const std::size_t n = std::min(series.x.size(), series.y.size());
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(series.y[i])) continue;
      x.include(series.x[i]);
      y.include(series.y[i]);
      if (i < series.error.size() && std::isfinite(series.error[i])) {
        const double low = series.y[i] - series.error[i];
        y.include(series.y[i] >= 0 ? std::max(low, 0.0)
                                   : low); // a quantity that cannot be negative stays above 0
        y.include(series.y[i] + series.error[i]);
      }
    }
  }
  for (const auto& mark : curve.marks)
    (mark.vertical ? x : y).include(mark.position);
  return {x.withAir(0.02, 0.15), y.withAir(0.06, 0.5)};
}

} // namespace sandglass::vis
