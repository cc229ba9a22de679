#pragma once
// The colour of each grain, and the legend that explains it.

#include "vis/legend.h"
#include "vis/visible_grains.h"

#include <optional>
#include <vector>

namespace sandglass::vis {

struct GrainColours {
  std::vector<Rgb> ofGrain;     ///< one for each of the subset
  std::optional<Legend> legend; ///< none for one plain colour
};

/// Colours for `subset` of `grains`. The range is that of all grains of the frame, clipped ones too, or the
/// view's; of original positions that of all originals. Species are counted, not ranged, and so is every
/// quantity of whole numbers that is coloured by the map "discrete". Grains that a selection leaves out are
/// pale. Throws InputError when the frame lacks the quantity.
GrainColours grainColours(const Frame& frame, const View& view, const VisibleGrains& grains,
                          const std::vector<std::size_t>& subset, const History* history = nullptr);

} // namespace sandglass::vis
