#include "analysis/residence.h"

#include "analysis/histogram.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

Curve residenceTimes(const SeriesColumns& discharged, int bins, const std::string& source) {
  const auto &all = recordedColumn(discharged, "residence_time", source),
             &life = recordedColumn(discharged, "life", source);
  const bool cameBack = std::any_of(life.begin(), life.end(), [](double l) { return l > 0; });
  std::vector<double> times;
  for (std::size_t i = 0; i < all.size() && i < life.size(); ++i)
    if (!cameBack || life[i] > 0) times.push_back(all[i]);
  if (times.empty())
    throw InputError(
        fmt::format("{}: no grain has left, so there are no residence times; run longer", source));
  std::sort(times.begin(), times.end());

  const double longest = times.back();
  Histogram histogram(0, longest > 0 ? longest * (1 + 1e-12) : 1, bins);
  for (const double t : times)
    histogram.add(t);
  Curve curve;
  curve.name = "residence_times";
  curve.title = "Residence times";
  curve.definition =
      fmt::format("probability density of the time from {} to leaving; errors: square root of the count",
                  cameBack ? "being put back" : "entering");
  curve.x = {"residence time", "s"};
  curve.y = {"density", "1/s"};
  curve.series.push_back(histogram.density("residence times"));
  const std::size_t n = times.size();
  curve.numbers = {{"grains", static_cast<double>(n)},
                   {"mean", mean(times)},
                   {"standard_deviation", std::sqrt(variance(times))},
                   {"median", 0.5 * (times[(n - 1) / 2] + times[n / 2])},
                   {"shortest", times.front()},
                   {"longest", longest}};
  curve.marks = {{"mean", curve.numbers["mean"], true}};
  return curve;
}

} // namespace sandglass::analysis
