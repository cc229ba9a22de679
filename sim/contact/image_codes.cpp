#include "sim/contact/image_codes.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

ImageCodes::ImageCodes(const Domain& domain, double cutoff) {
  const Vec3 extent = domain.upper - domain.lower;
  double total = 1.0;
  for (int k = 0; k < 3; ++k) {
    // Two grains of the box are less than one period apart, so image s is met when (s - 1) periods are less
    // than the cut-off.
    if (domain.periodic[k]) reach[k] = static_cast<int>(std::clamp(std::ceil(cutoff / extent[k]), 1.0, 1e6));
    total *= 2.0 * reach[k] + 1.0;
  }
  if (total > 255.0)
    throw InputError(fmt::format(
        "the periodic box is so thin that a pair has {} images; at most 255 are possible: make the "
        "box wider than half a grain",
        total));
  image.clear();
  shift.clear();
  for (int x = -reach[0]; x <= reach[0]; ++x)
    for (int y = -reach[1]; y <= reach[1]; ++y)
      for (int z = -reach[2]; z <= reach[2]; ++z) {
        image.push_back({x, y, z});
        shift.push_back({x * extent[0], y * extent[1], z * extent[2], 0.0});
      }
}

} // namespace sandglass
