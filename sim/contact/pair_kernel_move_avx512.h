#pragma once
// Kick and drift of grains that turn, for files that are compiled for AVX-512.

#include "sim/contact/pair_kernel_move.h"

namespace sandglass {

namespace {

/// As moveQuads(), velocity and roll of a record in one register.
template <bool couples, class Done>
inline void moveTurning(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
                        const double* gravity, double speedLimit, Speeds& speeds, Done&& done) {
  const __m512d share = _mm512_set_pd(0, 2.5, 2.5, 2.5, 0, 1, 1, 1);
  const __m512d pull = _mm512_set_pd(0, 0, 0, 0, 0, dt * gravity[2], dt * gravity[1], dt * gravity[0]);
  const __m512d size = _mm512_castsi512_pd(_mm512_set1_epi64(static_cast<std::int64_t>(~(1ull << 63))));
  const __m256d step = _mm256_set_pd(0, dt, dt, dt), limit = _mm256_set1_pd(speedLimit);
  const __m512d time = _mm512_set1_pd(dt), held = _mm512_set1_pd(heldInverseMass);
  __m256d most = _mm256_set_pd(0, speeds.z, speeds.y, speeds.x);
  __mmask8 fine = 7;
  double* r = v.records + first * 12;
  for (int i = 0; i < count; ++i, r += 12) {
    const __m512d inverseMass = _mm512_set1_pd(r[7]), kick = time * inverseMass * share;
    const __mmask8 free = _mm512_cmp_pd_mask(inverseMass, held, _CMP_GT_OQ);
    const __m512d record = _mm512_loadu_pd(r + 4);
    double* const sum = s.at(i);
    __m512d force = _mm512_loadu_pd(sum); // and torque
    _mm512_storeu_pd(sum, _mm512_setzero_pd());
    if constexpr (couples) {
      const __m512d couple = _mm512_broadcast_f64x4(take(sum + 8));
      force = _mm512_mask_add_pd(force, 0x70, force, couple * _mm512_permutex_pd(record, 0xff));
    }
    __m512d change = kick * force;
    change = _mm512_mask_add_pd(change, 7, change, pull);
    const __m512d motion = _mm512_mask_add_pd(record, free, record, change);
    _mm512_storeu_pd(r + 4, motion);
    const __m256d velocity = _mm512_castpd512_pd256(motion);
    const __m256d place = _mm256_add_pd(_mm256_load_pd(r), _mm256_mul_pd(step, velocity));
    _mm256_store_pd(r, place);
    done(first + i, place, motion);
    const __m256d speed = _mm256_and_pd(velocity, _mm512_castpd512_pd256(size));
    most = _mm256_mask_max_pd(most, 7, speed, most);
    fine = _mm256_mask_cmp_pd_mask(fine, speed, limit, _CMP_LT_OQ);
  }
  tell(most, fine == 7, speeds);
}

} // namespace

} // namespace sandglass
