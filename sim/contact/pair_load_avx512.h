#pragma once
// Records of eight pairs to columns, and columns to outputs, by whole loads and transposes. For files that
// are compiled for AVX-512.

#include "sim/contact/laws/arithmetic.h"
#include "sim/contact/pair_kernel.h"

#include <immintrin.h>

namespace sandglass {

namespace {

/// Two quads in one register.
inline __m512d both(const double* low, const double* high) {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(low)), _mm256_load_pd(high), 1);
}

/// Four registers, each with the quads of two contacts in the order (0,2) (1,3) (4,6) (5,7), to four columns.
struct Columns {
  __m512d x, y, z, w;
};
inline Columns transpose(__m512d q02, __m512d q13, __m512d q46, __m512d q57) {
  const __m512d lowA = _mm512_unpacklo_pd(q02, q13), lowB = _mm512_unpacklo_pd(q46, q57);
  const __m512d highA = _mm512_unpackhi_pd(q02, q13), highB = _mm512_unpackhi_pd(q46, q57);
  return {_mm512_shuffle_f64x2(lowA, lowB, 0x88), _mm512_shuffle_f64x2(highA, highB, 0x88),
          _mm512_shuffle_f64x2(lowA, lowB, 0xdd), _mm512_shuffle_f64x2(highA, highB, 0xdd)};
}

/// The pairs of register k: lower half low[k], upper half high[k].
constexpr int low[4] = {0, 1, 4, 5}, high[4] = {2, 3, 6, 7};

/// Eight pairs: differences of places, with the sum of radii in w.
template <bool turning> SANDGLASS_LOOP Columns placesOfEight(const ParticleView& v, std::int64_t first) {
  constexpr std::int64_t stride = turning ? 12 : 8;
  const double* records = v.records;
  const __m512d oneButLast = _mm512_set_pd(-1, 1, 1, 1, -1, 1, 1, 1); // sums in w, differences else
  const std::int32_t* pair = v.pairs + 2 * first;
  bool shifted = false;
  if (v.shifts) {
    std::uint64_t codes;
    __builtin_memcpy(&codes, v.shiftOf + first, 8);
    shifted = codes != v.noShift * 0x0101010101010101ull;
  }
  __m512d apart[4];
  for (int k = 0; k < 4; ++k) {
    const double *a0 = records + pair[2 * low[k]] * stride, *z0 = records + pair[2 * low[k] + 1] * stride;
    const double *a1 = records + pair[2 * high[k]] * stride, *z1 = records + pair[2 * high[k] + 1] * stride;
    __m512d place = both(z0, z1);
    if (shifted)
      place += both(v.shifts + 4 * v.shiftOf[first + low[k]], v.shifts + 4 * v.shiftOf[first + high[k]]);
    apart[k] = _mm512_fnmadd_pd(place, oneButLast, both(a0, a1));
  }
  return transpose(apart[0], apart[1], apart[2], apart[3]);
}

/// Differences of velocities with the sum of inverse masses, sums of surface speeds with that of inverse
/// radii, differences of spins (sums where a law has its own torque) with the sum of 1/(m r^2).
struct EightMotions {
  Columns motion, roll, spin;
};

template <bool turning, bool spin>
SANDGLASS_LOOP EightMotions motionsOfEight(const ParticleView& v, std::int64_t first) {
  constexpr std::int64_t stride = turning ? 12 : 8;
  const double* records = v.records;
  const __m512d oneButLast = _mm512_set_pd(-1, 1, 1, 1, -1, 1, 1, 1);
  const std::int32_t* pair = v.pairs + 2 * first;
  const double s = v.ownTorque ? -1.0 : 1.0;
  const __m512d sign = _mm512_set_pd(-1, s, s, s, -1, s, s, s);
  __m512d dv[4], u[4], w[4];
  for (int k = 0; k < 4; ++k) {
    const double *a0 = records + pair[2 * low[k]] * stride, *z0 = records + pair[2 * low[k] + 1] * stride;
    const double *a1 = records + pair[2 * high[k]] * stride, *z1 = records + pair[2 * high[k] + 1] * stride;
    const __m512d va = both(a0 + 4, a1 + 4), vz = both(z0 + 4, z1 + 4);
    dv[k] = _mm512_fnmadd_pd(vz, oneButLast, va);
    if constexpr (turning) {
      const __m512d ra = both(a0 + 8, a1 + 8), rz = both(z0 + 8, z1 + 8);
      u[k] = ra + rz;
      if constexpr (spin) {
        const auto spinOf = [](__m512d roll, __m512d motion) {
          const __m512d inverse = _mm512_permutex_pd(roll, 0xff);
          return roll * _mm512_mask_mul_pd(inverse, 0x88, inverse, motion);
        };
        w[k] = spinOf(ra, va) - sign * spinOf(rz, vz);
      }
    }
  }
  EightMotions out;
  out.motion = transpose(dv[0], dv[1], dv[2], dv[3]);
  if constexpr (turning) out.roll = transpose(u[0], u[1], u[2], u[3]);
  if constexpr (spin) out.spin = transpose(w[0], w[1], w[2], w[3]);
  return out;
}

/// Columns x y z w of eight contacts to quads, `stride` doubles apart.
inline void scatter(__m512d x, __m512d y, __m512d z, double* out, std::int64_t stride,
                    __m512d w = _mm512_setzero_pd()) {
  const __m512d lowXy = _mm512_unpacklo_pd(x, y),
                highXy = _mm512_unpackhi_pd(x, y); // contacts 0 2 4 6, 1 3 5 7
  const __m512d lowZ = _mm512_unpacklo_pd(z, w), highZ = _mm512_unpackhi_pd(z, w);
  const auto put = [&](__m512d xy, __m512d z0, int at) {
    // Lanes of 128 bits: (xy0 xy2 xy4 xy6), (z0 z2 z4 z6) to two quads each.
    const __m512d first = _mm512_permutex2var_pd(xy, _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0), z0);
    const __m512d second = _mm512_permutex2var_pd(xy, _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4), z0);
    _mm256_store_pd(out + at * stride, _mm512_castpd512_pd256(first));
    _mm256_store_pd(out + (at + 2) * stride, _mm512_extractf64x4_pd(first, 1));
    _mm256_store_pd(out + (at + 4) * stride, _mm512_castpd512_pd256(second));
    _mm256_store_pd(out + (at + 6) * stride, _mm512_extractf64x4_pd(second, 1));
  };
  put(lowXy, lowZ, 0);
  put(highXy, highZ, 1);
}

/// Columns of two vectors of eight contacts to pairs of quads, a register for each contact.
struct QuadsOfTwo {
  __m512d of[8];
};
SANDGLASS_LOOP QuadsOfTwo quadsOfTwo(__m512d x, __m512d y, __m512d z, __m512d tx, __m512d ty, __m512d tz) {
  const __m512d zero = _mm512_setzero_pd();
  QuadsOfTwo quads;
  const auto put = [&](__m512d xy, __m512d z0, __m512d txy, __m512d tz0, int at) SANDGLASS_LAMBDA {
    // Lanes of 128 bits, one contact each: force x y, z 0, torque x y, z 0.
    const __m512d a = _mm512_shuffle_f64x2(xy, z0, 0x44), b = _mm512_shuffle_f64x2(txy, tz0, 0x44);
    const __m512d c = _mm512_shuffle_f64x2(xy, z0, 0xee), d = _mm512_shuffle_f64x2(txy, tz0, 0xee);
    quads.of[at] = _mm512_shuffle_f64x2(a, b, 0x88);
    quads.of[at + 2] = _mm512_shuffle_f64x2(a, b, 0xdd);
    quads.of[at + 4] = _mm512_shuffle_f64x2(c, d, 0x88);
    quads.of[at + 6] = _mm512_shuffle_f64x2(c, d, 0xdd);
  };
  put(_mm512_unpacklo_pd(x, y), _mm512_unpacklo_pd(z, zero), _mm512_unpacklo_pd(tx, ty),
      _mm512_unpacklo_pd(tz, zero), 0);
  put(_mm512_unpackhi_pd(x, y), _mm512_unpackhi_pd(z, zero), _mm512_unpackhi_pd(tx, ty),
      _mm512_unpackhi_pd(tz, zero), 1);
  return quads;
}

/// `stride` doubles from one contact to the next.
template <int stride> SANDGLASS_LOOP void storeTwo(const QuadsOfTwo& quads, double* out) {
  for (int k = 0; k < 8; ++k)
    _mm512_storeu_pd(out + k * stride, quads.of[k]);
}

/// As addOutputs() does it, from registers.
SANDGLASS_LOOP void addTwo(const QuadsOfTwo& quads, const std::int32_t* pair, SumRing sums) {
  const __m512d sign = _mm512_set_pd(1, 1, 1, 1, -1, -1, -1, -1);
  for (int k = 0; k < 8; ++k) {
    double* const a = sums.row(pair[2 * k], 2);
    _mm512_store_pd(a, _mm512_load_pd(a) + quads.of[k]);
    double* const b = sums.row(pair[2 * k + 1], 2);
    _mm512_store_pd(b, _mm512_fmadd_pd(quads.of[k], sign, _mm512_load_pd(b)));
  }
}

} // namespace

} // namespace sandglass
