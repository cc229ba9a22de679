#include "vis/survey.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

namespace {

class Range {
public:
  void include(double v) {
    if (!std::isfinite(v)) return;
    low_ = std::min(low_, v);
    high_ = std::max(high_, v);
  }
  std::array<double, 2> values() const {
    if (low_ <= high_) return {low_, high_};
    return {0, 1};
  }

private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -std::numeric_limits<double>::infinity();
};

} // namespace

Survey survey(const std::vector<const FrameSource*>& sources, const std::string& quantity,
              const std::function<void()>& onFrame) {
  Survey result;
  Range run, lastStage;
  std::string stage;
  for (const FrameSource* source : sources)
    for (std::size_t k = 0; k < source->size(); ++k) {
      const FramePtr frame = source->load(k);
      if (frame->stage != stage) {
        result.grains = {};
        lastStage = {};
      }
      stage = frame->stage;
      result.grains.add(*frame);
      if (!quantity.empty() && frame->size() > 0)
        for (const double v : grainScalar(*frame, quantity)) {
          run.include(v);
          lastStage.include(v);
        }
      if (onFrame) onFrame();
    }
  result.run = run.values();
  result.lastStage = lastStage.values();
  return result;
}

} // namespace sandglass::vis
