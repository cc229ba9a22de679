#include "app/desktop/chart_curves.h"

#include <cmath>
#include <numbers>

namespace sandglass::desktop {

analysis::Curve logarithmic(analysis::Curve curve, bool x) {
  analysis::Axis& axis = x ? curve.x : curve.y;
  axis.name = "log10 of " + axis.name + (axis.unit.empty() ? "" : " in " + axis.unit);
  axis.unit.clear();
  for (auto& series : curve.series) {
    analysis::Series kept{series.name, {}, {}, {}};
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
      const double value = x ? series.x[k] : series.y[k];
      if (!(value > 0)) continue;
      kept.x.push_back(x ? std::log10(value) : series.x[k]);
      kept.y.push_back(x ? series.y[k] : std::log10(value));
      if (k < series.error.size()) // d log10 y = dy / (y ln 10)
        kept.error.push_back(x ? series.error[k] : series.error[k] / value / std::numbers::ln10);
    }
    series = std::move(kept);
  }
  std::erase_if(curve.marks, [&](const auto& mark) { return mark.vertical == x && !(mark.position > 0); });
  for (auto& mark : curve.marks)
    if (mark.vertical == x) mark.position = std::log10(mark.position);
  return curve;
}

analysis::Curve cutOut(analysis::Curve curve, double low, double high) {
  for (auto& s : curve.series) {
    analysis::Series kept{s.name, {}, {}, {}};
    const std::size_t n = std::min(s.x.size(), s.y.size());
    const auto crossing = [&](std::size_t k, double at) {
      const double share = (at - s.x[k]) / (s.x[k + 1] - s.x[k]);
      kept.x.push_back(at);
      kept.y.push_back(s.y[k] + share * (s.y[k + 1] - s.y[k]));
      if (!s.error.empty()) kept.error.push_back(s.error[k]);
    };
    for (std::size_t k = 0; k < n; ++k) {
      if (s.x[k] >= low && s.x[k] <= high) {
        kept.x.push_back(s.x[k]);
        kept.y.push_back(s.y[k]);
        if (k < s.error.size()) kept.error.push_back(s.error[k]);
      }
      if (k + 1 >= n) continue;
      for (const double end : s.x[k] < s.x[k + 1] ? std::array{low, high} : std::array{high, low})
        if ((s.x[k] < end) != (s.x[k + 1] < end) && s.x[k] != end && s.x[k + 1] != end) crossing(k, end);
    }
    s = std::move(kept);
  }
  std::erase_if(curve.marks,
                [&](const auto& m) { return m.vertical && !(m.position >= low && m.position <= high); });
  return curve;
}

std::optional<NearestPoint> nearestPoint(const analysis::Curve& curve, const vis::ChartPlace& place,
                                         double pixelX, double pixelY) {
  std::optional<NearestPoint> best;
  double least = 0;
  for (const auto& series : curve.series)
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
      const double x =
          place.left + (series.x[k] - place.xLow) / (place.xHigh - place.xLow) * (place.right - place.left);
      const double y =
          place.bottom - (series.y[k] - place.yLow) / (place.yHigh - place.yLow) * (place.bottom - place.top);
      const double distance = std::hypot(x - pixelX, y - pixelY);
      if (!std::isfinite(distance) || (best && distance >= least)) continue;
      least = distance;
      best = {series.name, series.x[k], series.y[k], x, y};
    }
  return best;
}

} // namespace sandglass::desktop
