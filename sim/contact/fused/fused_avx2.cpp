#include "sim/contact/arithmetic_avx2.h"
#include "sim/contact/fused/fused_loop.h"
#include "sim/contact/pair_load_avx2.h"

namespace sandglass {

namespace {

struct Width256 {
  using V = __m256d;
  using Arithmetic = ExactAvx2;
  static constexpr int lanes = 4;
  template <bool turning>
  SANDGLASS_LOOP static PairState<V> load(const ParticleView& v, std::int64_t p, V& inverseMass) {
    const FourPairs f = loadFour<turning, false>(v, p);
    PairState<V> out{{f.place.x, f.place.y, f.place.z}, f.place.w, {f.motion.x, f.motion.y, f.motion.z}, {}};
    inverseMass = f.motion.w;
    if constexpr (turning) out.roll = {f.roll.x, f.roll.y, f.roll.z};
    return out;
  }
  SANDGLASS_LOOP static V read(const double* from) { return _mm256_loadu_pd(from); }
  SANDGLASS_LOOP static void write(double* to, V value) { _mm256_storeu_pd(to, value); }
  template <int quads>
  SANDGLASS_LOOP static void store(const ParticleView& v, std::int64_t p, const Vector3<V>& f,
                                   const Vector3<V>& t) {
    double* out = v.output + 4 * quads * p;
    scatter(f.x, f.y, f.z, out, 4 * quads);
    if constexpr (quads > 1) scatter(t.x, t.y, t.z, out + 4, 4 * quads);
  }
};

} // namespace

FusedLoop fusedLoopAvx2(const FusedLaws& laws) {
  return pickFusedLoop<Width256>(laws);
}

} // namespace sandglass
