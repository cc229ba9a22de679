#include "sim/walls/mesh_topology.h"

#include <algorithm>
#include <map>

namespace sandglass {

MeshTopology::MeshTopology(const TriangleMesh& mesh) {
  std::map<std::array<int, 2>, int> known;
  std::vector<int> ascending; // triangles that run along an edge from its lower to its higher end, per edge
  around.resize(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    edgesOf.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const int a = corner[k], b = corner[(k + 1) % 3];
      const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
      const auto [it, fresh] = known.try_emplace(ends, static_cast<int>(edges.size()));
      if (fresh) {
        edges.push_back({ends, {}, true});
        ascending.push_back(0);
      }
      edges[it->second].triangles.push_back(static_cast<int>(t));
      ascending[it->second] += a < b ? 1 : 0;
      edgesOf.back()[k] = it->second;
      around[a].push_back(static_cast<int>(t));
    }
    const Vec3 &a = mesh.points[corner[0]], &b = mesh.points[corner[1]], &c = mesh.points[corner[2]];
    normals.push_back((b - a).cross(c - a).normalized());
  }
  for (std::size_t e = 0; e < edges.size(); ++e)
    edges[e].consistent = edges[e].triangles.size() == 2 && ascending[e] == 1;
}

bool MeshTopology::closed() const {
  return std::all_of(edges.begin(), edges.end(), [](const Edge& e) { return e.consistent; });
}

} // namespace sandglass
