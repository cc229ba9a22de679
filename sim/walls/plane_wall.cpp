// An endless plane; grains on the side its normal points to.

#include "sim/base/error.h"
#include "sim/walls/wall_kinds.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

class PlaneWall final : public WallShape {
public:
  PlaneWall(const Vec3& point, const Vec3& normal) : point_(point), normal_(normal.normalized()) {}

  void touches(const Vec3& centre, double reach, Touches& out) const override {
    const double d = (centre - point_).dot(normal_);
    if (d < reach) out.add({d, normal_, 0});
  }

  bool pushesBack() const override { return true; }
  double signedDistance(const Vec3& x) const override { return (x - point_).dot(normal_); }

  Eigen::AlignedBox3d bounds() const override {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Eigen::AlignedBox3d box(Vec3::Constant(-inf), Vec3::Constant(inf));
    for (int k = 0; k < 3; ++k) // an axis-aligned plane is thin along its normal
      if (std::abs(normal_[k]) == 1.0) box.min()[k] = box.max()[k] = point_[k];
    return box;
  }

  TriangleMesh mesh(const Eigen::AlignedBox3d& clip) const override {
    // Corners of the polygon that the plane cuts from the box: its crossings with the twelve edges, by angle.
    TriangleMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
      for (int corner = 0; corner < 4; ++corner) {
        Vec3 a = clip.min();
        if (corner & 1) a[(axis + 1) % 3] = clip.max()[(axis + 1) % 3];
        if (corner & 2) a[(axis + 2) % 3] = clip.max()[(axis + 2) % 3];
        if (normal_[axis] == 0.0) continue;
        const double t = a[axis] - (a - point_).dot(normal_) / normal_[axis];
        if (t < clip.min()[axis] || t > clip.max()[axis]) continue;
        a[axis] = t;
        const bool known = std::any_of(mesh.points.begin(), mesh.points.end(), [&](const Vec3& p) {
          return (p - a).norm() < 1e-9 * clip.diagonal().norm();
        });
        if (!known) mesh.points.push_back(a);
      }
    if (mesh.points.size() < 3) return {};
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : mesh.points)
      centre += p / static_cast<double>(mesh.points.size());
    const Vec3 u = normal_.unitOrthogonal(), v = normal_.cross(u);
    const auto angle = [&](const Vec3& p) { return std::atan2((p - centre).dot(v), (p - centre).dot(u)); };
    std::sort(mesh.points.begin(), mesh.points.end(),
              [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
    const int n = static_cast<int>(mesh.points.size());
    for (int k = 1; k + 1 < n; ++k)
      mesh.triangles.push_back({0, k, k + 1});
    for (int k = 0; k < n; ++k)
      mesh.edges.push_back({k, (k + 1) % n});
    return mesh;
  }

private:
  Vec3 point_, normal_;
};

} // namespace

WallKind planeWallKind() {
  return {"plane",
          "an endless plane",
          {{"point", ParameterType::vector, "m", "any point of the plane"},
           {"normal", ParameterType::vector, "1", "points to the side of the grains"}},
          [](const Parameters& p) {
            if (p.vector("normal").norm() == 0.0) throw InputError("the normal of a plane must not be zero");
            return std::make_shared<PlaneWall>(p.vector("point"), p.vector("normal"));
          }};
}

} // namespace sandglass
