#pragma once
// When each grain entered and how often an outlet has put it back, by id: beside the store, so that it needs
// no reordering. Empty where the scene asks for neither.

#include "sim/scene/scene.h"

#include <cstdint>
#include <vector>

namespace sandglass {

class GrainLives {
public:
  /// Lives are kept where outlets recycle or frames show them (4 bytes a grain), times where outlets record
  /// or frames show residence times (8 bytes a grain).
  explicit GrainLives(const Scene& scene);

  void entered(std::int64_t id, std::int32_t life, double time);
  std::int32_t life(std::int64_t id) const { return id < size(lives_) ? lives_[id] : 0; }
  double enteredAt(std::int64_t id) const { return id < size(entries_) ? entries_[id] : 0; } ///< [s]

  // For checkpoints.
  std::vector<std::int32_t>& lives() { return lives_; }
  std::vector<double>& entries() { return entries_; }

private:
  template <class T> static std::int64_t size(const std::vector<T>& v) {
    return static_cast<std::int64_t>(v.size());
  }
  bool counted_ = false, timed_ = false;
  std::vector<std::int32_t> lives_;
  std::vector<double> entries_; ///< [s]
};

} // namespace sandglass
