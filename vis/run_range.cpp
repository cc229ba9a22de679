#include "vis/run_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

std::array<double, 2> runRange(const std::vector<const FrameSource*>& sources, const std::string& quantity,
                               const std::function<void()>& onFrame) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const FrameSource* source : sources)
    for (std::size_t k = 0; k < source->size(); ++k) {
      const FramePtr frame = source->load(k);
      if (frame->size() > 0)
        for (const double v : grainScalar(*frame, quantity))
          if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
      if (onFrame) onFrame();
    }
  if (!(low <= high)) return {0, 1};
  return {low, high};
}

} // namespace sandglass::vis
