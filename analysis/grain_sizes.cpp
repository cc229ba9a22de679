#include "analysis/grain_sizes.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

namespace sandglass::analysis {

double meanDiameter(const Frame& frame) {
  if (!frame.scalars.contains(quantity::radius) || frame.size() == 0)
    throw InputError(fmt::format(
        "the frame at {:.6g} s has no grain radii, which this analysis needs: give --diameter", frame.time));
  return 2 * mean(frame.scalar(quantity::radius));
}

} // namespace sandglass::analysis
