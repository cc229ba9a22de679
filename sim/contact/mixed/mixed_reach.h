#pragma once
// What tells the overlap of pairs in mixed precision (mixed_records.h), for all widths.

#include "sim/contact/laws/arithmetic.h"

namespace sandglass {

namespace {

template <class A, class V> struct MixedReach {
  V radii, squares; ///< [units]; squared radii minus squared distance, times a unit [units m]
  SANDGLASS_LOOP V overlap(V distance) const { return A::over(squares, radii + distance); }
  SANDGLASS_LOOP bool mayTouch(V) const { return A::any(A::above(squares, A::template all<V>(0))); }
};

} // namespace

} // namespace sandglass
