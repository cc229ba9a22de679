#pragma once
// Contacts as tubes between the centres of their grains, or from a centre to the point on the wall.

#include "vis/legend.h"
#include "vis/solids.h"
#include "vis/view.h"

#include <optional>
#include <vector>

namespace sandglass::vis {

/// Adds a tube for each contact that the view shows: thickness in proportion to the force, colour from its
/// map. The legend says what the colours mean, also when there is no contact.
std::optional<Legend> addForceChains(std::vector<Solid>& solids, const Frame& frame, const View& view);

} // namespace sandglass::vis
