// The pair kernel for processors with AVX2: whole records are loaded and transposed, four contacts at a time,
// instead of gathering single numbers.

#include "sim/contact/pair_kernel_move.h"
#include "sim/contact/pair_kernel_shared.h"

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

template <bool turning, bool spin>
inline void load(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  constexpr std::int64_t stride = turning ? 12 : 8;
  const __m256d oneButLast = _mm256_set_pd(-1, 1, 1, 1); // sums in w, differences else
  for (int c = 0; c < count; c += 4) {
    const std::int32_t* pair = v.pairs + 2 * (first + c);
    __m256d dx[4], dv[4], u[4], w[4];
    for (int k = 0; k < 4; ++k) {
      const double *a = v.records + pair[2 * k] * stride, *z = v.records + pair[2 * k + 1] * stride;
      __m256d place = _mm256_load_pd(z);
      if (v.shifts) place = _mm256_add_pd(place, _mm256_load_pd(v.shifts + 4 * v.shiftOf[first + c + k]));
      dx[k] = _mm256_fnmadd_pd(place, oneButLast, _mm256_load_pd(a));
      dv[k] = _mm256_fnmadd_pd(_mm256_load_pd(z + 4), oneButLast, _mm256_load_pd(a + 4));
      if constexpr (turning) {
        const __m256d ra = _mm256_load_pd(a + 8), rz = _mm256_load_pd(z + 8);
        u[k] = _mm256_add_pd(ra, rz);
        if constexpr (spin)
          w[k] = _mm256_sub_pd(_mm256_mul_pd(ra, _mm256_permute4x64_pd(ra, 0xff)),
                               _mm256_mul_pd(rz, _mm256_permute4x64_pd(rz, 0xff)));
      }
    }
    const Columns x = transpose(dx[0], dx[1], dx[2], dx[3]), y = transpose(dv[0], dv[1], dv[2], dv[3]);
    _mm256_store_pd(b.nx + c, x.x);
    _mm256_store_pd(b.ny + c, x.y);
    _mm256_store_pd(b.nz + c, x.z);
    _mm256_store_pd(p.sum + c, x.w);
    _mm256_store_pd(b.vtx + c, y.x);
    _mm256_store_pd(b.vty + c, y.y);
    _mm256_store_pd(b.vtz + c, y.z);
    _mm256_store_pd(p.inverseMass + c, y.w);
    if constexpr (turning) {
      const Columns s = transpose(u[0], u[1], u[2], u[3]);
      _mm256_store_pd(p.rollX + c, s.x);
      _mm256_store_pd(p.rollY + c, s.y);
      _mm256_store_pd(p.rollZ + c, s.z);
      if constexpr (spin) {
        const Columns t = transpose(w[0], w[1], w[2], w[3]);
        _mm256_store_pd(b.wx + c, t.x);
        _mm256_store_pd(b.wy + c, t.y);
        _mm256_store_pd(b.wz + c, t.z);
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
  clearForces(b, v.readsSpin);
}

/// Columns x y z of four contacts to quads (x y z 0), `stride` doubles apart.
inline void scatter(const double* x, const double* y, const double* z, double* out, std::int64_t stride) {
  const Columns q = transpose(_mm256_load_pd(x), _mm256_load_pd(y), _mm256_load_pd(z), _mm256_setzero_pd());
  _mm256_store_pd(out, q.x);
  _mm256_store_pd(out + stride, q.y);
  _mm256_store_pd(out + 2 * stride, q.z);
  _mm256_store_pd(out + 3 * stride, q.w);
}

void write(const ParticleView& v, std::int64_t first, const ContactBlock& b, const PairColumns& p,
           bool keepHistory) {
  if (!keepHistory) writeHistory(v, first, b);
  OutputColumns o;
  outputs(b, p, v.outputQuads > 1, o);
  const std::int64_t stride = 4 * v.outputQuads;
  for (int c = 0; c < b.size; c += 4) {
    double* out = v.output + (first + c) * stride;
    scatter(o.fx + c, o.fy + c, o.fz + c, out, stride);
    if (stride > 4) scatter(o.tx + c, o.ty + c, o.tz + c, out + 4, stride);
    if (stride > 8) scatter(b.mx + c, b.my + c, b.mz + c, out + 8, stride);
  }
}

void sum(const ParticleView& v, std::int64_t first, int count, GroupSums& s) {
  alignas(32) static const std::uint64_t signs[2][4] = {{0, 0, 0, 0},
                                                        {1ull << 63, 1ull << 63, 1ull << 63, 1ull << 63}};
  const std::int64_t stride = 4 * v.outputQuads;
  const std::int32_t* slot = v.slots + first * 8;
  for (int i = 0; i < count; ++i, slot += 8) {
    __m256d force = _mm256_setzero_pd(), torque = force, couple = force;
    for (int k = 0; k < 8; ++k) {
      const std::int64_t entry = slot[k];
      const double* out = v.output + (entry >> 1) * stride;
      const __m256d sign = _mm256_load_pd(reinterpret_cast<const double*>(signs[entry & 1]));
      force = _mm256_add_pd(force, _mm256_xor_pd(_mm256_load_pd(out), sign));
      if (stride < 8) continue;
      torque = _mm256_add_pd(torque, _mm256_load_pd(out + 4));
      if (stride < 12) continue;
      couple = _mm256_add_pd(couple, _mm256_xor_pd(_mm256_load_pd(out + 8), sign));
    }
    _mm256_store_pd(s.at[i], force);
    _mm256_store_pd(s.at[i] + 4, torque);
    _mm256_store_pd(s.at[i] + 8, couple);
  }
}

} // namespace

const Kernel& avx2Kernel() {
  static const Kernel kernel{fill, write, sum, move};
  return kernel;
}

} // namespace sandglass
