#pragma once
// F = k overlap - gamma v_n, with a floor under attraction.

#include "sim/contact/laws/arithmetic.h"

#include <type_traits>

namespace sandglass {

/// What a normal law gives the others: its force, the part that loads the contact, its stiffness and damping.
template <class V> struct NormalForce { V force, load, stiffness, damping; };

template <class Real> struct LinearConstants {
  Real k = 0, zeta = 0, rate = 0, floor = 0; ///< floor [N]: the most attractive force allowed
  Real gamma = 0;                            ///< [kg/s] where all pairs have one reduced mass
};

/// gamma = 2 zeta sqrt(k m) + rate m.
template <class A, class Real, class V>
SANDGLASS_LOOP V linearDamping(const LinearConstants<Real>& c, V mass) {
  if constexpr (std::is_floating_point_v<Real>) // the same bits without the root
    if (c.zeta == 0) return c.rate * mass;
  return A::fma(A::template all<V>(2 * c.zeta), A::root(c.k * mass), c.rate * mass);
}

template <class A, class Real, class V>
SANDGLASS_LOOP NormalForce<V> linearForce(const LinearConstants<Real>& c, V gamma, V overlap, V vn) {
  const V zero = A::template all<V>(0);
  V force = A::larger(A::fnma(gamma, vn, c.k * overlap), A::template all<V>(c.floor));
  force = A::pick(A::above(overlap, zero), force, zero);
  return {force, A::larger(force, zero), A::template all<V>(c.k), gamma};
}

} // namespace sandglass
