#pragma once
// The kinds of probe that a scene can name: what is sampled into series.csv while a run goes on.

#include "sim/scene/parameters.h"

#include <string>
#include <vector>

namespace sandglass {

struct ProbeKind {
  std::string name;
  std::string description;
  std::vector<ParameterSpec> parameters;
};

/// All kinds: energies, mass_in_region, flow_rate, wall_force.
const std::vector<ProbeKind>& probeKinds();

} // namespace sandglass
