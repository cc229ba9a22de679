#include "analysis/fill_height.h"

#include "analysis/free_surface.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {

/// Mass discharged at a time, on the line between the two samples about it.
double massAt(const DischargeData& data, double time) {
  const auto after = std::lower_bound(data.time.begin(), data.time.end(), time);
  if (after == data.time.begin()) return data.mass.front();
  if (after == data.time.end()) return data.mass.back();
  const auto k = static_cast<std::size_t>(after - data.time.begin());
  const double share = (time - data.time[k - 1]) / (data.time[k] - data.time[k - 1]);
  return data.mass[k - 1] + share * (data.mass[k] - data.mass[k - 1]);
}

} // namespace

double fillHeight(const Frame& frame, const Vec3& up, const Vec3& outlet, double diameter) {
  const FreeSurface surface(frame, up, 1.5 * diameter, diameter);
  double sum = 0, n = 0;
  for (const double height : surface.heights())
    if (height > up.dot(outlet)) sum += height - up.dot(outlet), n += 1;
  return n > 0 ? sum / n : 0;
}

Curve rateByFillHeight(const DischargeData& data, std::span<const FillSample> samples, double outlet) {
  Curve curve;
  curve.name = "rate_by_fill_height";
  curve.title = "Rate of discharge against fill height";
  curve.definition =
      "mass that left between frames over the time, against the mean height of the free surface above "
      "the outlet over the outlet's width";
  curve.x = {"fill height / outlet width", ""};
  curve.y = {"rate", "kg/s"};
  curve.frames = samples.size();
  Series series{"", {}, {}, {}};
  const double all = data.mass.empty() ? 0 : data.mass.back();
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const FillSample &a = samples[k - 1], &b = samples[k];
    const double before = massAt(data, a.time), after = massAt(data, b.time);
    if (!(b.time > a.time) || !(after > before) || !(before > 0) || after >= all) continue;
    series.x.push_back(0.5 * (a.height + b.height) / outlet);
    series.y.push_back((after - before) / (b.time - a.time));
  }
  constexpr std::size_t least = 3;
  if (series.x.size() < least)
    throw InputError(
        fmt::format("the rate against the fill height needs {} intervals between frames while grains "
                    "leave, and there are {}; write frames more often",
                    least, series.x.size()));
  curve.series.push_back(std::move(series));
  return curve;
}

} // namespace sandglass::analysis
