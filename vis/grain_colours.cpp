#include "vis/grain_colours.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

GrainColours grainColours(const Frame& frame, const Colouring& colouring, const VisibleGrains& grains,
                          const std::vector<std::size_t>& subset) {
  GrainColours result;
  result.ofGrain.resize(subset.size());
  if (colouring.quantity.empty()) {
    Rgb plain;
    for (int k = 0; k < 3; ++k)
      plain[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(colouring.plain[k], 0.0, 1.0)));
    std::fill(result.ofGrain.begin(), result.ofGrain.end(), plain);
    return result;
  }
  Legend legend;
  legend.name = colouring.quantity;
  legend.unit = unitOf(colouring.quantity);
  if (frame.size() == 0) {
    legend.map = ColourMap(colouring.map);
    legend.low = colouring.low;
    legend.high = colouring.high;
    if (colouring.range != ColourRange::frame) result.legend = legend;
    return result;
  }
  const std::vector<double> values = grainScalar(frame, colouring.quantity);
  if (colouring.quantity == quantity::species && !frame.speciesNames.empty()) {
    legend.map = ColourMap("discrete");
    legend.entries = frame.speciesNames;
    for (std::size_t k = 0; k < subset.size(); ++k)
      result.ofGrain[k] = legend.map.ofIndex(std::lround(values[grains.index[subset[k]]]));
    result.legend = legend;
    return result;
  }
  legend.map = ColourMap(colouring.map);
  legend.low = colouring.low;
  legend.high = colouring.high;
  if (colouring.range == ColourRange::frame) {
    legend.low = std::numeric_limits<double>::infinity();
    legend.high = -legend.low;
    for (const double v : values)
      if (std::isfinite(v)) legend.low = std::min(legend.low, v), legend.high = std::max(legend.high, v);
    if (!(legend.low <= legend.high)) legend.low = 0, legend.high = 1;
  }
  const double width = legend.high - legend.low;
  for (std::size_t k = 0; k < subset.size(); ++k)
    result.ofGrain[k] =
        legend.map.at(width > 0 ? (values[grains.index[subset[k]]] - legend.low) / width : 0.5);
  result.legend = legend;
  return result;
}

} // namespace sandglass::vis
