#pragma once
// The arithmetic of the laws on four doubles, with the bits of IEEE arithmetic.

#include "sim/contact/laws/arithmetic.h"

#include <immintrin.h>

namespace sandglass {

namespace {

struct ExactAvx2 {
  using V = __m256d;
  template <class> SANDGLASS_LOOP static V all(double a) { return _mm256_set1_pd(a); }
  SANDGLASS_LOOP static V root(V a) { return _mm256_sqrt_pd(a); }
  SANDGLASS_LOOP static V over(V a, V b) { return a / b; }
  SANDGLASS_LOOP static V overRoot(V a, V b, V& rootOfB, V = _mm256_setzero_pd()) {
    rootOfB = root(b);
    return a / rootOfB;
  }
  SANDGLASS_LOOP static V fma(V a, V b, V c) { return _mm256_fmadd_pd(a, b, c); }
  SANDGLASS_LOOP static V fnma(V a, V b, V c) { return _mm256_fnmadd_pd(a, b, c); }
  SANDGLASS_LOOP static V above(V a, V b) { return _mm256_cmp_pd(a, b, _CMP_GT_OQ); }
  SANDGLASS_LOOP static V both(V a, V b) { return _mm256_and_pd(a, b); }
  SANDGLASS_LOOP static bool any(V a) { return _mm256_movemask_pd(a) != 0; }
  SANDGLASS_LOOP static V pick(V mask, V a, V b) { return _mm256_blendv_pd(b, a, mask); }
  SANDGLASS_LOOP static V larger(V a, V b) { return _mm256_max_pd(b, a); }
};

/// Eight numbers of single precision.
struct SingleAvx2 {
  using V = __m256;
  template <class> SANDGLASS_LOOP static V all(double a) { return _mm256_set1_ps(static_cast<float>(a)); }
  SANDGLASS_LOOP static V root(V a) { return _mm256_sqrt_ps(a); }
  SANDGLASS_LOOP static V over(V a, V b) { return a / b; }
  SANDGLASS_LOOP static V overRoot(V a, V b, V& rootOfB, V = _mm256_setzero_ps()) {
    rootOfB = root(b);
    return a / rootOfB;
  }
  SANDGLASS_LOOP static V fma(V a, V b, V c) { return _mm256_fmadd_ps(a, b, c); }
  SANDGLASS_LOOP static V fnma(V a, V b, V c) { return _mm256_fnmadd_ps(a, b, c); }
  SANDGLASS_LOOP static V above(V a, V b) { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
  SANDGLASS_LOOP static V both(V a, V b) { return _mm256_and_ps(a, b); }
  SANDGLASS_LOOP static bool any(V a) { return _mm256_movemask_ps(a) != 0; }
  SANDGLASS_LOOP static V pick(V mask, V a, V b) { return _mm256_blendv_ps(b, a, mask); }
  SANDGLASS_LOOP static V larger(V a, V b) { return _mm256_max_ps(b, a); }
};

} // namespace

} // namespace sandglass
