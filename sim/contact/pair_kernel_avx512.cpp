// The pair kernel for processors with AVX-512: whole records are loaded and transposed, eight contacts at a
// time, instead of gathering single numbers.

#include "sim/contact/arithmetic_avx512.h"
#include "sim/contact/pair_kernel_move_avx512.h"
#include "sim/contact/pair_kernel_shared.h"
#include "sim/contact/pair_load_avx512.h"
#include "sim/contact/pair_sums.h"

namespace sandglass {

namespace {

/// From records to geometry and motion, eight contacts at a time and all in registers; the operations and
/// their order are those of finishGeometry.
template <bool turning, bool spin, bool radiusArm>
inline void geometry(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  for (int c = 0; c < count; c += 8) {
    const Columns x = placesOfEight<turning>(v, first + c);
    const EightMotions moves = motionsOfEight<turning, spin>(v, first + c);
    const Columns& y = moves.motion;
    const Vector3<__m512d> apart{x.x, x.y, x.z};
    __m512d distance;
    const Vector3<__m512d> n = times(inverseDistance<ExactAvx512>(apart, distance), apart);
    Vector3<__m512d> roll{};
    __m512d arm = _mm512_set1_pd(1.0);
    if constexpr (turning) {
      roll = {moves.roll.x, moves.roll.y, moves.roll.z};
      if (!radiusArm) arm = distance / x.w;
      _mm512_store_pd(p.arm + c, arm);
      _mm512_store_pd(p.inverseRadii + c, moves.roll.w);
    }
    const ContactMotion<__m512d> contact = contactMotion<ExactAvx512, turning>(n, {y.x, y.y, y.z}, roll, arm);
    _mm512_store_pd(b.nx + c, n.x);
    _mm512_store_pd(b.ny + c, n.y);
    _mm512_store_pd(b.nz + c, n.z);
    _mm512_store_pd(b.overlap + c, x.w - distance);
    _mm512_store_pd(b.vn + c, contact.vn);
    _mm512_store_pd(p.sum + c, x.w);
    _mm512_store_pd(p.inverseMass + c, y.w);
    if constexpr (spin) {
      _mm512_store_pd(b.wx + c, moves.spin.x);
      _mm512_store_pd(b.wy + c, moves.spin.y);
      _mm512_store_pd(b.wz + c, moves.spin.z);
    }
    _mm512_store_pd(b.vtx + c, contact.slip.x);
    _mm512_store_pd(b.vty + c, contact.slip.y);
    _mm512_store_pd(b.vtz + c, contact.slip.z);
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

/// As outputs(), in registers.
template <int quads>
inline void writeOutputs(const ParticleView& v, const ContactBlock& b, const PairColumns& p, double* output) {
  constexpr std::int64_t stride = 4 * quads;
  for (int c = 0; c < b.size; c += 8) {
    double* out = output + c * stride;
    const auto at = [c](const double* column) { return _mm512_load_pd(column + c); };
    const Vector3<__m512d> n{at(b.nx), at(b.ny), at(b.nz)}, tangential{at(b.ftx), at(b.fty), at(b.ftz)};
    const Vector3<__m512d> f = plus<ExactAvx512>(tangential, at(b.normalForce), n);
    if constexpr (quads == 1) {
      scatter(f.x, f.y, f.z, out, stride);
    } else {
      Vector3<__m512d> t;
      if (v.ownTorque) {
        const __m512d r = at(b.radiusA);
        t = {at(b.mx) / r, at(b.my) / r, at(b.mz) / r};
      } else {
        t = contactTorque<ExactAvx512>(n, at(p.arm), tangential);
      }
      const __m512d zero = _mm512_setzero_pd();
      scatter(f.x, f.y, f.z, out, stride);
      scatter(t.x, t.y, t.z, out + 4, stride, v.sumsOverlaps ? _mm512_max_pd(at(b.overlap), zero) : zero);
    }
    if constexpr (quads > 2) scatter(at(b.mx), at(b.my), at(b.mz), out + 8, stride);
  }
}

void write(const ParticleView& v, std::int64_t first, const ContactBlock& b, const PairColumns& p,
           bool keepHistory, double* output) {
  if (!keepHistory) writeHistory(v, first, b);
  if (v.outputQuads == 1)
    writeOutputs<1>(v, b, p, output);
  else if (v.outputQuads == 2)
    writeOutputs<2>(v, b, p, output);
  else
    writeOutputs<3>(v, b, p, output);
}

template <bool couples>
void moveWhole(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
               const double* gravity, double speedLimit, Speeds& speeds) {
  moveTurning<couples>(v, first, count, s, dt, gravity, speedLimit, speeds,
                       [](std::int64_t, __m256d, __m512d) {});
}

void moveBoth(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
              const double* gravity, double speedLimit, Speeds& speeds) {
  const auto how = v.quads != 3 ? move : v.outputQuads == 2 ? moveWhole<false> : moveWhole<true>;
  how(v, first, count, s, dt, gravity, speedLimit, speeds);
}

} // namespace

const Kernel& avx512Kernel() {
  static const Kernel kernel{fill, write, add, addSides<double>, moveBoth};
  return kernel;
}

} // namespace sandglass
