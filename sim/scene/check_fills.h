#pragma once
// Checks of fillings: what each must say, and whether its grains can fit.

#include "sim/scene/fault_list.h"
#include "sim/scene/scene.h"

namespace sandglass {

void checkFills(const Scene& scene, FaultList& faults);   ///< each filling on its own
void checkSizes(const Scene& scene, FaultList& faults);   ///< grains against periods and openings
void checkAmounts(const Scene& scene, FaultList& faults); ///< numbers, memory, space

} // namespace sandglass
