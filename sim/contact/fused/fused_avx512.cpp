#include "sim/contact/arithmetic_avx512.h"
#include "sim/contact/fused/fused_loop.h"
#include "sim/contact/pair_load_avx512.h"

namespace sandglass {

namespace {

struct Width512 {
  using V = __m512d;
  using Arithmetic = ExactAvx512;
  static constexpr int lanes = 8;
  template <bool turning>
  SANDGLASS_LOOP static PairState<V> load(const ParticleView& v, std::int64_t p, V& inverseMass) {
    const EightPairs e = loadEight<turning, false>(v, p);
    PairState<V> out{{e.place.x, e.place.y, e.place.z}, e.place.w, {e.motion.x, e.motion.y, e.motion.z}, {}};
    inverseMass = e.motion.w;
    if constexpr (turning) out.roll = {e.roll.x, e.roll.y, e.roll.z};
    return out;
  }
  SANDGLASS_LOOP static V read(const double* from) { return _mm512_loadu_pd(from); }
  SANDGLASS_LOOP static void write(double* to, V value) { _mm512_storeu_pd(to, value); }
  template <int quads>
  SANDGLASS_LOOP static void store(const ParticleView& v, std::int64_t p, const Vector3<V>& f,
                                   const Vector3<V>& t) {
    if constexpr (quads == 1)
      scatter(f.x, f.y, f.z, v.output + 4 * p, 4);
    else
      scatterTwo(f.x, f.y, f.z, t.x, t.y, t.z, v.output + 8 * p);
  }
};

} // namespace

FusedLoop fusedLoopAvx512(const FusedLaws& laws) {
  return pickFusedLoop<Width512>(laws);
}

} // namespace sandglass
