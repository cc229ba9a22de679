// The pair kernel for processors with AVX2: whole records are loaded and transposed, four contacts at a time,
// instead of gathering single numbers.

#include "sim/contact/pair_kernel_move.h"
#include "sim/contact/pair_kernel_shared.h"
#include "sim/contact/pair_load_avx2.h"
#include "sim/contact/pair_sums.h"

namespace sandglass {

namespace {

/// From records to columns of geometry and motion.
template <bool turning, bool spin>
inline void load(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  for (int c = 0; c < count; c += 4) {
    const Columns places = placesOfFour<turning>(v, first + c);
    const FourMotions moves = motionsOfFour<turning, spin>(v, first + c);
    _mm256_store_pd(b.nx + c, places.x);
    _mm256_store_pd(b.ny + c, places.y);
    _mm256_store_pd(b.nz + c, places.z);
    _mm256_store_pd(p.sum + c, places.w);
    _mm256_store_pd(b.vtx + c, moves.motion.x);
    _mm256_store_pd(b.vty + c, moves.motion.y);
    _mm256_store_pd(b.vtz + c, moves.motion.z);
    _mm256_store_pd(p.inverseMass + c, moves.motion.w);
    if constexpr (turning) {
      _mm256_store_pd(p.rollX + c, moves.roll.x);
      _mm256_store_pd(p.rollY + c, moves.roll.y);
      _mm256_store_pd(p.rollZ + c, moves.roll.z);
      _mm256_store_pd(p.inverseRadii + c, moves.roll.w);
    }
    if constexpr (spin) {
      _mm256_store_pd(b.wx + c, moves.spin.x);
      _mm256_store_pd(b.wy + c, moves.spin.y);
      _mm256_store_pd(b.wz + c, moves.spin.z);
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

void write(const ParticleView& v, std::int64_t first, const ContactBlock& b, const PairColumns& p,
           bool keepHistory, double* output) {
  if (!keepHistory) writeHistory(v, first, b);
  OutputColumns o;
  outputs(v, b, p, o);
  const std::int64_t stride = 4 * v.outputQuads;
  for (int c = 0; c < b.size; c += 4) {
    double* out = output + c * stride;
    const auto at = [c](const double* column) { return _mm256_load_pd(column + c); };
    scatter(at(o.fx), at(o.fy), at(o.fz), out, stride);
    if (stride > 4) scatter(at(o.tx), at(o.ty), at(o.tz), out + 4, stride, at(o.overlap));
    if (stride > 8) scatter(at(b.mx), at(b.my), at(b.mz), out + 8, stride);
  }
}

} // namespace

const Kernel& avx2Kernel() {
  static const Kernel kernel{fill, write, add, addSides<double>, move};
  return kernel;
}

} // namespace sandglass
