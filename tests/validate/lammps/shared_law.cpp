#include "tests/validate/lammps/cases.h"

#include <fmt/format.h>

namespace sandglass::validate {

std::string SharedLaw::contact(const std::string& a, const std::string& b) const {
  return fmt::format(R"([[contact]]
between = ["{}", "{}"]
normal = {{ law = "linear", stiffness = "{:.17g} N/m", damping_rate = "{:.17g} 1/s", clamp_attraction = true }}
tangential = {{ law = "spring", friction = {}, stiffness_ratio = 0.5, rotation = "project", arm = "radius" }}
)",
                     a, b, stiffness, dampingRate, friction);
}

peers::HookeHistory SharedLaw::coefficients() const {
  return {stiffness, 0.5 * stiffness, dampingRate, 0, friction, true};
}

} // namespace sandglass::validate
