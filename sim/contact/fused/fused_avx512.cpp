#include "sim/contact/arithmetic_avx512.h"
#include "sim/contact/fused/fused_loop.h"
#include "sim/contact/pair_load_avx512.h"

namespace sandglass {

namespace {

template <class A> struct Width512 {
  using V = __m512d;
  using Arithmetic = A;
  using Real = double;
  static constexpr int lanes = 8, quad = 4;
  using Reach = SumOfRadii<Arithmetic, V>;
  template <bool turning>
  SANDGLASS_LOOP static Vector3<V> places(const ParticleView& v, std::int64_t p, Reach& reach) {
    const Columns at = placesOfEight<turning>(v, p);
    reach.radii = at.w;
    return {at.x, at.y, at.z};
  }
  template <bool turning>
  SANDGLASS_LOOP static Vector3<V> motions(const ParticleView& v, std::int64_t p, V& inverseMass,
                                           Vector3<V>& roll) {
    const auto m = motionsOfEight<turning, false>(v, p);
    inverseMass = m.motion.w;
    if constexpr (turning) roll = {m.roll.x, m.roll.y, m.roll.z};
    return {m.motion.x, m.motion.y, m.motion.z};
  }
  SANDGLASS_LOOP static V read(const double* from) { return _mm512_loadu_pd(from); }
  SANDGLASS_LOOP static void write(double* to, V value) { _mm512_storeu_pd(to, value); }
  template <int quads> SANDGLASS_LOOP static void clear(double* out) {
    for (int k = 0; k < lanes * quad * quads; k += lanes)
      write(out + k, _mm512_setzero_pd());
  }
  template <int quads>
  SANDGLASS_LOOP static void store(double* out, const Vector3<V>& f, const Vector3<V>& t) {
    if constexpr (quads == 1)
      scatter(f.x, f.y, f.z, out, 4);
    else
      scatterTwo(f.x, f.y, f.z, t.x, t.y, t.z, out);
  }
};

} // namespace

FusedLoop fusedLoopAvx512(const FusedLaws& laws, bool fast) {
  return fast ? pickFusedLoop<Width512<FastAvx512>>(laws) : pickFusedLoop<Width512<ExactAvx512>>(laws);
}

} // namespace sandglass
