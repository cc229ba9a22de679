// Walls of revolution: cylinder, cone, frustum and the conical hopper. The nearest point of such a surface
// lies in the half plane through the axis and the grain, so contact is a problem in (radius, height). The
// half plane opposite is asked too: near an apex a grain touches both sides.

#include "sim/base/error.h"
#include "sim/walls/distance_normal.h"
#include "sim/walls/profile.h"
#include "sim/walls/wall_kinds.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass {

namespace {

class RevolvedWall final : public WallShape {
public:
  RevolvedWall(const Vec3& base, const Vec3& axis, Profile profile, bool closedBelow, bool closedAbove)
      : base_(base), axis_(axis.normalized()), profile_(std::move(profile)), closedBelow_(closedBelow),
        closedAbove_(closedAbove) {
    for (const Vec2& p : profile_.points()) {
      lowest_ = std::min(lowest_, p.y());
      highest_ = std::max(highest_, p.y());
      widest_ = std::max(widest_, p.x());
    }
  }

  void touches(const Vec3& centre, double reach, Touches& out) const override {
    Vec3 radial;
    const Vec2 x = meridian(centre, radial);
    profile_.touches(x, reach, [&](const Profile::Touch& t) {
      out.add({t.distance, t.normal.x() * radial + t.normal.y() * axis_, t.feature});
    });
    if (x.x() >= reach) return; // the far side is out of reach
    profile_.touches({-x.x(), x.y()}, reach, [&](const Profile::Touch& t) {
      // A bottom disc was reported already, and so was all that meets on the axis: it has no far side.
      const bool onAxis = t.feature % 2 == 0 && profile_.points()[t.feature / 2].x() == 0.0;
      if (t.normal.x() < 0.0 && !onAxis)
        out.add({t.distance, -t.normal.x() * radial + t.normal.y() * axis_, profile_.features() + t.feature});
    });
  }

  double signedDistance(const Vec3& point) const override {
    Vec3 radial;
    const Vec2 x = meridian(point, radial);
    const double d = profile_.distance(x);
    if (x.y() < lowest_) return closedBelow_ ? -d : d;
    if (x.y() > highest_) return closedAbove_ ? -d : d;
    double width = 0.0;
    return profile_.widthAt(x.y(), width) && x.x() > width ? -d : d;
  }

  Eigen::AlignedBox3d bounds() const override {
    Eigen::AlignedBox3d box;
    for (double h : {lowest_, highest_})
      for (int k = 0; k < 3; ++k) {
        const double half = widest_ * std::sqrt(std::max(0.0, 1.0 - axis_[k] * axis_[k]));
        Vec3 a = base_ + h * axis_;
        Vec3 low = a, high = a;
        low[k] -= half;
        high[k] += half;
        box.extend(low);
        box.extend(high);
      }
    return box;
  }

  TriangleMesh mesh(const Eigen::AlignedBox3d&) const override {
    constexpr int around = 96;
    const Vec3 u = axis_.unitOrthogonal(), v = axis_.cross(u);
    const auto& points = profile_.points();
    TriangleMesh mesh;
    for (std::size_t k = 0; k < points.size(); ++k)
      for (int s = 0; s < around; ++s) {
        const double phi = 2.0 * std::numbers::pi * s / around;
        mesh.points.push_back(base_ + points[k].y() * axis_ +
                              points[k].x() * (std::cos(phi) * u + std::sin(phi) * v));
        const int here = static_cast<int>(k) * around + s,
                  next = static_cast<int>(k) * around + (s + 1) % around;
        if (points[k].x() > 0.0) mesh.edges.push_back({here, next});
        if (k + 1 < points.size()) {
          mesh.triangles.push_back({here, next, here + around});
          mesh.triangles.push_back({next, next + around, here + around});
        }
      }
    return mesh;
  }

private:
  Vec2 meridian(const Vec3& x, Vec3& radial) const {
    const Vec3 d = x - base_;
    const double h = d.dot(axis_);
    radial = d - h * axis_;
    const double rho = radial.norm();
    if (rho > 0.0)
      radial /= rho;
    else
      radial = axis_.unitOrthogonal();
    return {rho, h};
  }

  Vec3 base_, axis_;
  Profile profile_;
  bool closedBelow_, closedAbove_;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_, widest_ = 0.0;
};

const ParameterSpec axisSpec{"axis", ParameterType::vector, "1", "direction of the axis, upwards",
                             ParameterValue(Vec3(0, 0, 1))};
const ParameterSpec baseSpec{"base", ParameterType::vector, "m", "where the axis meets the lower rim"};
const ParameterSpec endsSpec{"ends",
                             ParameterType::text,
                             "1",
                             "which ends are closed by a disc",
                             ParameterValue(std::string("open")),
                             false,
                             0,
                             0,
                             false,
                             {"open", "bottom", "top", "both"}};

const ParameterSpec normalSpec{
    .name = "normal",
    .type = ParameterType::text,
    .unit = "1",
    .description =
        "direction of its push: a unit vector, or the way to the axis over the distance from the origin, "
        "as a program of 2012 had it",
    .optional = true,
    .choices = {"unit", "over_distance"}};

ParameterSpec length(const char* name, const char* description, bool zeroAllowed = false) {
  return {name, ParameterType::number, "m", description, {}, false, 0.0, 1e30, !zeroAllowed};
}

ParameterSpec halfAngle(double maximum) {
  return {"half_angle", ParameterType::number,
          "rad",        "of the sloped wall, from the axis",
          {},           false,
          0.0,          maximum,
          true};
}

std::shared_ptr<const WallShape> frustum(const Parameters& p, double lower, double upper, const Vec3& base,
                                         const std::string& ends) {
  if (p.vector("axis").norm() == 0.0) throw InputError("the axis must not be zero");
  const double height = p.number("height");
  const bool below = ends == "bottom" || ends == "both", above = ends == "top" || ends == "both";
  std::vector<Vec2> points;
  if (below && lower > 0.0) points.emplace_back(0.0, 0.0);
  points.emplace_back(lower, 0.0);
  points.emplace_back(upper, height);
  if (above && upper > 0.0) points.emplace_back(0.0, height);
  return std::make_shared<RevolvedWall>(base, p.vector("axis"), Profile(std::move(points)),
                                        below || lower == 0.0, above || upper == 0.0);
}

} // namespace

WallKind cylinderWallKind() {
  return {"cylinder",
          "a tube seen from inside, open or closed",
          {baseSpec, axisSpec, length("radius", "inner radius"), length("height", "along the axis"), endsSpec,
           normalSpec},
          [](const Parameters& p) {
            const auto wall =
                frustum(p, p.number("radius"), p.number("radius"), p.vector("base"), p.text("ends"));
            if (!p.has("normal") || p.text("normal") == "unit") return wall;
            if (p.text("ends") != "open")
              throw InputError("a normal over_distance is for a tube with open ends");
            return withDistanceNormal(wall, p.vector("base"), p.vector("axis"), p.number("radius"),
                                      p.number("height"));
          }};
}

WallKind coneWallKind() {
  return {"cone",
          "a cone seen from inside, opening along its axis",
          {{"apex", ParameterType::vector, "m", "its tip"},
           axisSpec,
           halfAngle(1.5707),
           length("height", "along the axis")},
          [](const Parameters& p) {
            return frustum(p, 0.0, p.number("height") * std::tan(p.number("half_angle")), p.vector("apex"),
                           "open");
          }};
}

WallKind frustumWallKind() {
  return {"frustum",
          "a truncated cone seen from inside",
          {baseSpec, axisSpec, length("lower_radius", "at the base", true),
           length("upper_radius", "at the other end", true), length("height", "along the axis"), endsSpec},
          [](const Parameters& p) {
            if (p.number("lower_radius") + p.number("upper_radius") == 0.0)
              throw InputError("lower_radius and upper_radius must not both be zero");
            return frustum(p, p.number("lower_radius"), p.number("upper_radius"), p.vector("base"),
                           p.text("ends"));
          }};
}

WallKind discWallKind() {
  return {"disc",
          "a flat circular plate, with a round hole in its middle if wanted; grains on both sides",
          {{"centre", ParameterType::vector, "m", "its middle"},
           {"normal", ParameterType::vector, "1", "square to the plate", ParameterValue(Vec3(0, 0, 1))},
           length("radius", "of the plate"),
           {"hole", ParameterType::number, "m", "radius of the hole", ParameterValue(0.0), false, 0.0}},
          [](const Parameters& p) {
            if (p.vector("normal").norm() == 0.0) throw InputError("the normal must not be zero");
            const double hole = p.number("hole"), radius = p.number("radius");
            if (hole >= radius)
              throw InputError(
                  fmt::format("the hole ({:g} m) must be smaller than the plate ({:g} m)", hole, radius));
            return std::make_shared<RevolvedWall>(p.vector("centre"), p.vector("normal"),
                                                  Profile({{hole, 0.0}, {radius, 0.0}}), false, false);
          }};
}

WallKind coneHopperWallKind() {
  return {"cone_hopper",
          "a round bin on a cone (or a flat bottom) with a circular outlet",
          {{"base", ParameterType::vector, "m", "middle of the outlet"},
           axisSpec,
           length("outlet", "diameter of the outlet"),
           length("width", "diameter of the bin"),
           halfAngle(1.5708),
           length("height", "of the bin above the outlet"),
           {"lip", ParameterType::number, "m", "height of the short tube below the outlet",
            ParameterValue(0.0), false, 0.0}},
          [](const Parameters& p) {
            if (p.vector("axis").norm() == 0.0) throw InputError("the axis must not be zero");
            return std::make_shared<RevolvedWall>(
                p.vector("base"), p.vector("axis"),
                hopperProfile(0.5 * p.number("outlet"), 0.5 * p.number("width"), p.number("half_angle"),
                              p.number("height"), p.number("lip")),
                false, false);
          }};
}

} // namespace sandglass
