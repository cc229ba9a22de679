#pragma once
// "What if": a new run that shares the past of another one up to a frame and then goes its own way.

#include "sim/scene/scene.h"

#include <cstdint>
#include <filesystem>

namespace sandglass {

struct Branch {
  Scene scene;           ///< of the source without the events from `step` on
  std::int64_t step = 0; ///< of the frame from which it may differ: RunOptions::pauseAt
  std::int64_t from = 0; ///< of the nearest earlier checkpoint: up to `step` the run is computed again
};

/// Makes `target` a run folder that can be resumed: scene.toml, frames (hard links where the file system has
/// them), series and the checkpoints up to `step` of the run in `source`. Throws InputError when the source
/// holds no scene or no checkpoint so early, or the target exists.
Branch branchRun(const std::filesystem::path& source, std::int64_t step, const std::filesystem::path& target);

} // namespace sandglass
