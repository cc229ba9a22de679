#include "vis/grain_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

namespace {

/// Three quarters of the way to the ground, without hue.
Rgb paled(const Rgb& colour, const std::array<double, 3>& ground) {
  const double luma = 0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2];
  Rgb result;
  for (int k = 0; k < 3; ++k)
    result[k] = static_cast<std::uint8_t>(std::lround(0.25 * luma + 0.75 * 255 * ground[k]));
  return result;
}

std::array<double, 2> rangeOf(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (low <= high) return {low, high};
  return {0, 1};
}

/// The range that the colours span: the view's, or that of the frame.
void setRange(Legend& legend, const Colouring& colouring, const std::vector<double>& values,
              const History* history) {
  legend.low = colouring.low;
  legend.high = colouring.high;
  if (colouring.range != ColourRange::frame) return;
  const auto axis = originalAxis(colouring.quantity);
  const auto [low, high] = axis && history ? history->originalRange(*axis) : rangeOf(values);
  legend.low = low;
  legend.high = high;
}

constexpr long mostClasses = 24; ///< that a legend has room for

bool areClasses(const Legend& legend, const std::vector<double>& values) {
  return legend.map.discrete() && legend.high - legend.low < mostClasses &&
         std::all_of(values.begin(), values.end(),
                     [](double v) { return !std::isfinite(v) || v == std::round(v); });
}

} // namespace

GrainColours grainColours(const Frame& frame, const View& view, const VisibleGrains& grains,
                          const std::vector<std::size_t>& subset, const History* history) {
  const Colouring& colouring = view.colouring;
  GrainColours result;
  const auto paint = [&](auto colourOf) {
    result.ofGrain.resize(subset.size());
    for (std::size_t k = 0; k < subset.size(); ++k) {
      const Rgb colour = colourOf(grains.index[subset[k]]);
      const bool pale = !grains.pale.empty() && grains.pale[subset[k]] != 0;
      result.ofGrain[k] = pale ? paled(colour, view.background) : colour;
    }
  };
  if (colouring.quantity.empty()) {
    paint([plain = rgb(colouring.plain)](std::size_t) { return plain; });
    return result;
  }
  Legend legend;
  legend.name = colouring.quantity;
  legend.unit = quantityUnit(colouring.quantity);
  legend.map = ColourMap(colouring.map, colouring.reversed, colouring.bands);
  if (frame.size() == 0) {
    legend.low = colouring.low;
    legend.high = colouring.high;
    if (colouring.range != ColourRange::frame) result.legend = legend;
    return result;
  }
  const std::vector<double> values = quantityValues(frame, colouring.quantity, history);
  setRange(legend, colouring, values, history);
  if (colouring.quantity == quantity::species && !frame.speciesNames.empty()) {
    legend.map = ColourMap("discrete");
    legend.entries = frame.speciesNames;
  } else if (areClasses(legend, values)) {
    legend.firstEntry = std::lround(legend.low);
    for (long k = legend.firstEntry; k <= std::lround(legend.high); ++k)
      legend.entries.push_back(fmt::format("{}", k));
  }
  const double width = legend.high - legend.low;
  paint([&](std::size_t i) {
    if (legend.entries.empty() || !std::isfinite(values[i]))
      return legend.map.at(width > 0 ? (values[i] - legend.low) / width : 0 * values[i] + 0.5);
    return legend.map.ofIndex(std::lround(values[i]));
  });
  result.legend = legend;
  return result;
}

} // namespace sandglass::vis
