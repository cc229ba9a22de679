#include "sim/contact/arithmetic_avx512.h"
#include "sim/contact/fused/fused_pick.h"
#include "sim/contact/pair_load_avx512.h"

namespace sandglass {

namespace {

template <class A> struct Width512 {
  using V = __m512d;
  using Arithmetic = A;
  using Real = double;
  static constexpr int lanes = 8, quad = 4;
  static constexpr bool addsAtOnce = true;
  using Reach = SumOfRadii<Arithmetic, V>;
  template <bool turning>
  SANDGLASS_LOOP static Vector3<V> places(const ParticleView& v, std::int64_t p, Reach& reach) {
    const Columns at = placesOfEight<turning>(v, p);
    reach.radii = at.w;
    return {at.x, at.y, at.z};
  }
  template <bool turning, bool spin>
  SANDGLASS_LOOP static Motions<V> motions(const ParticleView& v, std::int64_t p) {
    return motionsFrom<V, turning, spin>(motionsOfEight<turning, spin>(v, p));
  }
  using Places = __m512i; ///< in a table of constants
  SANDGLASS_LOOP static Places placesOfPairs(const std::uint8_t* at) {
    return _mm512_cvtepu8_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at)));
  }
  SANDGLASS_LOOP static V lookUp(const double (&row)[FusedTables::places], Places places) {
    return _mm512_permutex2var_pd(_mm512_load_pd(row), places, _mm512_load_pd(row + 8));
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
      storeTwo<4 * quads>(quadsOfTwo(f.x, f.y, f.z, t.x, t.y, t.z), out);
  }
  SANDGLASS_LOOP static void add(const ParticleView& v, std::int64_t p, const Vector3<V>& f,
                                 const Vector3<V>& t, SumRing sums) {
    addTwo(quadsOfTwo(f.x, f.y, f.z, t.x, t.y, t.z), v.pairs + 2 * p, sums);
  }
  SANDGLASS_LOOP static void storeCouple(double* out, const Vector3<V>& m) {
    scatter(m.x, m.y, m.z, out + 8, 12);
  }
};

} // namespace

FusedLoop fusedLoopAvx512(const FusedLaws& laws, bool fast) {
  return fast ? pickDoubleLoop<Width512<FastAvx512>>(laws) : pickDoubleLoop<Width512<ExactAvx512>>(laws);
}

} // namespace sandglass
