#pragma once
// A polyline in a plane: the cross-section that walls are extruded or revolved from.

#include "sim/walls/wall_shape.h"

#include <Eigen/Core>

#include <vector>

namespace sandglass {

using Vec2 = Eigen::Vector2d;

/// Nearest places of a polyline. A corner counts only where it is the nearest point of both segments that
/// meet there: where a face covers it, the face alone is reported, so nothing is counted twice.
class Profile {
public:
  struct Touch {
    double distance = 0; ///< > 0 [m]
    Vec2 normal = Vec2::Zero();
    int feature = 0; ///< 2k for point k, 2k+1 for the segment from point k to k+1
  };

  explicit Profile(std::vector<Vec2> points) : points_(std::move(points)) {}

  /// Calls visit(Touch) for each feature nearer than reach, in ascending order of feature.
  template <class Visit> void touches(const Vec2& x, double reach, Visit&& visit) const {
    const int segments = static_cast<int>(points_.size()) - 1;
    bool previousPastEnd = true; // the segment before point k has its nearest point in point k
    for (int k = 0; k < segments; ++k) {
      const Vec2 along = points_[k + 1] - points_[k], toX = x - points_[k];
      const double length2 = along.squaredNorm(), t = toX.dot(along) / length2;
      if (t <= 0.0 && previousPastEnd) report(toX, 2 * k, reach, visit);
      if (t > 0.0 && t < 1.0) report(toX - t * along, 2 * k + 1, reach, visit);
      previousPastEnd = t >= 1.0;
    }
    if (previousPastEnd) report(x - points_[segments], 2 * segments, reach, visit);
  }

  /// Distance to the nearest point, never negative [m].
  double distance(const Vec2& x) const;

  /// First coordinate of the polyline at height y, walking from its first point; false outside its heights.
  bool widthAt(double y, double& width) const;

  const std::vector<Vec2>& points() const { return points_; }
  int features() const { return 2 * static_cast<int>(points_.size()); }

private:
  template <class Visit> static void report(const Vec2& away, int feature, double reach, Visit&& visit) {
    const double d2 = away.squaredNorm();
    if (d2 >= reach * reach || d2 == 0.0) return;
    const double d = std::sqrt(d2);
    visit(Touch{d, away / d, feature});
  }

  std::vector<Vec2> points_;
};

/// Right half of a hopper's cross-section: bin wall, sloped or flat bottom, lip below the outlet plane.
/// Coordinates: (distance from the axis, height above the outlet plane). Throws InputError (a phrase) when
/// the sizes contradict each other. Lengths in m, half angle from the vertical in rad, at most pi/2.
Profile hopperProfile(double outletHalfWidth, double binHalfWidth, double halfAngle, double height,
                      double lip);

} // namespace sandglass
