#pragma once
// What mixed precision can do.

#include "sim/contact/law_stack.h"
#include "sim/scene/scene.h"

namespace sandglass {

/// Throws InputError where pairs of the scene cannot be computed in mixed precision.
void checkMixedPrecision(const Scene& scene, const LawStack& laws);

} // namespace sandglass
