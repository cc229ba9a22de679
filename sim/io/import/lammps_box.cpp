#include "sim/io/import/lammps_box.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass {

bool takeCornersOff(Domain& box, const Vec3& tilt) {
  const double xy = tilt[0], xz = tilt[1], yz = tilt[2];
  box.lower[0] -= std::min({0.0, xy, xz, xy + xz});
  box.upper[0] -= std::max({0.0, xy, xz, xy + xz});
  box.lower[1] -= std::min(0.0, yz);
  box.upper[1] -= std::max(0.0, yz);
  return (box.lower.array() <= box.upper.array()).all();
}

std::string unitsRemark(const std::string& units) {
  return fmt::format(
      "the file is in LAMMPS units '{}'; give their sizes under [units] in the file of --columns", units);
}

} // namespace sandglass
