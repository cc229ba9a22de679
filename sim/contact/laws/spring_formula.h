#pragma once
// Tangential spring with history and Coulomb limit; spring_tangential.cpp has the paper.

#include "sim/contact/laws/friction_limit.h"
#include "sim/contact/laws/linear_formula.h"
#include "sim/contact/laws/vector3.h"

namespace sandglass {

template <class Real> struct SpringConstants {
  Real friction = 0, ratio = 0;
  Real damping = 0; ///< share of the normal dashpot
  Real rate = 0;    ///< [1/s] dashpot over reduced mass
  Real gamma = 0;   ///< [kg/s] rate times mass, where all pairs have one reduced mass
};

enum class Dashpot { none, coefficient, rate };

/// Moves the spring `s` on by a step under the slip velocity `v` at a contact with normal `n`; returns the
/// force on a. Without touch neither force nor spring.
template <class A, bool project, Dashpot dashpot, class Constant, class Real, class V>
SANDGLASS_LOOP Vector3<V> springForce(const SpringConstants<Constant>& c, const Vector3<V>& n,
                                      const Vector3<V>& v, V overlap, const NormalForce<V>& normal, V mass,
                                      Real dt, Vector3<V>& s) {
  const V zero = A::template all<V>(0), one = A::template all<V>(1);
  Vector3<V> turned = minus<A>(s, dot<A>(s, n), n);
  if constexpr (!project) {
    const V now2 = dot<A>(turned, turned);
    const V keep = A::pick(A::above(now2, zero), A::root(A::over(dot<A>(s, s), now2)), one);
    turned = times(keep, turned);
  }
  turned = plus<A>(turned, A::template all<V>(dt), v);
  const V kt = c.ratio * normal.stiffness;
  V gamma = zero;
  if constexpr (dashpot == Dashpot::rate) gamma = c.damping * normal.damping + c.rate * mass;
  if constexpr (dashpot == Dashpot::coefficient) gamma = c.damping * normal.damping + c.gamma;
  const auto touches = A::above(overlap, zero);
  const Vector3<V> f =
      withinLimit<A, dashpot != Dashpot::none>(touches, c.friction * normal.load, kt, gamma, v, turned);
  s = where<A>(touches, turned);
  return where<A>(touches, f);
}

} // namespace sandglass
