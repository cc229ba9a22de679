#pragma once
// A look at all frames before the first is drawn: what makes the pictures of a film comparable.

#include "sim/io/run_folder.h"
#include "vis/fit.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace sandglass::vis {

struct Survey {
  std::array<double, 2> run{0, 1}; ///< range of the quantity over all frames; 0 to 1 when there is none
  // What happens before the last stage (grains falling in, say) shall set neither scale nor camera of a film.
  std::array<double, 2> lastStage{0, 1}; ///< range of the quantity over the last stage
  GrainExtent grains;                    ///< of the last stage
};

/// Reads every frame of every source. `quantity` may be empty (no range). `onFrame` is called after each.
/// Throws InputError when a frame with grains lacks the quantity.
Survey survey(const std::vector<const FrameSource*>& sources, const std::string& quantity,
              const std::function<void()>& onFrame = {});

} // namespace sandglass::vis
