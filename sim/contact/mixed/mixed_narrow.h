#pragma once
// Mixed records from records of doubles, a quad a register; for both vector widths.

#include "sim/contact/mixed/mixed_loops.h"

#include <immintrin.h>

namespace sandglass {

namespace {

void narrow(const ParticleView& v, std::int64_t first, int count) {
  const __m256d perUnit = _mm256_set1_pd(v.perUnit), bias = _mm256_set1_pd(fixedPointBias);
  const __m256i lower = _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6);
  const __m128 least = _mm_set1_ps(leastInverseMass);
  const double* from = v.records + first * 4 * v.quads;
  std::int32_t* to = v.mixed + first * 4 * v.quads;
  for (int i = 0; i < count; ++i, from += 4 * v.quads, to += 4 * v.quads) {
    const __m256d units = _mm256_add_pd(_mm256_mul_pd(_mm256_load_pd(from), perUnit), bias);
    const __m256i whole = _mm256_permutevar8x32_epi32(_mm256_castpd_si256(units), lower);
    _mm_store_si128(reinterpret_cast<__m128i*>(to), _mm256_castsi256_si128(whole));
    const __m128 motion = _mm256_cvtpd_ps(_mm256_load_pd(from + 4));
    _mm_store_ps(reinterpret_cast<float*>(to + 4),
                 _mm_blend_ps(motion, _mm_max_ps(motion, least), 0b1000)); // 1/mass
    if (v.quads > 2)
      _mm_store_ps(reinterpret_cast<float*>(to + 8), _mm256_cvtpd_ps(_mm256_load_pd(from + 8)));
  }
}

} // namespace

} // namespace sandglass
