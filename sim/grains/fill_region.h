#pragma once
// The space that a filling names: a box, a cylinder, or the whole domain.

#include "sim/frame/frame.h"
#include "sim/scene/parameters.h"

namespace sandglass {

class FillRegion {
public:
  /// From the parameters `region`, lower, upper, base, axis, radius, height (box when `region` is absent).
  FillRegion(const Parameters& parameters, const Domain& domain);

  double volume() const; ///< [m^3]

  /// Whether a sphere fits inside at all. Along a periodic axis that the region spans, any sphere does.
  bool holds(double radius) const;

  /// Maps the unit cube evenly onto the places where a sphere of that radius lies inside (0: on the region).
  Vec3 centre(const Vec3& unit, double radius) const;

private:
  bool cylinder_ = false;
  Vec3 lower_, upper_;
  std::array<bool, 3> wholePeriod_{false, false, false};
  Vec3 base_, axis_, across_, along_;
  double radius_ = 0, height_ = 0;
};

} // namespace sandglass
