#include "sim/walls/profile.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass {

double Profile::distance(const Vec2& x) const {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    const Vec2 along = points_[k + 1] - points_[k], toX = x - points_[k];
    const double t = std::clamp(toX.dot(along) / along.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (toX - t * along).norm());
  }
  return best;
}

bool Profile::widthAt(double y, double& width) const {
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    const Vec2 &a = points_[k], &b = points_[k + 1];
    if (a.y() == b.y() || y < std::min(a.y(), b.y()) || y > std::max(a.y(), b.y())) continue;
    width = a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
    return true;
  }
  return false;
}

Profile hopperProfile(double outletHalfWidth, double binHalfWidth, double halfAngle, double height,
                      double lip) {
  if (outletHalfWidth >= binHalfWidth)
    throw InputError(fmt::format("the outlet ({:g} m) must be narrower than the bin ({:g} m)",
                                 2 * outletHalfWidth, 2 * binHalfWidth));
  const bool flat = halfAngle > 0.5 * std::numbers::pi - 1e-9; // tan() is of no use there
  const double shoulder = flat ? 0.0 : (binHalfWidth - outletHalfWidth) / std::tan(halfAngle);
  if (shoulder >= height)
    throw InputError(
        fmt::format("the sloped part ({:g} m high at this half angle) must end below the height of the "
                    "bin ({:g} m); raise height or half_angle",
                    shoulder, height));
  std::vector<Vec2> points{{binHalfWidth, height}, {binHalfWidth, shoulder}, {outletHalfWidth, 0.0}};
  if (lip > 0.0) points.emplace_back(outletHalfWidth, -lip);
  return Profile(std::move(points));
}

} // namespace sandglass
