// Mixed precision, eight pairs at a time.

#include "sim/contact/arithmetic_avx2.h"
#include "sim/contact/fused/fused_pick.h"
#include "sim/contact/mixed/mixed_narrow.h"
#include "sim/contact/mixed/mixed_reach.h"

namespace sandglass {

namespace {

/// Four registers of quads to four columns: lane l of register k is pair 4 l + k.
struct Columns {
  __m256 x, y, z, w;
};
SANDGLASS_LOOP Columns transpose(__m256 q0, __m256 q1, __m256 q2, __m256 q3) {
  const auto d = [](__m256 q) SANDGLASS_LAMBDA { return _mm256_castps_pd(q); };
  const auto s = [](__m256d q) SANDGLASS_LAMBDA { return _mm256_castpd_ps(q); };
  const __m256 xy01 = _mm256_unpacklo_ps(q0, q1), xy23 = _mm256_unpacklo_ps(q2, q3);
  const __m256 zw01 = _mm256_unpackhi_ps(q0, q1), zw23 = _mm256_unpackhi_ps(q2, q3);
  return {s(_mm256_unpacklo_pd(d(xy01), d(xy23))), s(_mm256_unpackhi_pd(d(xy01), d(xy23))),
          s(_mm256_unpacklo_pd(d(zw01), d(zw23))), s(_mm256_unpackhi_pd(d(zw01), d(zw23)))};
}

SANDGLASS_LOOP __m256i quads(const std::int32_t* low, const std::int32_t* high) {
  const auto at = [](const std::int32_t* q)
                      SANDGLASS_LAMBDA { return _mm_load_si128(reinterpret_cast<const __m128i*>(q)); };
  return _mm256_inserti128_si256(_mm256_castsi128_si256(at(low)), at(high), 1);
}

struct Width256 {
  using V = __m256;
  using Real = float;
  using Arithmetic = SingleAvx2;
  static constexpr int lanes = 8, quad = 2;
  static constexpr bool addsAtOnce = false;
  using Reach = MixedReach<Arithmetic, V>;

  /// A quad of eight pairs: z times `sign` added to a.
  template <bool turning>
  SANDGLASS_LOOP static Columns combined(const ParticleView& v, std::int64_t p, int from, __m256 sign) {
    constexpr std::int64_t stride = turning ? 12 : 8;
    const std::int32_t *records = v.mixed + from, *pair = v.pairs + 2 * p;
    __m256 q[4];
    for (int k = 0; k < 4; ++k) {
      const auto side = [&](int s) SANDGLASS_LAMBDA {
        return _mm256_castsi256_ps(
            quads(records + pair[2 * k + s] * stride, records + pair[2 * (4 + k) + s] * stride));
      };
      q[k] = _mm256_fmadd_ps(side(1), sign, side(0));
    }
    return transpose(q[0], q[1], q[2], q[3]);
  }

  template <bool turning>
  SANDGLASS_LOOP static Vector3<V> places(const ParticleView& v, std::int64_t p, Reach& reach) {
    constexpr std::int64_t stride = turning ? 12 : 8;
    const std::int32_t *records = v.mixed, *pair = v.pairs + 2 * p;
    __m256 apart[4];
    for (int k = 0; k < 4; ++k) {
      const auto side = [&](int s) SANDGLASS_LAMBDA {
        return quads(records + pair[2 * k + s] * stride, records + pair[2 * (4 + k) + s] * stride);
      };
      const __m256i a = side(0);
      __m256i z = side(1);
      if (v.mixedShifts)
        z = _mm256_add_epi32(
            z, quads(v.mixedShifts + 4 * v.shiftOf[p + k], v.mixedShifts + 4 * v.shiftOf[p + 4 + k]));
      apart[k] = _mm256_castsi256_ps(
          _mm256_blend_epi32(_mm256_sub_epi32(a, z), _mm256_add_epi32(a, z), 0x88)); // radii are summed
    }
    const Columns columns = transpose(apart[0], apart[1], apart[2], apart[3]);
    const __m256i x = _mm256_castps_si256(columns.x), y = _mm256_castps_si256(columns.y),
                  z = _mm256_castps_si256(columns.z), radii = _mm256_castps_si256(columns.w);
    const auto squares = [&](__m128i ix, __m128i iy, __m128i iz, __m128i sum) SANDGLASS_LAMBDA {
      const __m256d dx = _mm256_cvtepi32_pd(ix), dy = _mm256_cvtepi32_pd(iy), dz = _mm256_cvtepi32_pd(iz),
                    r = _mm256_cvtepi32_pd(sum);
      const __m256d all = _mm256_fnmadd_pd(dz, dz, _mm256_fnmadd_pd(dy, dy, _mm256_fnmadd_pd(dx, dx, r * r)));
      return _mm256_cvtpd_ps(all * _mm256_set1_pd(v.unit));
    };
    const auto low = [](__m256i i) SANDGLASS_LAMBDA { return _mm256_castsi256_si128(i); };
    const auto high = [](__m256i i) SANDGLASS_LAMBDA { return _mm256_extracti128_si256(i, 1); };
    reach.radii = _mm256_cvtepi32_ps(radii);
    reach.squares = _mm256_set_m128(squares(high(x), high(y), high(z), high(radii)),
                                    squares(low(x), low(y), low(z), low(radii)));
    return {_mm256_cvtepi32_ps(x), _mm256_cvtepi32_ps(y), _mm256_cvtepi32_ps(z)};
  }

  template <bool turning, bool>
  SANDGLASS_LOOP static Motions<V> motions(const ParticleView& v, std::int64_t p) {
    Motions<V> out;
    const __m256 minus = _mm256_setr_ps(-1, -1, -1, 1, -1, -1, -1, 1);
    if constexpr (turning) {
      const Columns sums = combined<turning>(v, p, 8, _mm256_set1_ps(1));
      out.roll = {sums.x, sums.y, sums.z};
    }
    const Columns motion = combined<turning>(v, p, 4, minus);
    out.velocity = {motion.x, motion.y, motion.z};
    out.inverseMass = motion.w;
    return out;
  }

  SANDGLASS_LOOP static V read(const float* from) { return _mm256_loadu_ps(from); }
  SANDGLASS_LOOP static void write(float* to, V value) { _mm256_storeu_ps(to, value); }
  template <int quads> SANDGLASS_LOOP static void clear(double* out) {
    for (int k = 0; k < lanes * quad * quads; k += 4)
      _mm256_storeu_pd(out + k, _mm256_setzero_pd());
  }
  template <int quads>
  SANDGLASS_LOOP static void store(double* out, const Vector3<V>& f, const Vector3<V>& t) {
    const V zero = _mm256_setzero_ps();
    const auto put = [&](const Columns& all, float* to) SANDGLASS_LAMBDA {
      const __m256 rows[4] = {all.x, all.y, all.z, all.w};
      for (int k = 0; k < 4; ++k) {
        _mm_store_ps(to + 4 * quads * k, _mm256_castps256_ps128(rows[k]));
        _mm_store_ps(to + 4 * quads * (4 + k), _mm256_extractf128_ps(rows[k], 1));
      }
    };
    auto* to = reinterpret_cast<float*>(out);
    put(transpose(f.x, f.y, f.z, zero), to);
    if constexpr (quads > 1) put(transpose(t.x, t.y, t.z, zero), to + 4);
  }
};

} // namespace

FusedLoop mixedLoopAvx2(const FusedLaws& laws) {
  return pickGeneralLoop<Width256>(laws);
}

Kernel mixedKernelAvx2() {
  Kernel kernel = avx2Kernel();
  kernel.addSides = addSides<float>;
  kernel.move = moveAndNarrow;
  kernel.narrow = narrow;
  return kernel;
}

} // namespace sandglass
