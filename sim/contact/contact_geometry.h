#pragma once
// From the differences between two grains to their contact, and from forces there to what turns them: one
// text for single numbers and for registers.

#include "sim/contact/laws/vector3.h"

namespace sandglass {

/// Position of a minus that of b, sum of the radii, velocity of a minus that of b, sum of radius times spin.
template <class V> struct PairState {
  Vector3<V> apart;
  V radii;
  Vector3<V> motion, roll;
};

template <class V> struct ContactState {
  Vector3<V> n; ///< from b to a
  V overlap, vn;
  Vector3<V> slip;
  V arm; ///< contact arm over radius, the same for both grains
};

/// Unit normal and distance.
template <class A, class V> SANDGLASS_LOOP V inverseDistance(const Vector3<V>& apart, V& distance) {
  return A::overRoot(A::template all<V>(1), dot<A>(apart, apart), distance);
}

/// Slip is the tangential part of the motion minus (arm_a w_a + arm_b w_b) x n. Contact arms over radii add
/// up to the distance, so angular momentum is kept.
template <class A, bool turning, class V>
SANDGLASS_LOOP ContactState<V> contactState(const PairState<V>& pair, V distance, V inverse, bool radiusArm) {
  ContactState<V> c;
  c.n = times(inverse, pair.apart);
  c.overlap = pair.radii - distance;
  c.vn = dot<A>(pair.motion, c.n);
  c.slip = minus<A>(pair.motion, c.vn, c.n);
  c.arm = A::template all<V>(1);
  if constexpr (turning) {
    if (!radiusArm) c.arm = A::over(distance, pair.radii);
    c.slip = minusCross<A>(c.slip, times(c.arm, pair.roll), c.n);
  }
  return c;
}

/// The torque on a grain is -arm (n x f_t); divided by its own radius it is the same for both.
template <class A, class V>
SANDGLASS_LOOP Vector3<V> contactTorque(const Vector3<V>& n, V arm, const Vector3<V>& tangential) {
  return times(arm, cross<A>(tangential, n));
}

} // namespace sandglass
