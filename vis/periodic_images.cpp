#include "vis/periodic_images.h"

namespace sandglass::vis {

std::vector<Vec3> imageShifts(const Domain& domain, const View& view) {
  std::vector<Vec3> shifts{Vec3::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain.periodic[axis]) continue;
    const double period = domain.upper[axis] - domain.lower[axis];
    const std::size_t before = shifts.size();
    for (int copy = -view.periodicImages[axis]; copy <= view.periodicImages[axis]; ++copy)
      for (std::size_t k = 0; copy != 0 && k < before; ++k)
        shifts.push_back(shifts[k] + copy * period * Vec3::Unit(axis));
  }
  return shifts;
}

} // namespace sandglass::vis
