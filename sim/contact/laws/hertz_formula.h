#pragma once
// Hertz contact with its dashpots; hertz_normal.cpp has the papers.

#include "sim/contact/laws/linear_formula.h"

namespace sandglass {

template <class Real> struct HertzConstants {
  Real modulus = 0;                   ///< E* [Pa]
  Real tsuji = 0, rate = 0, time = 0; ///< gamma over sqrt(S m), over S m [1/N], over S [s]
  Real floor = 0;                     ///< the most attractive force allowed [N]
};

/// S = 2 E* sqrt(R d),  F = 2/3 S d - gamma v_n.
template <class A, bool tsuji, bool masses, class Real, class V>
SANDGLASS_LOOP NormalForce<V> hertzForce(const HertzConstants<Real>& c, V overlap, V vn, V radius, V mass) {
  const V zero = A::template all<V>(0);
  const V x = A::larger(overlap, zero);
  const V S = 2 * c.modulus * A::root(radius * x);
  V gamma = c.time * S;
  if constexpr (masses) gamma += c.rate * (S * mass);
  if constexpr (tsuji) gamma += c.tsuji * A::root(S * mass);
  const V force =
      A::larger(A::fnma(gamma, vn, A::template all<V>(2.0 / 3.0) * S * x), A::template all<V>(c.floor));
  return {force, A::larger(force, zero), S, gamma};
}

} // namespace sandglass
