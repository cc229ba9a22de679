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

/// From records to geometry and motion, eight contacts at a time and all in registers; the operations and
/// their order are those of finishGeometry.
template <bool turning, bool spin, bool radiusArm>
inline void geometry(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  const double* records = v.records;
  constexpr std::int64_t stride = turning ? 12 : 8;
  const __m512d oneButLast = _mm512_set_pd(-1, 1, 1, 1, -1, 1, 1, 1); // sums in w, differences else
  const __m512d one = _mm512_set1_pd(1.0);
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
        place +=
            both(v.shifts + 4 * v.shiftOf[first + c + low[k]], v.shifts + 4 * v.shiftOf[first + c + high[k]]);
      dx[k] = _mm512_fnmadd_pd(place, oneButLast, both(a0, a1));
      dv[k] = _mm512_fnmadd_pd(both(z0 + 4, z1 + 4), oneButLast, both(a0 + 4, a1 + 4));
      if constexpr (turning) {
        const __m512d ra = both(a0 + 8, a1 + 8), rz = both(z0 + 8, z1 + 8);
        u[k] = ra + rz;
        if constexpr (spin) w[k] = ra * _mm512_permutex_pd(ra, 0xff) - rz * _mm512_permutex_pd(rz, 0xff);
      }
    }
    const Columns x = transpose(dx[0], dx[1], dx[2], dx[3]), y = transpose(dv[0], dv[1], dv[2], dv[3]);
    const __m512d d = _mm512_sqrt_pd(x.x * x.x + x.y * x.y + x.z * x.z);
    const __m512d inverse = one / d;
    const __m512d nx = x.x * inverse, ny = x.y * inverse, nz = x.z * inverse;
    const __m512d vn = y.x * nx + y.y * ny + y.z * nz;
    __m512d vtx = y.x - vn * nx, vty = y.y - vn * ny, vtz = y.z - vn * nz;
    _mm512_store_pd(b.nx + c, nx);
    _mm512_store_pd(b.ny + c, ny);
    _mm512_store_pd(b.nz + c, nz);
    _mm512_store_pd(b.overlap + c, x.w - d);
    _mm512_store_pd(b.vn + c, vn);
    _mm512_store_pd(p.sum + c, x.w);
    _mm512_store_pd(p.inverseMass + c, y.w);
    if constexpr (turning) {
      const Columns s = transpose(u[0], u[1], u[2], u[3]);
      const __m512d arm = radiusArm ? one : d / x.w;
      const __m512d wx = s.x * arm, wy = s.y * arm, wz = s.z * arm;
      vtx -= wy * nz - wz * ny;
      vty -= wz * nx - wx * nz;
      vtz -= wx * ny - wy * nx;
      _mm512_store_pd(p.arm + c, arm);
      if constexpr (spin) {
        const Columns t = transpose(w[0], w[1], w[2], w[3]);
        _mm512_store_pd(b.wx + c, t.x);
        _mm512_store_pd(b.wy + c, t.y);
        _mm512_store_pd(b.wz + c, t.z);
      }
    }
    _mm512_store_pd(b.vtx + c, vtx);
    _mm512_store_pd(b.vty + c, vty);
    _mm512_store_pd(b.vtz + c, vtz);
    const auto clear = [c](double* column) { _mm512_store_pd(column + c, _mm512_setzero_pd()); };
    clear(b.normalForce), clear(b.contactForce), clear(b.stiffness), clear(b.damping);
    clear(b.ftx), clear(b.fty), clear(b.ftz);
    if constexpr (spin) clear(b.mx), clear(b.my), clear(b.mz);
  }
}

void fill(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  b.size = count;
  if (v.quads == 2)
    geometry<false, false, false>(v, first, count, b, p);
  else if (v.radiusArm)
    v.readsSpin ? geometry<true, true, true>(v, first, count, b, p)
                : geometry<true, false, true>(v, first, count, b, p);
  else
    v.readsSpin ? geometry<true, true, false>(v, first, count, b, p)
                : geometry<true, false, false>(v, first, count, b, p);
  fillExtras(v, first, b, p);
  fillHistory(v, first, b);
}

/// Columns x y z of eight contacts to quads (x y z 0), `stride` doubles apart.
inline void scatter(__m512d x, __m512d y, __m512d z, double* out, std::int64_t stride) {
  const __m512d zero = _mm512_setzero_pd();
  const __m512d lowXy = _mm512_unpacklo_pd(x, y),
                highXy = _mm512_unpackhi_pd(x, y); // contacts 0 2 4 6, 1 3 5 7
  const __m512d lowZ = _mm512_unpacklo_pd(z, zero), highZ = _mm512_unpackhi_pd(z, zero);
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

/// As outputs(), in registers.
template <int quads>
inline void writeOutputs(const ParticleView& v, std::int64_t first, const ContactBlock& b,
                         const PairColumns& p) {
  constexpr std::int64_t stride = 4 * quads;
  for (int c = 0; c < b.size; c += 8) {
    double* out = v.output + (first + c) * stride;
    const auto at = [c](const double* column) { return _mm512_load_pd(column + c); };
    const __m512d nx = at(b.nx), ny = at(b.ny), nz = at(b.nz), fn = at(b.normalForce);
    const __m512d ftx = at(b.ftx), fty = at(b.fty), ftz = at(b.ftz);
    scatter(fn * nx + ftx, fn * ny + fty, fn * nz + ftz, out, stride);
    if constexpr (quads > 1) {
      const __m512d arm = at(p.arm);
      scatter(arm * (nz * fty - ny * ftz), arm * (nx * ftz - nz * ftx), arm * (ny * ftx - nx * fty), out + 4,
              stride);
    }
    if constexpr (quads > 2) scatter(at(b.mx), at(b.my), at(b.mz), out + 8, stride);
  }
}

void write(const ParticleView& v, std::int64_t first, const ContactBlock& b, const PairColumns& p,
           bool keepHistory) {
  if (!keepHistory) writeHistory(v, first, b);
  if (v.outputQuads == 1)
    writeOutputs<1>(v, first, b, p);
  else if (v.outputQuads == 2)
    writeOutputs<2>(v, first, b, p);
  else
    writeOutputs<3>(v, first, b, p);
}

alignas(64) constexpr std::uint64_t signs[2][8] = {
    {0, 0, 0, 0, 0, 0, 0, 0}, {1ull << 63, 1ull << 63, 1ull << 63, 1ull << 63, 0, 0, 0, 0}};

template <int quads> inline void sums(const ParticleView& v, std::int64_t first, int count, GroupSums& s) {
  const std::int32_t* slot = v.slots + first * 8;
  const char* outputs = reinterpret_cast<const char*>(v.output);
  for (int i = 0; i < count; ++i, slot += 8) {
    __m512d total = _mm512_setzero_pd(); // force and torque
    __m256d couple = _mm256_setzero_pd();
    for (int k = 0; k < 8; ++k) {
      const std::uint64_t entry = static_cast<std::uint32_t>(slot[k]); // pair in the upper bits, side below
      const double* out = reinterpret_cast<const double*>(outputs + (entry & ~1ull) * (16 * quads));
      const std::uint64_t* sign = signs[entry & 1];
      if constexpr (quads == 1)
        total += _mm512_zextpd256_pd512(
            _mm256_xor_pd(_mm256_load_pd(out),
                          _mm256_castsi256_pd(_mm256_load_si256(reinterpret_cast<const __m256i*>(sign)))));
      else
        total += _mm512_xor_pd(_mm512_loadu_pd(out), _mm512_castsi512_pd(_mm512_load_si512(sign)));
      if constexpr (quads == 3)
        couple +=
            _mm256_xor_pd(_mm256_load_pd(out + 8),
                          _mm256_castsi256_pd(_mm256_load_si256(reinterpret_cast<const __m256i*>(sign))));
    }
    _mm512_storeu_pd(s.at[i], total);
    if constexpr (quads == 3) _mm256_store_pd(s.at[i] + 8, couple);
  }
}

void sum(const ParticleView& v, std::int64_t first, int count, GroupSums& s) {
  if (v.outputQuads == 1)
    sums<1>(v, first, count, s);
  else if (v.outputQuads == 2)
    sums<2>(v, first, count, s);
  else
    sums<3>(v, first, count, s);
}

} // namespace

const Kernel& avx512Kernel() {
  static const Kernel kernel{fill, write, sum, move};
  return kernel;
}

} // namespace sandglass
