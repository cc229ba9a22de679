#pragma once
// Which triangles of a mesh share which edges and corners.

#include "sim/base/mesh.h"

#include <array>
#include <vector>

namespace sandglass {

struct MeshTopology {
  struct Edge {
    std::array<int, 2> ends{};  ///< ascending
    std::vector<int> triangles; ///< one at a rim, two inside, more where sheets meet
    bool consistent = true;     ///< two triangles that run along it in opposite directions
  };

  explicit MeshTopology(const TriangleMesh& mesh);

  std::vector<Edge> edges;
  std::vector<std::array<int, 3>> edgesOf; ///< per triangle: from corner k to corner k + 1
  std::vector<std::vector<int>> around;    ///< triangles of each corner
  std::vector<Vec3> normals;               ///< unit, per triangle, right-handed about its corners

  /// Every edge has two triangles, in agreement about the outside.
  bool closed() const;
};

} // namespace sandglass
