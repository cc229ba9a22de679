#pragma once
// The range of a quantity over all frames of a run: what makes the pictures of a film comparable.

#include "sim/io/run_folder.h"
#include "vis/view.h"

#include <functional>
#include <string>
#include <vector>

namespace sandglass::vis {

/// Lowest and highest finite value of colouring.quantity in every frame of every source; frames without
/// grains count for nothing. {0, 1} when there is none at all. `onFrame` is called after each frame. Throws
/// InputError when a frame lacks the quantity.
std::array<double, 2> runRange(const std::vector<const FrameSource*>& sources, const std::string& quantity,
                               const std::function<void()>& onFrame = {});

} // namespace sandglass::vis
