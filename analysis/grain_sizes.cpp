#include "analysis/grain_sizes.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::analysis {

double meanDiameter(const Frame& frame) {
  if (frame.size() == 0)
    throw InputError(fmt::format("the frame at {:.6g} s has no grains: choose other frames", frame.time));
  if (!frame.scalars.contains(quantity::radius))
    throw InputError(fmt::format(
        "the frame at {:.6g} s has no grain radii, which this analysis needs: give --diameter", frame.time));
  const auto& radius = frame.scalar(quantity::radius);
  const auto [least, most] = std::minmax_element(radius.begin(), radius.end());
  return *least == *most ? 2 * *least : 2 * mean(radius); // equal grains: without the rounding of a sum
}

} // namespace sandglass::analysis
