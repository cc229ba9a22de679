#pragma once
// What a spring and a dashpot side by side may carry at most: force against sliding, couple against rolling.

#include "sim/contact/laws/vector3.h"

namespace sandglass {

/// -k s - gamma v, at most `limit` large. Where it is more, the spring `s` keeps what the dashpot leaves it
/// of the limit (S. Luding, Granular Matter 10, 235 (2008)), and nothing where the dashpot alone goes beyond:
/// wound up the other way instead it would hold energy that nobody spent, and pull with the motion later.
/// `touches` masks the root.
template <class A, bool damped, class Mask, class V>
SANDGLASS_LOOP Vector3<V> withinLimit(Mask touches, V limit, V k, V gamma, const Vector3<V>& v,
                                      Vector3<V>& s) {
  const V zero = A::template all<V>(0), one = A::template all<V>(1);
  Vector3<V> f = times(-k, s);
  if constexpr (damped) f = minus<A>(f, gamma, v);
  const V f2 = dot<A>(f, f);
  const auto yields = A::above(f2, limit * limit);
  V size;
  const V scale = A::pick(yields, A::overRoot(limit, f2, size, A::both(touches, yields)), one);
  f = times(scale, f);
  if constexpr (!damped) {
    s = times(scale, s);
  } else {
    const V compliance = A::pick(A::above(k, zero), A::over(one, k), zero);
    const Vector3<V> ofSpring = plus<A>(f, gamma, v);
    const V carries = A::pick(A::above(dot<A>(ofSpring, f), zero), -compliance, zero);
    s = {A::pick(yields, carries * ofSpring.x, s.x), A::pick(yields, carries * ofSpring.y, s.y),
         A::pick(yields, carries * ofSpring.z, s.z)};
  }
  return f;
}

} // namespace sandglass
