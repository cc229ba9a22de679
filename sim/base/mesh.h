#pragma once
// A bare triangle mesh: what walls show to pictures and exports.

#include "sim/base/vec.h"

#include <array>
#include <vector>

namespace sandglass {

struct TriangleMesh {
  std::vector<Vec3> points;                    ///< [m]
  std::vector<std::array<int, 3>> triangles;   ///< indices into points
  std::vector<std::array<int, 2>> edges;       ///< feature edges worth drawing as lines
};

} // namespace sandglass
