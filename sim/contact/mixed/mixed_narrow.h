#pragma once
// Mixed records from records of doubles, a quad a register; for both vector widths.

#include "sim/contact/mixed/mixed_loops.h"
#include "sim/contact/pair_kernel_move.h"

namespace sandglass {

namespace {

/// Position and radius in fixed point.
inline void narrowPlace(const ParticleView& v, __m256d place, std::int32_t* to) {
  const __m256d units =
      _mm256_add_pd(_mm256_mul_pd(place, _mm256_set1_pd(v.perUnit)), _mm256_set1_pd(fixedPointBias));
  const __m256i lower = _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6);
  const __m256i whole = _mm256_permutevar8x32_epi32(_mm256_castpd_si256(units), lower);
  _mm_store_si128(reinterpret_cast<__m128i*>(to), _mm256_castsi256_si128(whole));
}

inline void narrowQuads(const ParticleView& v, std::int64_t i, __m256d place, __m256d motion, __m256d roll) {
  std::int32_t* to = v.mixed + i * 4 * v.quads;
  narrowPlace(v, place, to);
  _mm_store_ps(reinterpret_cast<float*>(to + 4), _mm256_cvtpd_ps(motion));
  if (v.quads > 2) _mm_store_ps(reinterpret_cast<float*>(to + 8), _mm256_cvtpd_ps(roll));
}

inline void narrow(const ParticleView& v, std::int64_t first, int count) {
  for (std::int64_t i = first; i < first + count; ++i) {
    const double* from = v.records + i * 4 * v.quads;
    narrowQuads(v, i, _mm256_load_pd(from), _mm256_load_pd(from + 4),
                v.quads > 2 ? _mm256_load_pd(from + 8) : _mm256_setzero_pd());
  }
}

inline void moveAndNarrow(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
                          const double* gravity, double speedLimit, Speeds& speeds) {
  moveQuads(v, first, count, s, dt, gravity, speedLimit, speeds,
            [&v](std::int64_t i, __m256d place, __m256d motion, __m256d roll) {
              narrowQuads(v, i, place, motion, roll);
            });
}

} // namespace

} // namespace sandglass
