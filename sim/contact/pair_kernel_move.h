#pragma once
// Kick and drift with one record's quad per register; for both vector widths.

#include "sim/contact/pair_kernel.h"

#include <immintrin.h>

namespace sandglass {

namespace {

/// What a group's motion says of its speeds; `fine`: all are below the limit.
inline void tell(__m256d most, bool fine, Speeds& speeds) {
  alignas(32) double m[4];
  _mm256_store_pd(m, most);
  speeds.x = m[0];
  speeds.y = m[1];
  speeds.z = m[2];
  speeds.bad = speeds.bad || !fine;
}

/// A quad of sums, which is left zero.
inline __m256d take(double* quad) {
  const __m256d all = _mm256_load_pd(quad);
  _mm256_store_pd(quad, _mm256_setzero_pd());
  return all;
}

/// Calls done(grain, place, motion, roll) with what each has come to; roll is nothing where grains do not
/// turn.
template <class Done>
inline void moveQuads(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
                      const double* gravity, double speedLimit, Speeds& speeds, Done&& done) {
  const __m256d step = _mm256_set_pd(0, dt, dt, dt);
  // Zero in the last lane keeps radius, 1/mass and 1/radius as they are.
  const __m256d pull = _mm256_set_pd(0, dt * gravity[2], dt * gravity[1], dt * gravity[0]);
  const __m256d xyz = _mm256_castsi256_pd(_mm256_set_epi64x(0, -1, -1, -1));
  const __m256d absolute =
      _mm256_castsi256_pd(_mm256_set_epi64x(0, ~(1ull << 63), ~(1ull << 63), ~(1ull << 63)));
  const __m256d limit = _mm256_set1_pd(speedLimit), held = _mm256_set1_pd(heldInverseMass);
  __m256d most = _mm256_set_pd(0, speeds.z, speeds.y, speeds.x),
          fine = _mm256_cmp_pd(limit, limit, _CMP_EQ_OQ);
  const bool turning = v.quads > 2, couples = v.outputQuads > 2;
  for (int i = 0; i < count; ++i) {
    double* r = v.records + (first + i) * 4 * v.quads;
    double* f = s.at(i);
    __m256d motion = _mm256_load_pd(r + 4);
    const __m256d inverseMass = _mm256_permute4x64_pd(motion, 0xff), kick = _mm256_mul_pd(step, inverseMass);
    const __m256d free = _mm256_and_pd(xyz, _mm256_cmp_pd(inverseMass, held, _CMP_GT_OQ));
    const __m256d change = _mm256_add_pd(_mm256_mul_pd(kick, take(f)), pull);
    motion = _mm256_add_pd(motion, _mm256_and_pd(change, free));
    _mm256_store_pd(r + 4, motion);
    const __m256d place = _mm256_add_pd(_mm256_load_pd(r), _mm256_mul_pd(step, motion));
    _mm256_store_pd(r, place);
    const __m256d size = _mm256_and_pd(motion, absolute);
    most = _mm256_max_pd(size, most);
    fine = _mm256_and_pd(fine, _mm256_cmp_pd(size, limit, _CMP_LT_OQ));
    if (!turning) {
      if (s.stride > 4) take(f + 4); // sums of overlaps
      done(first + i, place, motion, _mm256_setzero_pd());
      continue;
    }
    __m256d roll = _mm256_load_pd(r + 8);
    __m256d torque = take(f + 4);
    if (couples)
      torque = _mm256_add_pd(torque, _mm256_mul_pd(take(f + 8), _mm256_permute4x64_pd(roll, 0xff)));
    const __m256d turn = _mm256_mul_pd(_mm256_mul_pd(_mm256_set1_pd(2.5), kick), torque);
    roll = _mm256_add_pd(roll, _mm256_and_pd(turn, free));
    _mm256_store_pd(r + 8, roll);
    done(first + i, place, motion, roll);
  }
  tell(most, _mm256_movemask_pd(fine) == 15, speeds);
}

inline void move(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
                 const double* gravity, double speedLimit, Speeds& speeds) {
  moveQuads(v, first, count, s, dt, gravity, speedLimit, speeds,
            [](std::int64_t, __m256d, __m256d, __m256d) {});
}

} // namespace

} // namespace sandglass
