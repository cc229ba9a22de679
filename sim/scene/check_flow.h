#pragma once
// Checks of what flows: recycling outlets, rain, and end conditions that could never be met.

#include "sim/scene/fault_list.h"
#include "sim/scene/scene.h"

namespace sandglass {

void checkRecycling(const Scene& scene, FaultList& faults); ///< after sizes are known to be sound
void checkEvents(const Scene& scene, FaultList& faults);
void checkEndings(const Scene& scene, FaultList& faults);   ///< likewise

} // namespace sandglass
