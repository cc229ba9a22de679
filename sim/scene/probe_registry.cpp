#include "sim/scene/probe_registry.h"

namespace sandglass {

const std::vector<ProbeKind>& probeKinds() {
  using enum ParameterType;
  const auto point = [](const char* name, const char* description) {
    return ParameterSpec{.name = name, .type = vector, .unit = "m", .description = description};
  };
  static const std::vector<ProbeKind> kinds{
      {"energies", "energies of all grains by kind", {}},
      {"mass_in_region",
       "mass and number of the grains with their centre in a box",
       {point("lower", "lower corner of the box"), point("upper", "upper corner of the box")}},
      {"flow_rate",
       "mass per time through a plane, counted positive along its normal",
       {point("point", "a point of the plane"),
        {.name = "normal", .type = vector, .unit = "1", .description = "direction counted as positive"}}},
      {"wall_force",
       "force and torque of the grains on a wall, the work that it does by moving, the work of sliding along "
       "it "
       "and the number of contacts begun",
       {{.name = "wall", .type = text, .unit = "1", .description = "name of the wall"}}},
  };
  return kinds;
}

} // namespace sandglass
