// A cone whose axis leans: every level section is a circle, but the centres of the circles shift with height.
// With an upright bin on top and an upright chute below it is the hopper with an outlet off its axis.
//
// The wall is a stack of rings (height, centre, radius), straight between neighbours. On the circle at the
// share s of the way from one ring to the next, the point nearest to a grain lies on the line from the
// circle's centre through the grain, so the squared distance is
//   f(s) = (z(s) - h)^2 + (rho(s) - r(s))^2,   rho(s) = |p - c(s)|,
// with z, c, r linear in s: a problem in one variable. Contacts are its local minima. A second one, on the
// opposite side of the circle (rho + r in place of rho - r), matters where the cone is hardly wider than the
// grain.

#include "sim/base/error.h"
#include "sim/walls/wall_kinds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace sandglass {

namespace {

struct Ring {
  double height = 0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0;
};

/// The distance problem between two rings for a grain at (p, h); side is 1 for the near side of the circles
/// and -1 for the far side.
struct Section {
  const Ring &a, &b;
  Eigen::Vector2d p;
  double h, side;

  double height(double s) const { return a.height + s * (b.height - a.height); }
  double radius(double s) const { return a.radius + s * (b.radius - a.radius); }
  Eigen::Vector2d toGrain(double s) const { return p - (a.centre + s * (b.centre - a.centre)); }
  double gap(double s) const { return toGrain(s).norm() - side * radius(s); }

  /// f'/2
  double slope(double s) const {
    const Eigen::Vector2d d = toGrain(s);
    const double rho = d.norm();
    const double rhoSlope = rho > 0.0 ? -d.dot(b.centre - a.centre) / rho : 0.0;
    return (height(s) - h) * (b.height - a.height) +
           (rho - side * radius(s)) * (rhoSlope - side * (b.radius - a.radius));
  }

  /// Where the slope passes from negative to positive, by regula falsi with halving (Illinois); to round-off.
  double root(double low, double high, double atLow, double atHigh) const {
    for (int k = 0; k < 200; ++k) {
      double s = (low * atHigh - high * atLow) / (atHigh - atLow);
      if (!(s > low && s < high) || k % 8 == 7) s = 0.5 * (low + high);
      if (s == low || s == high) break;
      const double now = slope(s);
      if (now == 0.0) return s;
      if (now < 0.0) {
        low = s;
        atLow = now;
        atHigh *= 0.5;
      } else {
        high = s;
        atHigh = now;
        atLow *= 0.5;
      }
    }
    return std::abs(slope(low)) < std::abs(slope(high)) ? low : high;
  }
};

class ObliqueConeWall final : public WallShape {
public:
  ObliqueConeWall(const Vec3& base, const Vec3& axis, const Vec3& across, std::vector<Ring> rings)
      : base_(base), w_(axis), u_(across), v_(w_.cross(u_)), rings_(std::move(rings)) {}

  void touches(const Vec3& x, double reach, Touches& out) const override {
    visit(x, reach, 8, [&](const WallTouch& t) { out.add(t); });
  }

  double signedDistance(const Vec3& x) const override {
    double nearest = std::numeric_limits<double>::infinity();
    // Far grains see the whole wall: more pieces.
    visit(x, std::numeric_limits<double>::infinity(), 64,
          [&](const WallTouch& t) { nearest = std::min(nearest, t.distance); });
    const Vec3 d = x - base_;
    const double h = d.dot(w_);
    for (std::size_t k = 0; k + 1 < rings_.size(); ++k) {
      const Ring &a = rings_[k], &b = rings_[k + 1];
      if (h < a.height || h > b.height) continue;
      const Section section{a, b, {d.dot(u_), d.dot(v_)}, h, 1.0};
      if (section.gap((h - a.height) / (b.height - a.height)) > 0.0) return -nearest;
    }
    return nearest;
  }

  Eigen::AlignedBox3d bounds() const override {
    Eigen::AlignedBox3d box;
    for (const Ring& ring : rings_) {
      const Vec3 middle = at(ring, Eigen::Vector2d::Zero());
      for (int k = 0; k < 3; ++k) {
        Vec3 reach = Vec3::Zero();
        reach[k] = ring.radius * std::sqrt(std::max(0.0, 1.0 - w_[k] * w_[k]));
        box.extend(middle - reach);
        box.extend(middle + reach);
      }
    }
    return box;
  }

  TriangleMesh mesh(const Eigen::AlignedBox3d&) const override {
    constexpr int around = 96;
    TriangleMesh mesh;
    for (std::size_t k = 0; k < rings_.size(); ++k)
      for (int i = 0; i < around; ++i) {
        const double phi = 2.0 * std::numbers::pi * i / around;
        mesh.points.push_back(
            at(rings_[k], rings_[k].radius * Eigen::Vector2d(std::cos(phi), std::sin(phi))));
        const int here = static_cast<int>(k) * around + i,
                  next = static_cast<int>(k) * around + (i + 1) % around;
        if (rings_[k].radius > 0.0) mesh.edges.push_back({here, next});
        if (k + 1 == rings_.size()) continue;
        mesh.triangles.push_back({here, next, here + around});
        mesh.triangles.push_back({next, next + around, here + around});
      }
    return mesh;
  }

private:
  Vec3 at(const Ring& ring, const Eigen::Vector2d& fromCentre) const {
    const Eigen::Vector2d q = ring.centre + fromCentre;
    return base_ + ring.height * w_ + q.x() * u_ + q.y() * v_;
  }

  /// Local minima nearer than reach: within sections as 2 k + 1 (at most one per piece), on ring k as 2 k
  /// where neither neighbouring section comes nearer; on the far side numbered on.
  template <class Report> void visit(const Vec3& x, double reach, int pieces, Report&& report) const {
    const Vec3 d = x - base_;
    const Eigen::Vector2d p(d.dot(u_), d.dot(v_));
    const double h = d.dot(w_);
    for (const double side : {1.0, -1.0}) {
      const int numbered = side > 0.0 ? 0 : 2 * static_cast<int>(rings_.size());
      bool risesBefore = true; // towards the ring from the section below; f falls towards its upper end
      for (std::size_t k = 0; k + 1 < rings_.size(); ++k) {
        const Section section{rings_[k], rings_[k + 1], p, h, side};
        const double length = rings_[k + 1].height - rings_[k].height;
        const bool last = k + 2 == rings_.size();
        const double first = section.slope(0.0), final = section.slope(1.0);
        if (risesBefore && first >= 0.0)
          tell(section, 0.0, 2 * static_cast<int>(k) + numbered, reach, report);
        const double low = std::clamp((h - reach - rings_[k].height) / length, 0.0, 1.0);
        const double high = std::clamp((h + reach - rings_[k].height) / length, 0.0, 1.0);
        double s = low, slope = section.slope(low);
        for (int i = 1; i <= pieces && low < high; ++i) {
          const double next = i == pieces ? high : low + (high - low) * i / pieces;
          const double there = section.slope(next);
          if (slope < 0.0 && (there > 0.0 || (there == 0.0 && i < pieces)))
            tell(section, section.root(s, next, slope, there), 2 * static_cast<int>(k) + 1 + numbered, reach,
                 report);
          s = next;
          slope = there;
        }
        risesBefore = final <= 0.0;
        if (last && risesBefore) tell(section, 1.0, 2 * static_cast<int>(k) + 2 + numbered, reach, report);
      }
    }
  }

  template <class Report>
  void tell(const Section& section, double s, int feature, double reach, Report&& report) const {
    const Eigen::Vector2d d = section.toGrain(s);
    const double rho = d.norm(), r = section.radius(s);
    if (section.side < 0.0 && r == 0.0) return; // a tip has no far side
    const Eigen::Vector2d e = rho > 0.0 ? Eigen::Vector2d(d / rho) : Eigen::Vector2d::UnitX();
    const double up = section.h - section.height(s), out = rho - section.side * r;
    const double distance = std::hypot(up, out);
    if (distance >= reach || distance == 0.0) return;
    // From the wall's point to the grain. On the far side that is rho + r along e as well.
    report(WallTouch{distance, (up * w_ + out * (e.x() * u_ + e.y() * v_)) / distance, feature});
  }

  Vec3 base_, w_, u_, v_; ///< origin and axes: along the axis, two across
  std::vector<Ring> rings_;
};

ParameterSpec length(const char* name, const char* description, bool zeroAllowed = false) {
  return {name, ParameterType::number, "m", description, {}, false, 0.0, 1e30, !zeroAllowed};
}

} // namespace

WallKind obliqueConeWallKind() {
  ParameterSpec bin = length("bin", "height of the upright tube above the cone", true),
                chute = length("chute", "height of the upright tube below the cone", true);
  bin.fallback = chute.fallback = ParameterValue(0.0);
  return {
      "oblique_cone",
      "a cone with level circles whose axis leans, seen from inside, with a tube above and below if wanted",
      {{"base", ParameterType::vector, "m", "middle of the lower circle"},
       {"axis", ParameterType::vector, "1", "upright direction, square to the circles",
        ParameterValue(Vec3(0, 0, 1))},
       length("lower_radius", "of the lower circle", true),
       length("upper_radius", "of the upper circle", true),
       length("height", "from circle to circle"),
       {"offset", ParameterType::vector, "m",
        "of the upper circle's middle from the axis through the lower; what lies along the axis is left out"},
       bin,
       chute},
      [](const Parameters& p) {
        if (p.vector("axis").norm() == 0.0) throw InputError("the axis must not be zero");
        const double lower = p.number("lower_radius"), upper = p.number("upper_radius");
        if (lower + upper == 0.0) throw InputError("lower_radius and upper_radius must not both be zero");
        if (lower == 0.0 && p.number("chute") > 0.0)
          throw InputError("a chute needs a lower_radius above zero");
        if (upper == 0.0 && p.number("bin") > 0.0) throw InputError("a bin needs an upper_radius above zero");
        const Vec3 w = p.vector("axis").normalized();
        const Vec3 offset = p.vector("offset") - p.vector("offset").dot(w) * w;
        const Vec3 u = offset.norm() > 0.0 ? Vec3(offset.normalized()) : Vec3(w.unitOrthogonal());
        const Eigen::Vector2d shift(offset.norm(), 0.0);
        const double height = p.number("height");
        std::vector<Ring> rings;
        if (p.number("chute") > 0.0) rings.push_back({-p.number("chute"), Eigen::Vector2d::Zero(), lower});
        rings.push_back({0.0, Eigen::Vector2d::Zero(), lower});
        rings.push_back({height, shift, upper});
        if (p.number("bin") > 0.0) rings.push_back({height + p.number("bin"), shift, upper});
        return std::make_shared<ObliqueConeWall>(p.vector("base"), w, u, std::move(rings));
      }};
}

} // namespace sandglass
