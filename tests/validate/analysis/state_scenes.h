#pragma once
// Small runs whose mechanical state is known beforehand, for the state map.

#include "sim/frame/frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sandglass::validate {

enum class KnownState { bed, gas, shear };

/// bed: 700 beads settled on a rough floor. gas: 800 spheres of fraction 0.12 that cool by collisions
/// (restitution 0.9). shear: 700 beads down a rough incline of 22 degrees. Beads of 2 mm; frames of the last
/// fifth of the run.
std::vector<FramePtr> runOf(KnownState state, std::uint64_t seed);

/// Directions and magnitude of gravity in these scenes.
Vec3 gravityOf(KnownState state);

} // namespace sandglass::validate
