#include "app/desktop/analyses.h"

#include "analysis/contact_statistics.h"
#include "analysis/histogram.h"
#include "analysis/packing.h"
#include "analysis/pair_correlation.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sandglass::desktop {

namespace {

using analysis::Curve;

constexpr int bins = 120;

Curve pairCorrelation(const AnalysisInput& in) {
  analysis::PairCorrelationOptions options;
  options.bins = bins;
  options.pointsPerShell = 20000; // a panel needs no more than its line is wide
  if (in.up.norm() > 0) options.region.up = in.up.normalized();
  Curve curve = analysis::pairCorrelation(*in.frame, options).g;
  for (auto& series : curve.series)
    for (std::size_t k = 0; k < series.error.size(); ++k) // where no pair was found there is nothing to see
      if (series.y[k] == 0) series.error[k] = 0;
  return curve;
}

/// Density of `values` as a staircase.
Curve densityOf(const std::vector<double>& values, const std::string& name, const std::string& unit,
                double low, double high, int count) {
  analysis::Histogram histogram(low, high, count);
  for (const double v : values)
    histogram.add(v);
  Curve curve;
  curve.x = {name, unit};
  curve.y = {"density", unit.empty() ? "" : "1/(" + unit + ")"};
  curve.frames = 1;
  const analysis::Series middle = histogram.density("");
  analysis::Series stairs;
  const double half = (high - low) / count / 2;
  for (std::size_t k = 0; k < middle.x.size(); ++k)
    for (const double side : {-half, half}) {
      stairs.x.push_back(middle.x[k] + side);
      stairs.y.push_back(middle.y[k]);
    }
  curve.series.push_back(std::move(stairs));
  return curve;
}

Curve histogramOf(const AnalysisInput& in) {
  const std::string quantity = in.quantity.empty() ? "speed" : in.quantity;
  std::vector<double> values = grainScalar(*in.frame, quantity);
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) throw InputError(fmt::format("no grain has a finite {}", quantity));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = *least, span = *most - *least;
  const double high = low + (span > 0 ? span * (1 + 1e-9) : std::max(std::abs(low), 1.0) * 1e-3);
  const int count = std::clamp(static_cast<int>(2 * std::cbrt(static_cast<double>(values.size()))), 10, 80);
  Curve curve = densityOf(values, quantity, unitOf(quantity), low, high, count);
  double sum = 0, squares = 0;
  for (const double v : values)
    sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (const double v : values)
    squares += (v - mean) * (v - mean);
  const double deviation = std::sqrt(squares / static_cast<double>(values.size()));
  curve.name = "histogram";
  curve.numbers = {{"mean", mean}, {"deviation", deviation}};
  curve.definition = fmt::format("{} grains; mean {:.4g}, standard deviation {:.3g} {}.", values.size(), mean,
                                 deviation, unitOf(quantity));
  return curve;
}

Curve packing(const AnalysisInput& in) {
  analysis::PackingOptions options;
  if (in.up.norm() > 0) options.up = in.up.normalized();
  analysis::PackingProfile profile(options);
  profile.add(*in.frame);
  return profile.result();
}

Curve forces(const AnalysisInput& in) {
  analysis::ContactStatistics statistics({});
  statistics.add(*in.frame);
  return statistics.forces();
}

Curve contactNumbers(const AnalysisInput& in) {
  const Frame& frame = *in.frame;
  if (frame.contacts.empty())
    throw InputError(
        "the frame holds no contacts; give the scene [output] contacts = true, or wait until grains "
        "touch");
  std::map<std::int64_t, int> touches;
  for (const auto id : frame.id)
    touches[id] = 0;
  std::int64_t pairs = 0;
  for (const auto& contact : frame.contacts) {
    if (contact.overlap < 0) continue; // a law that acts across a gap
    ++touches[contact.a];
    if (contact.b >= 0) ++touches[contact.b], ++pairs;
  }
  std::vector<double> values;
  for (const auto& [id, number] : touches)
    values.push_back(number);
  const double most = *std::max_element(values.begin(), values.end());
  Curve curve = densityOf(values, "contacts of a grain", "", -0.5, most + 0.5, static_cast<int>(most) + 1);
  curve.y.name = "share of grains";
  curve.name = "contacts";
  const double mean = 2 * static_cast<double>(pairs) / static_cast<double>(values.size());
  curve.numbers = {{"coordination", mean}};
  curve.definition =
      fmt::format("{} grains, walls counted; coordination by grains alone {:.3f}.", values.size(), mean);
  return curve;
}

} // namespace

const std::vector<FrameAnalysis>& frameAnalyses() {
  static const std::vector<FrameAnalysis> all{
      {"gr", "Pair correlation g(r)", "Pair correlation of the frame that is shown, corrected for walls",
       false, true, pairCorrelation},
      {"histogram", "Histogram", "How any quantity of the grains is distributed", true, false, histogramOf},
      {"packing", "Packing", "Packing fraction by height", false, false, packing},
      {"contacts", "Contacts", "How many contacts grains have", false, false, contactNumbers},
      {"forces", "Contact forces", "How contact forces are distributed about their mean", false, false,
       forces},
  };
  return all;
}

} // namespace sandglass::desktop
