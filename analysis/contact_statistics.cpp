#include "analysis/contact_statistics.h"

#include "analysis/grain_sizes.h"
#include "analysis/histogram.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {

/// A round number of bins' widths above the greatest value: 1, 2 or 5 times a power of ten.
double roundedUp(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value < step * power) return step * power;
  return 10 * power;
}

} // namespace

void ContactStatistics::add(const Frame& frame) {
  if (frame.size() > 0 && frame.contacts.empty())
    throw InputError(
        fmt::format("the frame at {:.6g} s has no contacts: set contacts = true in [output] of the "
                    "scene, or choose frames in which grains touch",
                    frame.time));
  const double diameter = options_.diameter > 0 ? options_.diameter : meanDiameter(frame);
  for (const auto& contact : frame.contacts) {
    if (!(contact.overlap > 0)) continue;
    Kind& kind = contact.b >= 0 ? grains_ : walls_;
    kind.overlap.push_back(contact.overlap / diameter);
    kind.force.push_back(contact.force.norm());
  }
  ++frames_;
}

void ContactStatistics::needData() const {
  if (grains_.overlap.empty() && walls_.overlap.empty())
    throw InputError("there is no contact with an overlap in these frames; frames of earlier versions of the "
                     "program hold contacts without overlaps");
}

Curve ContactStatistics::overlaps() const {
  needData();
  Curve curve;
  curve.name = "overlaps";
  curve.title = "Overlaps";
  curve.definition =
      "probability density of the overlap as a share of the grain diameter; errors: square root of "
      "the count";
  curve.x = {"overlap / d", ""};
  curve.y = {"density", ""};
  curve.frames = frames_;
  double greatest = 0;
  for (const auto* kind : {&grains_, &walls_})
    for (const double v : kind->overlap)
      greatest = std::max(greatest, v);
  for (const auto& [kind, name] : {std::pair{&grains_, "grain"}, {&walls_, "wall"}}) {
    const auto& values = kind->overlap;
    if (values.empty()) continue;
    Histogram histogram(0, roundedUp(greatest), options_.bins);
    for (const double v : values)
      histogram.add(v);
    curve.series.push_back(histogram.density(fmt::format("grain and {}", name)));
    const auto deep = std::count_if(values.begin(), values.end(), [](double v) { return v > 0.01; });
    curve.numbers[fmt::format("{}_contacts", name)] = static_cast<double>(values.size());
    curve.numbers[fmt::format("{}_mean", name)] = mean(values);
    curve.numbers[fmt::format("{}_greatest", name)] = *std::max_element(values.begin(), values.end());
    curve.numbers[fmt::format("{}_share_above_0.01", name)] =
        static_cast<double>(deep) / static_cast<double>(values.size());
  }
  return curve;
}

Curve ContactStatistics::forces() const {
  needData();
  Curve curve;
  curve.name = "contact_forces";
  curve.title = "Contact forces";
  curve.definition =
      "probability density of the magnitude of the contact force over its mean, each kind by its own "
      "mean; errors: square root of the count";
  curve.x = {"force / mean force", ""};
  curve.y = {"density", ""};
  curve.frames = frames_;
  constexpr double reach = 6; // beyond six means few contacts are left in any packing
  for (const auto& [kind, name] : {std::pair{&grains_, "grain"}, {&walls_, "wall"}}) {
    const auto& values = kind->force;
    if (values.empty()) continue;
    const double average = mean(values);
    if (!(average > 0)) continue;
    Histogram histogram(0, reach, options_.bins);
    for (const double v : values)
      histogram.add(v / average);
    curve.series.push_back(histogram.density(fmt::format("grain and {}", name)));
    curve.numbers[fmt::format("{}_contacts", name)] = static_cast<double>(values.size());
    curve.numbers[fmt::format("{}_mean_force", name)] = average;
    curve.numbers[fmt::format("{}_greatest_over_mean", name)] =
        *std::max_element(values.begin(), values.end()) / average;
  }
  return curve;
}

} // namespace sandglass::analysis
