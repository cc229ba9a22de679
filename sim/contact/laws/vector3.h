#pragma once
// Vectors of numbers or registers in the arithmetic of the laws. Sums of products are rounded once a
// term (fused multiply-add), in all widths alike.

#include "sim/contact/laws/arithmetic.h"

namespace sandglass {

template <class V> struct Vector3 { V x, y, z; };

template <class A, class V> SANDGLASS_LOOP V dot(const Vector3<V>& a, const Vector3<V>& b) {
  return A::fma(a.x, b.x, A::fma(a.y, b.y, a.z * b.z));
}

/// a + s b
template <class A, class V, class S>
SANDGLASS_LOOP Vector3<V> plus(const Vector3<V>& a, S s, const Vector3<V>& b) {
  return {A::fma(s, b.x, a.x), A::fma(s, b.y, a.y), A::fma(s, b.z, a.z)};
}

/// a - s b
template <class A, class V, class S>
SANDGLASS_LOOP Vector3<V> minus(const Vector3<V>& a, S s, const Vector3<V>& b) {
  return {A::fnma(s, b.x, a.x), A::fnma(s, b.y, a.y), A::fnma(s, b.z, a.z)};
}

template <class V, class S> SANDGLASS_LOOP Vector3<V> times(S s, const Vector3<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

/// a - b x c
template <class A, class V>
SANDGLASS_LOOP Vector3<V> minusCross(const Vector3<V>& a, const Vector3<V>& b, const Vector3<V>& c) {
  return {A::fma(b.z, c.y, A::fnma(b.y, c.z, a.x)), A::fma(b.x, c.z, A::fnma(b.z, c.x, a.y)),
          A::fma(b.y, c.x, A::fnma(b.x, c.y, a.z))};
}

/// a x b
template <class A, class V> SANDGLASS_LOOP Vector3<V> cross(const Vector3<V>& a, const Vector3<V>& b) {
  return {A::fnma(a.z, b.y, a.y * b.z), A::fnma(a.x, b.z, a.z * b.x), A::fnma(a.y, b.x, a.x * b.y)};
}

/// mask ? a : 0
template <class A, class Mask, class V> SANDGLASS_LOOP Vector3<V> where(Mask mask, const Vector3<V>& a) {
  const V zero = A::template all<V>(0);
  return {A::pick(mask, a.x, zero), A::pick(mask, a.y, zero), A::pick(mask, a.z, zero)};
}

} // namespace sandglass
