// A slot hopper: two mirrored cross-sections, endless along the slot.

#include "sim/base/error.h"
#include "sim/walls/profile.h"
#include "sim/walls/wall_kinds.h"

#include <cmath>
#include <limits>

namespace sandglass {

namespace {

class WedgeWall final : public WallShape {
public:
  WedgeWall(const Vec3& centre, const Vec3& up, const Vec3& along, Profile right)
      : centre_(centre), up_(up.normalized()), along_((along - along.dot(up_) * up_).normalized()),
        across_(up_.cross(along_)), profile_(std::move(right)) {}

  void touches(const Vec3& x, double reach, Touches& out) const override {
    const Vec3 d = x - centre_;
    const double a = d.dot(across_), h = d.dot(up_);
    for (int side : {1, -1})
      profile_.touches({side * a, h}, reach, [&](const Profile::Touch& t) {
        out.add({t.distance, side * t.normal.x() * across_ + t.normal.y() * up_,
                 t.feature + (side < 0 ? profile_.features() : 0)});
      });
  }

  double signedDistance(const Vec3& x) const override {
    const Vec3 d = x - centre_;
    const Vec2 p{std::abs(d.dot(across_)), d.dot(up_)};
    double width = 0.0;
    const double distance = profile_.distance(p);
    return profile_.widthAt(p.y(), width) && p.x() > width ? -distance : distance;
  }

  Eigen::AlignedBox3d bounds() const override {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Eigen::AlignedBox3d box;
    for (const Vec2& p : profile_.points())
      for (int side : {1, -1})
        box.extend(centre_ + side * p.x() * across_ + p.y() * up_);
    for (int k = 0; k < 3; ++k)
      if (std::abs(along_[k]) > 1e-12) {
        box.min()[k] = -inf;
        box.max()[k] = inf;
      }
    return box;
  }

  TriangleMesh mesh(const Eigen::AlignedBox3d& clip) const override {
    // From where the slot enters the box to where it leaves it.
    double from = std::numeric_limits<double>::infinity(), to = -from;
    for (int corner = 0; corner < 8; ++corner) {
      const double s =
          (clip.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - centre_).dot(along_);
      from = std::min(from, s);
      to = std::max(to, s);
    }
    TriangleMesh mesh;
    for (int side : {1, -1}) {
      const int first = static_cast<int>(mesh.points.size());
      const auto& points = profile_.points();
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 p = centre_ + side * points[k].x() * across_ + points[k].y() * up_;
        const int here = first + 2 * static_cast<int>(k);
        mesh.points.push_back(p + from * along_);
        mesh.points.push_back(p + to * along_);
        mesh.edges.push_back({here, here + 1});
        if (k + 1 == points.size()) continue;
        mesh.triangles.push_back({here, here + 1, here + 2});
        mesh.triangles.push_back({here + 1, here + 3, here + 2});
        mesh.edges.push_back({here, here + 2});
        mesh.edges.push_back({here + 1, here + 3});
      }
    }
    return mesh;
  }

private:
  Vec3 centre_, up_, along_, across_;
  Profile profile_;
};

ParameterSpec length(const char* name, const char* description) {
  return {name, ParameterType::number, "m", description, {}, false, 0.0, 1e30, true};
}

} // namespace

WallKind wedgeWallKind() {
  return {"wedge",
          "a slot hopper: upright bin walls, sloped or flat bottom, outlet slot, lip; endless along the slot",
          {{"centre", ParameterType::vector, "m", "middle of the outlet", ParameterValue(Vec3(0, 0, 0))},
           {"up", ParameterType::vector, "1", "upright direction", ParameterValue(Vec3(0, 1, 0))},
           {"along", ParameterType::vector, "1", "direction of the slot", ParameterValue(Vec3(0, 0, 1))},
           length("outlet", "width of the slot"),
           length("width", "of the bin"),
           {"half_angle",
            ParameterType::number,
            "rad",
            "of the bottom, from the vertical; 90 deg is a flat floor",
            {},
            false,
            0.0,
            1.5708,
            true},
           length("height", "of the bin above the outlet"),
           {"lip", ParameterType::number, "m", "height of the short walls below the outlet",
            ParameterValue(0.0), false, 0.0}},
          [](const Parameters& p) {
            if (p.vector("up").cross(p.vector("along")).norm() == 0.0)
              throw InputError("up and along must not be zero or parallel");
            return std::make_shared<WedgeWall>(p.vector("centre"), p.vector("up"), p.vector("along"),
                                               hopperProfile(0.5 * p.number("outlet"),
                                                             0.5 * p.number("width"), p.number("half_angle"),
                                                             p.number("height"), p.number("lip")));
          }};
}

} // namespace sandglass
