#pragma once

#include "sim/scene/fault_list.h"
#include "sim/scene/scene.h"

namespace sandglass {

/// Fields name each other, stages and events name fields; what cannot go together.
void checkFields(const Scene& scene, FaultList& faults);

} // namespace sandglass
