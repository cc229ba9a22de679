#pragma once
// The views of two frames side by side, such that the halves can be compared: one camera that holds both, and
// one range of colours.

#include "sim/frame/frame.h"
#include "vis/view.h"

#include <array>
#include <string>

namespace sandglass::vis {

/// The view without a colouring that the frame lacks: frames of other origin may hold positions alone.
View drawableView(const View& view, const Frame& frame);

struct PairViews {
  View left, right;
};

/// What Renderer::drawPair() takes. A camera preset is resolved against the grains of both; a colour range
/// "of this frame" becomes that of both frames. Titles are those of the frames, with `names` before them
/// where those are alike.
PairViews pairViews(const Frame& left, const Frame& right, const View& view,
                    const std::array<std::string, 2>& names);

} // namespace sandglass::vis
