#pragma once
// Grain sizes of a Frame, for analyses that need them.

#include "sim/frame/frame.h"

namespace sandglass::analysis {

/// Twice the mean radius [m]. Throws InputError when the Frame has no radii or no grains.
double meanDiameter(const Frame& frame);

} // namespace sandglass::analysis
