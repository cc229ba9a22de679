#pragma once
// The colour of each grain, and the legend that explains it.

#include "vis/overlay.h"
#include "vis/visible_grains.h"

#include <optional>
#include <vector>

namespace sandglass::vis {

struct GrainColours {
  std::vector<Rgb> ofGrain;     ///< one for each of the subset
  std::optional<Legend> legend; ///< none for one plain colour
};

/// Colours for `subset` of `grains`. The range is that of all grains of the frame, clipped ones too, or the
/// view's; species are counted, not ranged. Throws InputError when the frame lacks the quantity.
GrainColours grainColours(const Frame& frame, const Colouring& colouring, const VisibleGrains& grains,
                          const std::vector<std::size_t>& subset);

} // namespace sandglass::vis
