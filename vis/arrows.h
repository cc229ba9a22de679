#pragma once
// Vectors of grains as arrows, and the ways that grains have gone.

#include "vis/history.h"
#include "vis/solids.h"
#include "vis/view.h"

#include <vector>

namespace sandglass::vis {

/// An arrow for each visible grain, or an even subset. Throws InputError when the frame lacks the vector.
void addArrows(std::vector<Solid>& solids, const Frame& frame, const View& view, const History* history);

/// Tracks of the chosen grains up to the frame's time, each in its own colour. A line breaks where a grain
/// crosses a periodic boundary or has been put back: where it moves by more than a quarter of the domain
/// between two frames.
void addTracks(std::vector<Solid>& solids, const Frame& frame, const View& view, const History* history);

} // namespace sandglass::vis
