// A wall of triangles. A sphere touches it where its distance has a local minimum: inside a triangle, on an
// edge or in a corner. An edge or corner counts only where no triangle that it belongs to comes nearer, so a
// seam between two triangles is felt once; two triangles that meet in a hollow are felt as two. A curved
// surface in facets is hollow at every seam but means one contact: places whose normals differ by less than
// smooth_angle count as one, the deepest.

#include "sim/base/error.h"
#include "sim/scene/from_file.h"
#include "sim/walls/mesh_file.h"
#include "sim/walls/mesh_topology.h"
#include "sim/walls/wall_kinds.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass {

namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using TreeEntry = std::pair<TreeBox, int>;

TreePoint treePoint(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

enum class Side { both, inside, outside };

class MeshWall final : public WallShape {
public:
  MeshWall(TriangleMesh mesh, Side side, double smoothAngle)
      : mesh_(std::move(mesh)), topology_(mesh_), side_(side), smooth_(std::cos(smoothAngle)) {
    std::vector<TreeEntry> entries;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      Eigen::AlignedBox3d box;
      for (const int corner : mesh_.triangles[t])
        box.extend(mesh_.points[corner]);
      bounds_.extend(box);
      entries.emplace_back(TreeBox(treePoint(box.min()), treePoint(box.max())), static_cast<int>(t));
    }
    tree_ = Tree(entries);
    for (const auto& edge : topology_.edges) { // worth drawing: rims and folds
      const auto& t = edge.triangles;
      if (t.size() != 2 || topology_.normals[t[0]].dot(topology_.normals[t[1]]) < 0.94)
        mesh_.edges.push_back(edge.ends);
    }
  }

  const MeshTopology& topology() const { return topology_; }

  int mostTouches() const override { return maxTouches; }

  void touches(const Vec3& x, double reach, Touches& out) const override {
    if (bounds_.squaredExteriorDistance(x) >= reach * reach) return;
    thread_local std::vector<TreeEntry> found;
    thread_local std::vector<Place> places;
    found.clear();
    places.clear();
    const Vec3 r = Vec3::Constant(reach);
    tree_.query(bg::index::intersects(TreeBox(treePoint(x - r), treePoint(x + r))),
                std::back_inserter(found));
    for (const auto& [box, triangle] : found)
      if (const Place p = nearest(triangle, x); p.distance < reach && p.distance > 0.0) places.push_back(p);
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return std::tie(a.distance, a.feature, a.triangle) < std::tie(b.distance, b.feature, b.triangle);
    });
    const int before = out.count;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& p = places[i];
      if (covered(p, places, i)) continue;
      const Vec3 normal = (x - p.point) / p.distance;
      const bool known =
          std::any_of(out.at.begin() + before, out.at.begin() + out.count, [&](const WallTouch& t) {
            return t.normal.dot(normal) >= smooth_ ||
                   (x - t.distance * t.normal - p.point).squaredNorm() < 1e-18 * reach * reach;
          });
      if (!known) out.add({p.distance, normal, p.feature});
    }
    std::sort(out.at.begin() + before, out.at.begin() + out.count,
              [](const WallTouch& a, const WallTouch& b) { return a.feature < b.feature; });
  }

  double signedDistance(const Vec3& x) const override {
    Place best;
    best.distance = std::numeric_limits<double>::infinity();
    const auto all = static_cast<unsigned>(mesh_.triangles.size());
    for (auto it = tree_.qbegin(bg::index::nearest(treePoint(x), all)); it != tree_.qend(); ++it) {
      if (bg::distance(treePoint(x), it->first) > best.distance) break; // boxes come in order of distance
      const Place p = nearest(it->second, x);
      if (p.distance < best.distance) best = p;
    }
    if (side_ == Side::both) return best.distance;
    const bool outside = (x - best.point).dot(pseudoNormal(best)) >= 0.0;
    return outside == (side_ == Side::outside) ? best.distance : -best.distance;
  }

  Eigen::AlignedBox3d bounds() const override { return bounds_; }
  TriangleMesh mesh(const Eigen::AlignedBox3d&) const override { return mesh_; }

private:
  using Tree = bg::index::rtree<TreeEntry, bg::index::quadratic<16>>;

  /// The point of one triangle that is nearest to a grain. Features: triangles, then edges, then corners.
  struct Place {
    double distance = 0;
    Vec3 point = Vec3::Zero();
    int triangle = 0, feature = 0;
  };
  int edgeFeature(int edge) const { return static_cast<int>(mesh_.triangles.size()) + edge; }
  int cornerFeature(int corner) const {
    return static_cast<int>(mesh_.triangles.size() + topology_.edges.size()) + corner;
  }

  Place nearest(int triangle, const Vec3& x) const {
    const auto& corner = mesh_.triangles[triangle];
    const Vec3& n = topology_.normals[triangle];
    // Inside all three edges: the foot of the perpendicular.
    bool inside = true;
    for (int k = 0; k < 3 && inside; ++k) {
      const Vec3 &a = mesh_.points[corner[k]], &b = mesh_.points[corner[(k + 1) % 3]];
      inside = (b - a).cross(x - a).dot(n) > 0.0;
    }
    if (inside) {
      const double h = (x - mesh_.points[corner[0]]).dot(n);
      return {std::abs(h), x - h * n, triangle, triangle};
    }
    Place best;
    best.distance = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const int edge = topology_.edgesOf[triangle][k];
      const auto [i, j] = topology_.edges[edge].ends; // the same numbers for both triangles of an edge
      const Vec3 &a = mesh_.points[i], &b = mesh_.points[j];
      const Vec3 along = b - a;
      const double t = (x - a).dot(along) / along.squaredNorm();
      const Vec3 point = t <= 0.0 ? a : t >= 1.0 ? b : Vec3(a + t * along);
      const double distance = (x - point).norm();
      if (distance < best.distance)
        best = {distance, point, triangle,
                t <= 0.0   ? cornerFeature(i)
                : t >= 1.0 ? cornerFeature(j)
                           : edgeFeature(edge)};
    }
    return best;
  }

  /// Triangles that an edge or corner belongs to; null for the inside of a triangle.
  const std::vector<int>* owners(int feature) const {
    const int triangles = static_cast<int>(mesh_.triangles.size());
    if (feature < triangles) return nullptr;
    if (feature < cornerFeature(0)) return &topology_.edges[feature - triangles].triangles;
    return &topology_.around[feature - cornerFeature(0)];
  }

  /// Whether a triangle at this edge or corner comes nearer, by more than round-off. Only places before i are
  /// nearer.
  bool covered(const Place& p, const std::vector<Place>& places, std::size_t i) const {
    const std::vector<int>* all = owners(p.feature);
    if (!all) return false;
    for (std::size_t k = 0; k < i; ++k)
      if (places[k].distance < p.distance * (1.0 - 1e-12) &&
          std::find(all->begin(), all->end(), places[k].triangle) != all->end())
        return true;
    return false;
  }

  /// Whose side tells inside from outside for a closed mesh (Baerentzen, Aanaes 2005): triangles at a corner
  /// count by their angle there.
  Vec3 pseudoNormal(const Place& p) const {
    const std::vector<int>* all = owners(p.feature);
    if (!all) return topology_.normals[p.triangle];
    Vec3 sum = Vec3::Zero();
    const int corner = p.feature - cornerFeature(0);
    for (const int t : *all) {
      double weight = 1.0;
      if (corner >= 0) {
        const auto& c = mesh_.triangles[t];
        const auto k = static_cast<int>(std::find(c.begin(), c.end(), corner) - c.begin());
        const Vec3 u = mesh_.points[c[(k + 1) % 3]] - mesh_.points[corner],
                   v = mesh_.points[c[(k + 2) % 3]] - mesh_.points[corner];
        weight = std::acos(std::clamp(u.dot(v) / (u.norm() * v.norm()), -1.0, 1.0));
      }
      sum += weight * topology_.normals[t];
    }
    return sum;
  }

  TriangleMesh mesh_;
  MeshTopology topology_;
  Side side_;
  double smooth_; ///< cosine
  Eigen::AlignedBox3d bounds_;
  Tree tree_;
};

/// Points and corners of a scene that carries its triangles.
TriangleMesh meshOf(const Parameters& p) {
  TriangleMesh mesh;
  mesh.points = p.vectors("points");
  const std::vector<double>& corners = p.numbers("corners");
  if (corners.empty() || corners.size() % 3 != 0)
    throw InputError(
        fmt::format("corners has {} numbers, but three are due for each triangle", corners.size()));
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    std::array<int, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double index = corners[k + c];
      if (!(index >= 0 && index < static_cast<double>(mesh.points.size())) || index != std::floor(index))
        throw InputError(
            fmt::format("corner {} is {}, but it must be a whole number from 0 to {}, which counts points",
                        k + c + 1, index, mesh.points.size() - 1));
      triangle[c] = static_cast<int>(index);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::shared_ptr<const WallShape> makeMesh(const Parameters& given) {
  const Parameters p = given.has("file") ? meshFromFile(given, ".") : given;
  if (!p.has("points") || !p.has("corners"))
    throw InputError("there are no triangles; give file = \"NAME.stl\", or points and corners");
  TriangleMesh mesh = meshOf(p);
  // Triangles that are lines have no normal, and touch nothing that their neighbours do not.
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    const Vec3 u = mesh.points[t[1]] - mesh.points[t[0]], v = mesh.points[t[2]] - mesh.points[t[0]];
    return !(u.cross(v).norm() > 1e-12 * std::max(u.squaredNorm(), v.squaredNorm()));
  });
  if (mesh.triangles.empty()) throw InputError("all triangles have an area of zero");
  const std::string& grains = p.text("grains");
  const Side side = grains == "inside" ? Side::inside : grains == "outside" ? Side::outside : Side::both;
  auto wall = std::make_shared<MeshWall>(std::move(mesh), side, p.number("smooth_angle"));
  if ((p.boolean("closed") || side != Side::both) && !wall->topology().closed()) {
    const auto& edges = wall->topology().edges;
    const auto bad = std::find_if(edges.begin(), edges.end(), [](const auto& e) { return !e.consistent; });
    throw InputError(
        fmt::format("the mesh is not closed: {} of its {} edges do not join two triangles that agree about "
                    "the outside, the "
                    "first runs between points {} and {}; mend the mesh, or leave out closed and grains",
                    std::count_if(edges.begin(), edges.end(), [](const auto& e) { return !e.consistent; }),
                    edges.size(), bad->ends[0], bad->ends[1]));
  }
  return wall;
}

} // namespace

WallKind meshWallKind() {
  using enum ParameterType;
  return {
      "mesh",
      "triangles from a file; grains on both sides unless told otherwise",
      {{.name = "file",
        .type = text,
        .unit = "1",
        .description = "STL, text or binary, beside the scene; its triangles become points and corners",
        .optional = true},
       fileScale(),
       fileShift(),
       {.name = "points", .type = vectors, .unit = "m", .description = "instead of a file", .optional = true},
       {.name = "corners",
        .type = numbers,
        .unit = "1",
        .description = "instead of a file: three numbers of points (from 0) for each triangle",
        .optional = true},
       {.name = "closed",
        .type = boolean,
        .unit = "1",
        .description = "refuse the mesh unless it is watertight",
        .fallback = false},
       {.name = "grains",
        .type = text,
        .unit = "1",
        .description =
            "the side on which fillings may put grains; inside and outside need a closed mesh whose "
            "corners run right-handed about the outward normal",
        .fallback = std::string("both"),
        .choices = {"both", "inside", "outside"}},
       {.name = "smooth_angle",
        .type = number,
        .unit = "rad",
        .description =
            "places that a grain touches at once count as one when their normals differ by less: facets "
            "of a curved surface",
        .fallback = std::numbers::pi / 18,
        .minimum = 0,
        .maximum = 1.5}},
      makeMesh};
}

} // namespace sandglass
