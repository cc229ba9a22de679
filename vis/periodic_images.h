#pragma once
// Copies of everything along periodic directions.

#include "sim/frame/frame.h"
#include "vis/view.h"

#include <vector>

namespace sandglass::vis {

/// Shifts of the copies that the view asks for, the first one zero. Directions that are not periodic have
/// none.
std::vector<Vec3> imageShifts(const Domain& domain, const View& view);

} // namespace sandglass::vis
