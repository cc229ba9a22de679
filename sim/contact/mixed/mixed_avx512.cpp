// Mixed precision, sixteen pairs at a time.

#include "sim/contact/arithmetic_avx512.h"
#include "sim/contact/fused/fused_pick.h"
#include "sim/contact/mixed/mixed_narrow.h"
#include "sim/contact/mixed/mixed_reach.h"
#include "sim/contact/pair_kernel_move_avx512.h"

namespace sandglass {

namespace {

/// Four registers of quads to four columns: lane l of register k is pair 4 l + k.
struct Columns {
  __m512 x, y, z, w;
};
SANDGLASS_LOOP Columns transpose(__m512 q0, __m512 q1, __m512 q2, __m512 q3) {
  const auto d = [](__m512 q) SANDGLASS_LAMBDA { return _mm512_castps_pd(q); };
  const auto s = [](__m512d q) SANDGLASS_LAMBDA { return _mm512_castpd_ps(q); };
  const __m512 xy01 = _mm512_unpacklo_ps(q0, q1), xy23 = _mm512_unpacklo_ps(q2, q3);
  const __m512 zw01 = _mm512_unpackhi_ps(q0, q1), zw23 = _mm512_unpackhi_ps(q2, q3);
  return {s(_mm512_unpacklo_pd(d(xy01), d(xy23))), s(_mm512_unpackhi_pd(d(xy01), d(xy23))),
          s(_mm512_unpacklo_pd(d(zw01), d(zw23))), s(_mm512_unpackhi_pd(d(zw01), d(zw23)))};
}

SANDGLASS_LOOP __m512i quads(const std::int32_t* q0, const std::int32_t* q1, const std::int32_t* q2,
                             const std::int32_t* q3) {
  const auto at = [](const std::int32_t* q)
                      SANDGLASS_LAMBDA { return _mm_load_si128(reinterpret_cast<const __m128i*>(q)); };
  __m512i all = _mm512_castsi128_si512(at(q0));
  all = _mm512_mask_broadcast_i32x4(all, 0x00f0, at(q1));
  all = _mm512_mask_broadcast_i32x4(all, 0x0f00, at(q2));
  return _mm512_mask_broadcast_i32x4(all, 0xf000, at(q3));
}

/// Two neighbouring quads of each of two pairs.
SANDGLASS_LOOP __m512 twoQuads(const std::int32_t* low, const std::int32_t* high) {
  const auto at = [](const std::int32_t* q)
                      SANDGLASS_LAMBDA { return _mm256_loadu_ps(reinterpret_cast<const float*>(q)); };
  return _mm512_mask_broadcast_f32x8(_mm512_castps256_ps512(at(low)), 0xff00, at(high));
}

template <class A> struct Width512 {
  using V = __m512;
  using Real = float;
  using Arithmetic = A;
  static constexpr int lanes = 16, quad = 2;
  static constexpr bool addsAtOnce = false;
  using Reach = MixedReach<Arithmetic, V>;

  template <bool turning>
  SANDGLASS_LOOP static Vector3<V> places(const ParticleView& v, std::int64_t p, Reach& reach) {
    constexpr std::int64_t stride = turning ? 12 : 8;
    const std::int32_t* records = v.mixed;
    const std::int32_t* pair = v.pairs + 2 * p;
    bool shifted = false;
    if (v.mixedShifts) {
      const __m128i codes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(v.shiftOf + p));
      shifted =
          _mm_movemask_epi8(_mm_cmpeq_epi8(codes, _mm_set1_epi8(static_cast<char>(v.noShift)))) != 0xffff;
    }
    __m512 apart[4];
    for (int k = 0; k < 4; ++k) {
      const auto at = [&](int side, int lane)
                          SANDGLASS_LAMBDA { return records + pair[2 * (4 * lane + k) + side] * stride; };
      const auto shift = [&](int lane)
                             SANDGLASS_LAMBDA { return v.mixedShifts + 4 * v.shiftOf[p + 4 * lane + k]; };
      const __m512i a = quads(at(0, 0), at(0, 1), at(0, 2), at(0, 3));
      __m512i z = quads(at(1, 0), at(1, 1), at(1, 2), at(1, 3));
      if (shifted) z = _mm512_add_epi32(z, quads(shift(0), shift(1), shift(2), shift(3)));
      apart[k] = _mm512_castsi512_ps(
          _mm512_mask_add_epi32(_mm512_sub_epi32(a, z), 0x8888, a, z)); // radii are summed
    }
    const Columns columns = transpose(apart[0], apart[1], apart[2], apart[3]);
    const __m512i x = _mm512_castps_si512(columns.x), y = _mm512_castps_si512(columns.y),
                  z = _mm512_castps_si512(columns.z), radii = _mm512_castps_si512(columns.w);
    const auto squares = [&](auto half) SANDGLASS_LAMBDA {
      const __m512d dx = half(x), dy = half(y), dz = half(z), sum = half(radii);
      const __m512d all =
          _mm512_fnmadd_pd(dz, dz, _mm512_fnmadd_pd(dy, dy, _mm512_fnmadd_pd(dx, dx, sum * sum)));
      return _mm512_cvtpd_ps(all * _mm512_set1_pd(v.unit));
    };
    const __m256 low =
        squares([](__m512i i) SANDGLASS_LAMBDA { return _mm512_cvtepi32_pd(_mm512_castsi512_si256(i)); });
    const __m256 high = squares(
        [](__m512i i) SANDGLASS_LAMBDA { return _mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(i, 1)); });
    reach.radii = _mm512_cvtepi32_ps(radii);
    reach.squares = _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
    return {_mm512_cvtepi32_ps(x), _mm512_cvtepi32_ps(y), _mm512_cvtepi32_ps(z)};
  }

  template <bool turning, bool>
  SANDGLASS_LOOP static Motions<V> motions(const ParticleView& v, std::int64_t p) {
    Motions<V> out;
    constexpr std::int64_t stride = turning ? 12 : 8;
    const std::int32_t* records = v.mixed + 4;
    const std::int32_t* pair = v.pairs + 2 * p;
    if constexpr (turning) {
      // Velocity and roll of a pair side by side: sums of rolls and of inverse masses, differences else.
      const __m512 sign = _mm512_setr_ps(-1, -1, -1, 1, 1, 1, 1, 1, -1, -1, -1, 1, 1, 1, 1, 1);
      Columns half[2];
      for (int h = 0; h < 2; ++h) {
        __m512 q[4];
        for (int k = 0; k < 4; ++k) {
          const auto at = [&](int side, int l) SANDGLASS_LAMBDA {
            return records + pair[2 * (8 * h + 4 * l + k) + side] * stride;
          };
          q[k] = _mm512_fmadd_ps(twoQuads(at(1, 0), at(1, 1)), sign, twoQuads(at(0, 0), at(0, 1)));
        }
        half[h] = transpose(q[0], q[1], q[2], q[3]);
      }
      const auto even = [](__m512 a, __m512 b) SANDGLASS_LAMBDA { return _mm512_shuffle_f32x4(a, b, 0x88); };
      const auto odd = [](__m512 a, __m512 b) SANDGLASS_LAMBDA { return _mm512_shuffle_f32x4(a, b, 0xdd); };
      out.inverseMass = even(half[0].w, half[1].w);
      out.roll = {odd(half[0].x, half[1].x), odd(half[0].y, half[1].y), odd(half[0].z, half[1].z)};
      out.velocity = {even(half[0].x, half[1].x), even(half[0].y, half[1].y), even(half[0].z, half[1].z)};
    } else {
      const __m512 sign = _mm512_setr_ps(-1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, 1);
      __m512 q[4];
      for (int k = 0; k < 4; ++k) {
        const auto at = [&](int side, int lane)
                            SANDGLASS_LAMBDA { return records + pair[2 * (4 * lane + k) + side] * stride; };
        const __m512i a = quads(at(0, 0), at(0, 1), at(0, 2), at(0, 3));
        const __m512i z = quads(at(1, 0), at(1, 1), at(1, 2), at(1, 3));
        q[k] = _mm512_fmadd_ps(_mm512_castsi512_ps(z), sign, _mm512_castsi512_ps(a));
      }
      const Columns all = transpose(q[0], q[1], q[2], q[3]);
      out.inverseMass = all.w;
      out.velocity = {all.x, all.y, all.z};
    }
    return out;
  }

  SANDGLASS_LOOP static V read(const float* from) { return _mm512_loadu_ps(from); }
  SANDGLASS_LOOP static void write(float* to, V value) { _mm512_storeu_ps(to, value); }
  template <int quads> SANDGLASS_LOOP static void clear(double* out) {
    for (int k = 0; k < lanes * quad * quads; k += 8)
      _mm512_storeu_pd(out + k, _mm512_setzero_pd());
  }
  template <int quads>
  SANDGLASS_LOOP static void store(double* out, const Vector3<V>& f, const Vector3<V>& t) {
    const V zero = _mm512_setzero_ps();
    const Columns force = transpose(f.x, f.y, f.z, zero); // lane l of column k: pair 4 l + k, as it came
    const __m512 forces[4] = {force.x, force.y, force.z, force.w};
    auto* to = reinterpret_cast<float*>(out);
    if constexpr (quads == 1) {
      for (int k = 0; k < 4; ++k) {
        _mm_store_ps(to + 4 * k, _mm512_castps512_ps128(forces[k]));
        _mm_store_ps(to + 4 * (4 + k), _mm512_extractf32x4_ps(forces[k], 1));
        _mm_store_ps(to + 4 * (8 + k), _mm512_extractf32x4_ps(forces[k], 2));
        _mm_store_ps(to + 4 * (12 + k), _mm512_extractf32x4_ps(forces[k], 3));
      }
    } else {
      const Columns torque = transpose(t.x, t.y, t.z, zero);
      const __m512 torques[4] = {torque.x, torque.y, torque.z, torque.w};
      for (int k = 0; k < 4; ++k) {
        const __m512 low = _mm512_castpd_ps(
            _mm512_permutex2var_pd(_mm512_castps_pd(forces[k]), _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                                   _mm512_castps_pd(torques[k])));
        const __m512 high = _mm512_castpd_ps(
            _mm512_permutex2var_pd(_mm512_castps_pd(forces[k]), _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15),
                                   _mm512_castps_pd(torques[k])));
        _mm256_store_ps(to + 8 * k, _mm512_castps512_ps256(low));
        _mm256_store_ps(to + 8 * (4 + k), _mm512_extractf32x8_ps(low, 1));
        _mm256_store_ps(to + 8 * (8 + k), _mm512_castps512_ps256(high));
        _mm256_store_ps(to + 8 * (12 + k), _mm512_extractf32x8_ps(high, 1));
      }
    }
  }
};

void moveBoth(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
              const double* gravity, double speedLimit, Speeds& speeds) {
  if (v.quads < 3) return moveAndNarrow(v, first, count, s, dt, gravity, speedLimit, speeds);
  moveTurning<false>(v, first, count, s, dt, gravity, speedLimit, speeds,
                     [&v](std::int64_t i, __m256d place, __m512d motion) {
                       std::int32_t* to = v.mixed + i * 12;
                       narrowPlace(v, place, to);
                       _mm256_storeu_ps(reinterpret_cast<float*>(to + 4), _mm512_cvtpd_ps(motion));
                     });
}

} // namespace

FusedLoop mixedLoopAvx512(const FusedLaws& laws, bool fast) {
  return fast ? pickGeneralLoop<Width512<FastSingleAvx512>>(laws)
              : pickGeneralLoop<Width512<SingleAvx512>>(laws);
}

Kernel mixedKernelAvx512() {
  Kernel kernel = avx512Kernel();
  kernel.addSides = addSides<float>;
  kernel.move = moveBoth;
  kernel.narrow = narrow;
  return kernel;
}

} // namespace sandglass
