#pragma once
// The arithmetic of the laws on eight doubles. For files that are compiled for AVX-512.

#include "sim/contact/laws/arithmetic.h"

#include <immintrin.h>

namespace sandglass {

namespace {

/// The bits of IEEE arithmetic. Estimates refined by fused multiply-adds and proved to be the rounded result
/// were tried in place of the divider, and were slower by 9 %: the loops wait for the vector ports as much.
struct ExactAvx512 {
  using V = __m512d;
  template <class> SANDGLASS_LOOP static V all(double a) { return _mm512_set1_pd(a); }
  SANDGLASS_LOOP static V root(V a) { return _mm512_sqrt_pd(a); }
  SANDGLASS_LOOP static V over(V a, V b) { return a / b; }
  SANDGLASS_LOOP static V overRoot(V a, V b, V& rootOfB, __mmask8 = 0xff) {
    rootOfB = root(b);
    return a / rootOfB;
  }
  SANDGLASS_LOOP static V fma(V a, V b, V c) { return _mm512_fmadd_pd(a, b, c); }
  SANDGLASS_LOOP static V fnma(V a, V b, V c) { return _mm512_fnmadd_pd(a, b, c); }
  SANDGLASS_LOOP static __mmask8 above(V a, V b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
  SANDGLASS_LOOP static __mmask8 both(__mmask8 a, __mmask8 b) { return a & b; }
  SANDGLASS_LOOP static bool any(__mmask8 a) { return a != 0; }
  SANDGLASS_LOOP static V pick(__mmask8 mask, V a, V b) { return _mm512_mask_blend_pd(mask, b, a); }
  SANDGLASS_LOOP static V larger(V a, V b) { return _mm512_max_pd(b, a); }
};

/// Roots and quotients from estimates, refined by Newton steps to within two units in the last place. The
/// estimates are each maker's own, and so are the bits. Arguments from 1e-290 to 1e290.
struct FastAvx512 : ExactAvx512 {
  SANDGLASS_LOOP static V root(V a) {
    V r;
    overRoot(a, a, r);
    return pick(above(a, _mm512_setzero_pd()), r, a);
  }
  SANDGLASS_LOOP static V over(V a, V b) {
    V y = _mm512_rcp14_pd(b);
    V e = _mm512_fnmadd_pd(b, y, _mm512_set1_pd(1.0));   // 14 places
    y = _mm512_fmadd_pd(_mm512_fmadd_pd(e, e, e), y, y); // 42
    e = _mm512_fnmadd_pd(b, y, _mm512_set1_pd(1.0));
    return a * _mm512_fmadd_pd(e, y, y);
  }
  SANDGLASS_LOOP static V overRoot(V a, V b, V& rootOfB, __mmask8 = 0xff) {
    const V one = _mm512_set1_pd(1.0), oneHalf = _mm512_set1_pd(0.5);
    V y = _mm512_rsqrt14_pd(b);
    V e = _mm512_fnmadd_pd(b * y, y, one);
    y = _mm512_fmadd_pd(_mm512_fmadd_pd(e, _mm512_set1_pd(0.375), oneHalf) * e, y, y);
    e = _mm512_fnmadd_pd(b * y, y, one);
    y = _mm512_fmadd_pd(e, oneHalf * y, y);
    rootOfB = b * y;
    return a * y;
  }
};

/// Sixteen numbers of single precision, with the bits of IEEE arithmetic.
struct SingleAvx512 {
  using V = __m512;
  template <class> SANDGLASS_LOOP static V all(double a) { return _mm512_set1_ps(static_cast<float>(a)); }
  SANDGLASS_LOOP static V root(V a) { return _mm512_sqrt_ps(a); }
  SANDGLASS_LOOP static V over(V a, V b) { return a / b; }
  SANDGLASS_LOOP static V overRoot(V a, V b, V& rootOfB, __mmask16 = 0xffff) {
    rootOfB = root(b);
    return a / rootOfB;
  }
  SANDGLASS_LOOP static V fma(V a, V b, V c) { return _mm512_fmadd_ps(a, b, c); }
  SANDGLASS_LOOP static V fnma(V a, V b, V c) { return _mm512_fnmadd_ps(a, b, c); }
  SANDGLASS_LOOP static __mmask16 above(V a, V b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
  SANDGLASS_LOOP static __mmask16 both(__mmask16 a, __mmask16 b) { return a & b; }
  SANDGLASS_LOOP static bool any(__mmask16 a) { return a != 0; }
  SANDGLASS_LOOP static V pick(__mmask16 mask, V a, V b) { return _mm512_mask_blend_ps(mask, b, a); }
  SANDGLASS_LOOP static V larger(V a, V b) { return _mm512_max_ps(b, a); }
};

/// As FastAvx512: one Newton step each. Arguments from 1e-37 to 1e37.
struct FastSingleAvx512 : SingleAvx512 {
  SANDGLASS_LOOP static V root(V a) {
    V r;
    overRoot(a, a, r);
    return pick(above(a, _mm512_setzero_ps()), r, a);
  }
  SANDGLASS_LOOP static V over(V a, V b) {
    const V y = _mm512_rcp14_ps(b);
    const V e = _mm512_fnmadd_ps(b, y, _mm512_set1_ps(1.0F));
    return a * _mm512_fmadd_ps(e, y, y);
  }
  SANDGLASS_LOOP static V overRoot(V a, V b, V& rootOfB, __mmask16 = 0xffff) {
    V y = _mm512_rsqrt14_ps(b);
    const V e = _mm512_fnmadd_ps(b * y, y, _mm512_set1_ps(1.0F));
    y = _mm512_fmadd_ps(e, _mm512_set1_ps(0.5F) * y, y);
    rootOfB = b * y;
    return a * y;
  }
};

} // namespace

} // namespace sandglass
