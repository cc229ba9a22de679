#pragma once
// The kinds of filling that a scene can name, and what each lets the scene say.

#include "sim/scene/parameters.h"

#include <string>
#include <vector>

namespace sandglass {

struct FillKind {
  std::string name;
  std::string description;
  std::vector<ParameterSpec> parameters;
};

/// All kinds: random, rain, lattice, list. The rows of "list" (`grains` or `csv` in the scene) are resolved
/// into the parameters species, diameters, positions, velocities and spins, one entry a grain.
const std::vector<FillKind>& fillKinds();

} // namespace sandglass
