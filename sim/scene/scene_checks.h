#pragma once
// What the parts of a scene say about each other: references, missing contacts, grains that cannot fit,
// stages that never end. Runs after the tables are read; skips what is already known to be wrong.

#include "sim/scene/fault_list.h"
#include "sim/scene/scene.h"

namespace sandglass {

void checkScene(const Scene& scene, FaultList& faults);

} // namespace sandglass
