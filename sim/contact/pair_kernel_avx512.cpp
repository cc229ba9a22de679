// The pair kernel for processors with AVX-512: whole records are loaded and transposed, eight contacts at a
// time, instead of gathering single numbers.

#include "sim/contact/pair_kernel_move.h"
#include "sim/contact/pair_kernel_shared.h"

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

template <bool turning, bool spin>
inline void load(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  const double* records = v.records;
  constexpr std::int64_t stride = turning ? 12 : 8;
  const __m512d oneButLast = _mm512_set_pd(-1, 1, 1, 1, -1, 1, 1, 1); // sums in w, differences else
  const std::uint64_t noShift = v.noShift * 0x0101010101010101ull;
  for (int c = 0; c < count; c += 8) {
    const std::int32_t* pair = v.pairs + 2 * (first + c);
    bool shifted = false;
    if (v.shifts) {
      std::uint64_t codes;
      __builtin_memcpy(&codes, v.shiftOf + first + c, 8);
      shifted = codes != noShift;
    }
    __m512d dx[4], dv[4], u[4], w[4];
    for (int k = 0; k < 4; ++k) {
      const double *a0 = records + pair[2 * low[k]] * stride, *z0 = records + pair[2 * low[k] + 1] * stride;
      const double *a1 = records + pair[2 * high[k]] * stride, *z1 = records + pair[2 * high[k] + 1] * stride;
      __m512d place = both(z0, z1);
      if (shifted)
        place = _mm512_add_pd(place, both(v.shifts + 4 * v.shiftOf[first + c + low[k]],
                                          v.shifts + 4 * v.shiftOf[first + c + high[k]]));
      dx[k] = _mm512_fnmadd_pd(place, oneButLast, both(a0, a1));
      dv[k] = _mm512_fnmadd_pd(both(z0 + 4, z1 + 4), oneButLast, both(a0 + 4, a1 + 4));
      if constexpr (turning) {
        const __m512d ra = both(a0 + 8, a1 + 8), rz = both(z0 + 8, z1 + 8);
        u[k] = _mm512_add_pd(ra, rz);
        if constexpr (spin)
          w[k] = _mm512_sub_pd(_mm512_mul_pd(ra, _mm512_permutex_pd(ra, 0xff)),
                               _mm512_mul_pd(rz, _mm512_permutex_pd(rz, 0xff)));
      }
    }
    const Columns x = transpose(dx[0], dx[1], dx[2], dx[3]), y = transpose(dv[0], dv[1], dv[2], dv[3]);
    _mm512_store_pd(b.nx + c, x.x);
    _mm512_store_pd(b.ny + c, x.y);
    _mm512_store_pd(b.nz + c, x.z);
    _mm512_store_pd(p.sum + c, x.w);
    _mm512_store_pd(b.vtx + c, y.x);
    _mm512_store_pd(b.vty + c, y.y);
    _mm512_store_pd(b.vtz + c, y.z);
    _mm512_store_pd(p.inverseMass + c, y.w);
    if constexpr (turning) {
      const Columns s = transpose(u[0], u[1], u[2], u[3]);
      _mm512_store_pd(p.rollX + c, s.x);
      _mm512_store_pd(p.rollY + c, s.y);
      _mm512_store_pd(p.rollZ + c, s.z);
      if constexpr (spin) {
        const Columns t = transpose(w[0], w[1], w[2], w[3]);
        _mm512_store_pd(b.wx + c, t.x);
        _mm512_store_pd(b.wy + c, t.y);
        _mm512_store_pd(b.wz + c, t.z);
      }
    }
  }
}

void fill(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  b.size = count;
  if (v.quads == 2) {
    load<false, false>(v, first, count, b, p);
    finishGeometry<false>(b, p, v.radiusArm);
  } else {
    v.readsSpin ? load<true, true>(v, first, count, b, p) : load<true, false>(v, first, count, b, p);
    finishGeometry<true>(b, p, v.radiusArm);
  }
  fillExtras(v, first, b, p);
  fillHistory(v, first, b);
}

/// Columns x y z of eight contacts to quads (x y z 0), `stride` doubles apart.
inline void scatter(const double* x, const double* y, const double* z, double* out, std::int64_t stride) {
  const __m512d zero = _mm512_setzero_pd();
  const __m512d X = _mm512_load_pd(x), Y = _mm512_load_pd(y), Z = _mm512_load_pd(z);
  const __m512d lowXy = _mm512_unpacklo_pd(X, Y), highXy = _mm512_unpackhi_pd(X, Y); // pairs 0 2 4 6; 1 3 5 7
  const __m512d lowZ = _mm512_unpacklo_pd(Z, zero), highZ = _mm512_unpackhi_pd(Z, zero);
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

void write(const ParticleView& v, std::int64_t first, const ContactBlock& b, const PairColumns& p,
           bool keepHistory) {
  if (!keepHistory) writeHistory(v, first, b);
  OutputColumns o;
  outputs(b, p, v.outputQuads > 1, o);
  const std::int64_t stride = 4 * v.outputQuads;
  for (int c = 0; c < b.size; c += 8) {
    double* out = v.output + (first + c) * stride;
    scatter(o.fx + c, o.fy + c, o.fz + c, out, stride);
    if (stride > 4) scatter(o.tx + c, o.ty + c, o.tz + c, out + 4, stride);
    if (stride > 8) scatter(b.mx + c, b.my + c, b.mz + c, out + 8, stride);
  }
}

void sum(const ParticleView& v, std::int64_t first, int count, GroupSums& s) {
  alignas(64) static const std::uint64_t signs[2][8] = {
      {0, 0, 0, 0, 0, 0, 0, 0}, {1ull << 63, 1ull << 63, 1ull << 63, 1ull << 63, 0, 0, 0, 0}};
  const std::int64_t stride = 4 * v.outputQuads;
  const std::int32_t* slot = v.slots + first * 8;
  if (v.outputQuads == 2) {
    for (int i = 0; i < count; ++i, slot += 8) {
      __m512d total = _mm512_setzero_pd();
      for (int k = 0; k < 8; ++k) {
        const std::int64_t entry = slot[k];
        const __m512d out = _mm512_loadu_pd(v.output + (entry >> 1) * stride);
        total = _mm512_add_pd(total, _mm512_xor_pd(out, _mm512_load_pd(signs[entry & 1])));
      }
      _mm512_storeu_pd(s.at[i], total);
    }
    return;
  }
  for (int i = 0; i < count; ++i, slot += 8) {
    __m256d force = _mm256_setzero_pd(), torque = force, couple = force;
    for (int k = 0; k < 8; ++k) {
      const std::int64_t entry = slot[k];
      const double* out = v.output + (entry >> 1) * stride;
      const __m256d sign = _mm256_load_pd(reinterpret_cast<const double*>(signs[entry & 1]));
      force = _mm256_add_pd(force, _mm256_xor_pd(_mm256_load_pd(out), sign));
      if (stride < 12) continue;
      torque = _mm256_add_pd(torque, _mm256_load_pd(out + 4));
      couple = _mm256_add_pd(couple, _mm256_xor_pd(_mm256_load_pd(out + 8), sign));
    }
    _mm256_store_pd(s.at[i], force);
    _mm256_store_pd(s.at[i] + 4, torque);
    _mm256_store_pd(s.at[i] + 8, couple);
  }
}

} // namespace

const Kernel& avx512Kernel() {
  static const Kernel kernel{fill, write, sum, move};
  return kernel;
}

} // namespace sandglass
