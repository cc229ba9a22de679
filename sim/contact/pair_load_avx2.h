#pragma once
// Records of four pairs to columns, and columns to outputs, by whole loads and transposes.

#include "sim/contact/laws/arithmetic.h"
#include "sim/contact/pair_kernel.h"

#include <immintrin.h>

namespace sandglass {

namespace {

struct Columns {
  __m256d x, y, z, w;
};
inline Columns transpose(__m256d q0, __m256d q1, __m256d q2, __m256d q3) {
  const __m256d lowA = _mm256_unpacklo_pd(q0, q1), lowB = _mm256_unpacklo_pd(q2, q3);
  const __m256d highA = _mm256_unpackhi_pd(q0, q1), highB = _mm256_unpackhi_pd(q2, q3);
  return {_mm256_permute2f128_pd(lowA, lowB, 0x20), _mm256_permute2f128_pd(highA, highB, 0x20),
          _mm256_permute2f128_pd(lowA, lowB, 0x31), _mm256_permute2f128_pd(highA, highB, 0x31)};
}

/// Four pairs: differences of places, with the sum of radii in w.
template <bool turning> SANDGLASS_LOOP Columns placesOfFour(const ParticleView& v, std::int64_t first) {
  constexpr std::int64_t stride = turning ? 12 : 8;
  const __m256d oneButLast = _mm256_set_pd(-1, 1, 1, 1); // sums in w, differences else
  const std::int32_t* pair = v.pairs + 2 * first;
  __m256d apart[4];
  for (int k = 0; k < 4; ++k) {
    const double *a = v.records + pair[2 * k] * stride, *z = v.records + pair[2 * k + 1] * stride;
    __m256d place = _mm256_load_pd(z);
    if (v.shifts) place = _mm256_add_pd(place, _mm256_load_pd(v.shifts + 4 * v.shiftOf[first + k]));
    apart[k] = _mm256_fnmadd_pd(place, oneButLast, _mm256_load_pd(a));
  }
  return transpose(apart[0], apart[1], apart[2], apart[3]);
}

/// Differences of velocities with the sum of inverse masses, sums of surface speeds with that of inverse
/// radii, differences of spins (sums where a law has its own torque) with the sum of 1/(m r^2).
struct FourMotions {
  Columns motion, roll, spin;
};

template <bool turning, bool spin>
SANDGLASS_LOOP FourMotions motionsOfFour(const ParticleView& v, std::int64_t first) {
  constexpr std::int64_t stride = turning ? 12 : 8;
  const __m256d oneButLast = _mm256_set_pd(-1, 1, 1, 1);
  const std::int32_t* pair = v.pairs + 2 * first;
  const double s = v.ownTorque ? -1.0 : 1.0;
  const __m256d sign = _mm256_set_pd(-1, s, s, s);
  __m256d dv[4], u[4], w[4];
  for (int k = 0; k < 4; ++k) {
    const double *a = v.records + pair[2 * k] * stride, *z = v.records + pair[2 * k + 1] * stride;
    const __m256d va = _mm256_load_pd(a + 4), vz = _mm256_load_pd(z + 4);
    dv[k] = _mm256_fnmadd_pd(vz, oneButLast, va);
    if constexpr (turning) {
      const __m256d ra = _mm256_load_pd(a + 8), rz = _mm256_load_pd(z + 8);
      u[k] = _mm256_add_pd(ra, rz);
      if constexpr (spin) {
        const auto spinOf = [](__m256d roll, __m256d motion) {
          const __m256d inverse = _mm256_permute4x64_pd(roll, 0xff);
          return _mm256_mul_pd(roll, _mm256_blend_pd(inverse, _mm256_mul_pd(inverse, motion), 8));
        };
        w[k] = _mm256_sub_pd(spinOf(ra, va), _mm256_mul_pd(sign, spinOf(rz, vz)));
      }
    }
  }
  FourMotions out;
  out.motion = transpose(dv[0], dv[1], dv[2], dv[3]);
  if constexpr (turning) out.roll = transpose(u[0], u[1], u[2], u[3]);
  if constexpr (spin) out.spin = transpose(w[0], w[1], w[2], w[3]);
  return out;
}

/// Columns x y z w of four contacts to quads, `stride` doubles apart.
inline void scatter(__m256d x, __m256d y, __m256d z, double* out, std::int64_t stride,
                    __m256d w = _mm256_setzero_pd()) {
  const Columns q = transpose(x, y, z, w);
  _mm256_store_pd(out, q.x);
  _mm256_store_pd(out + stride, q.y);
  _mm256_store_pd(out + 2 * stride, q.z);
  _mm256_store_pd(out + 3 * stride, q.w);
}

} // namespace

} // namespace sandglass
