#include "sim/grains/grain_lives.h"

#include <algorithm>

namespace sandglass {

GrainLives::GrainLives(const Scene& scene) {
  for (const auto& outlet : scene.outlets) {
    counted_ = counted_ || outlet.recycle;
    timed_ = timed_ || outlet.record;
  }
  for (const auto& name : scene.output.quantities) {
    counted_ = counted_ || name == quantity::life;
    timed_ = timed_ || name == quantity::residenceTime;
  }
}

void GrainLives::entered(std::int64_t id, std::int32_t life, double time) {
  const auto needed = static_cast<std::size_t>(id) + 1;
  if (counted_) {
    lives_.resize(std::max(lives_.size(), needed));
    lives_[needed - 1] = life;
  }
  if (timed_) {
    entries_.resize(std::max(entries_.size(), needed));
    entries_[needed - 1] = time;
  }
}

} // namespace sandglass
