#pragma once
// Whether a scene with a wedge is its own image under the wedge's turns: without that a sector says nothing
// about the whole.

#include "sim/scene/fault_list.h"
#include "sim/scene/scene.h"

namespace sandglass {

void checkWedge(const Scene& scene, FaultList& faults);

} // namespace sandglass
