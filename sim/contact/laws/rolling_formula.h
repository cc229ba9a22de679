#pragma once
// Couples against rolling; elastic_plastic_rolling.cpp and constant_torque_rolling.cpp have the papers.

#include "sim/contact/laws/friction_limit.h"
#include "sim/contact/laws/linear_formula.h"
#include "sim/contact/laws/vector3.h"

namespace sandglass {

template <class Real> struct RollingConstants {
  Real length = 0, coefficient = 0; ///< largest couple over load: a length [m], a share of the radius
  Real damping = 0;                 ///< share of critical damping
};

/// A pair as far as its rolling goes.
template <class V> struct RollingPair {
  Vector3<V> spin; ///< [rad/s] of a minus that of b, less its part along the normal
  V radius;        ///< [m] effective
  V inverse;       ///< [1/(kg m^2)] sum of 1/(m r^2)
};

/// A grain's share of RollingPair::inverse, from 1/r and 1/m.
template <class V> SANDGLASS_LOOP V rollingInverse(V inverseRadius, V inverseMass) {
  return inverseRadius * (inverseRadius * inverseMass);
}

template <class A, class V>
SANDGLASS_LOOP Vector3<V> acrossNormal(const Vector3<V>& n, const Vector3<V>& spin) {
  return minus<A>(spin, dot<A>(spin, n), n);
}

/// Moves the rolling angle on by a step; returns the couple on a. Without touch neither couple nor angle.
template <class A, class Constant, class Real, class V>
SANDGLASS_LOOP Vector3<V> elasticPlasticCouple(const RollingConstants<Constant>& c, const Vector3<V>& n,
                                               const RollingPair<V>& pair, V overlap, V load, V stiffness,
                                               Real dt, Vector3<V>& angle) {
  const V zero = A::template all<V>(0);
  const V length = c.length + c.coefficient * pair.radius;
  const V k = A::template all<V>(2.25) * stiffness * length * length, limit = length * load;
  Vector3<V> turned = plus<A>(acrossNormal<A>(n, angle), A::template all<V>(dt), pair.spin);
  // Moment of inertia of the pair about the contact: 1/I = sum of 1/(7/5 m r^2).
  const V dashpot = 2 * c.damping * A::root(A::over(A::template all<V>(1.4) * k, pair.inverse));
  const auto touches = A::above(overlap, zero);
  const Vector3<V> couple = withinLimit<A, true>(touches, limit, k, dashpot, pair.spin, turned);
  angle = where<A>(touches, turned);
  return where<A>(touches, couple);
}

/// The couple on a; `most`: what stops a spin of 1/s, times the sum of 1/(m r^2) [1/s].
template <class A, class Constant, class Real, class V>
SANDGLASS_LOOP Vector3<V> constantCouple(const RollingConstants<Constant>& c, const RollingPair<V>& pair,
                                         V overlap, V load, Real most) {
  const V zero = A::template all<V>(0);
  const V limit = (c.length + c.coefficient * pair.radius) * load, spin2 = dot<A>(pair.spin, pair.spin);
  const auto touches = A::above(overlap, zero), rolls = A::above(spin2, zero);
  V size;
  const V free = A::pick(rolls, A::overRoot(limit, spin2, size, A::both(touches, rolls)), zero);
  const V cap = A::over(A::template all<V>(most), pair.inverse);
  const V factor = A::pick(A::above(free, cap), cap, free);
  return where<A>(touches, times(-factor, pair.spin));
}

/// `most` of a step: a sixth of what stops the pair, 1/I = sum of 1/(2/5 m r^2), within it. No cap without a
/// step.
template <class Real> SANDGLASS_LOOP Real coupleCap(Real dt) {
  return dt > 0 ? Real(1.0 / 15.0) / dt : Real(__builtin_inf());
}

} // namespace sandglass
