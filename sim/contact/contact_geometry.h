#pragma once
// From the differences between two grains to their contact, and from forces there to what turns them: one
// text for single numbers and for registers.

#include "sim/contact/laws/vector3.h"

namespace sandglass {

/// Unit normal from b to a is apart times the inverse distance.
template <class A, class V> SANDGLASS_LOOP V inverseDistance(const Vector3<V>& apart, V& distance) {
  return A::overRoot(A::template all<V>(1), dot<A>(apart, apart), distance);
}

template <class V> struct ContactMotion {
  V vn;
  Vector3<V> slip;
};

/// `motion`: velocity of a minus that of b, `roll`: sum of radius times spin, `arm`: contact arm over radius,
/// the same for both grains. Slip is the tangential part of the motion minus (arm_a w_a + arm_b w_b) x n.
template <class A, bool turning, class V>
SANDGLASS_LOOP ContactMotion<V> contactMotion(const Vector3<V>& n, const Vector3<V>& motion,
                                              const Vector3<V>& roll, V arm) {
  const V vn = dot<A>(motion, n);
  Vector3<V> slip = minus<A>(motion, vn, n);
  if constexpr (turning) slip = minusCross<A>(slip, times(arm, roll), n);
  return {vn, slip};
}

/// The torque on a grain is -arm (n x f_t); divided by its own radius it is the same for both.
template <class A, class V>
SANDGLASS_LOOP Vector3<V> contactTorque(const Vector3<V>& n, V arm, const Vector3<V>& tangential) {
  return times(arm, cross<A>(tangential, n));
}

} // namespace sandglass
