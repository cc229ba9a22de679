#include "sim/grains/fill_region.h"

#include <cmath>
#include <numbers>

namespace sandglass {

FillRegion::FillRegion(const Parameters& p, const Domain& domain) {
  const std::string region = p.has("region") ? p.text("region") : "box";
  cylinder_ = region == "cylinder";
  if (cylinder_) {
    base_ = p.vector("base");
    axis_ = p.vector("axis").normalized();
    across_ = axis_.unitOrthogonal();
    along_ = axis_.cross(across_);
    radius_ = p.number("radius");
    height_ = p.number("height");
    return;
  }
  lower_ = region == "box" ? p.vector("lower") : domain.lower;
  upper_ = region == "box" ? p.vector("upper") : domain.upper;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double period = domain.upper[k] - domain.lower[k];
    wholePeriod_[axis] = domain.periodic[axis] && upper_[k] - lower_[k] >= period * (1 - 1e-12);
  }
}

double FillRegion::volume() const {
  return cylinder_ ? std::numbers::pi * radius_ * radius_ * height_ : (upper_ - lower_).prod();
}

bool FillRegion::holds(double radius) const {
  if (cylinder_) return radius_ >= radius && height_ >= 2 * radius;
  for (int k = 0; k < 3; ++k)
    if (!wholePeriod_[static_cast<std::size_t>(k)] && upper_[k] - lower_[k] < 2 * radius) return false;
  return true;
}

Vec3 FillRegion::centre(const Vec3& unit, double radius) const {
  if (cylinder_) {
    const double rho = (radius_ - radius) * std::sqrt(unit.x()), phi = 2 * std::numbers::pi * unit.y();
    const double h = std::lerp(radius, height_ - radius, unit.z());
    return base_ + h * axis_ + rho * (std::cos(phi) * across_ + std::sin(phi) * along_);
  }
  Vec3 point;
  for (int k = 0; k < 3; ++k) {
    const double margin = wholePeriod_[static_cast<std::size_t>(k)] ? 0 : radius;
    point[k] = std::lerp(lower_[k] + margin, upper_[k] - margin, unit[k]);
  }
  return point;
}

} // namespace sandglass
