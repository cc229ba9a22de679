#include "sim/contact/arithmetic_avx2.h"
#include "sim/contact/fused/fused_pick.h"
#include "sim/contact/pair_load_avx2.h"

namespace sandglass {

namespace {

struct Width256 {
  using V = __m256d;
  using Arithmetic = ExactAvx2;
  using Real = double;
  static constexpr int lanes = 4, quad = 4;
  static constexpr bool addsAtOnce = false;
  using Reach = SumOfRadii<Arithmetic, V>;
  template <bool turning>
  SANDGLASS_LOOP static Vector3<V> places(const ParticleView& v, std::int64_t p, Reach& reach) {
    const Columns at = placesOfFour<turning>(v, p);
    reach.radii = at.w;
    return {at.x, at.y, at.z};
  }
  template <bool turning, bool spin>
  SANDGLASS_LOOP static Motions<V> motions(const ParticleView& v, std::int64_t p) {
    return motionsFrom<V, turning, spin>(motionsOfFour<turning, spin>(v, p));
  }
  using Places = __m128i; ///< in a table of constants
  SANDGLASS_LOOP static Places placesOfPairs(const std::uint8_t* at) {
    return _mm_cvtepu8_epi32(_mm_loadu_si32(at));
  }
  SANDGLASS_LOOP static V lookUp(const double (&row)[FusedTables::places], Places places) {
    const V all = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    return _mm256_mask_i32gather_pd(all, row, places, all, 8); // gcc 12 warns of the gather without a mask
  }
  SANDGLASS_LOOP static V read(const double* from) { return _mm256_loadu_pd(from); }
  SANDGLASS_LOOP static void write(double* to, V value) { _mm256_storeu_pd(to, value); }
  template <int quads> SANDGLASS_LOOP static void clear(double* out) {
    for (int k = 0; k < lanes * quad * quads; k += lanes)
      write(out + k, _mm256_setzero_pd());
  }
  template <int quads>
  SANDGLASS_LOOP static void store(double* out, const Vector3<V>& f, const Vector3<V>& t) {
    scatter(f.x, f.y, f.z, out, 4 * quads);
    if constexpr (quads > 1) scatter(t.x, t.y, t.z, out + 4, 4 * quads);
  }
  SANDGLASS_LOOP static void storeCouple(double* out, const Vector3<V>& m) {
    scatter(m.x, m.y, m.z, out + 8, 12);
  }
};

} // namespace

FusedLoop fusedLoopAvx2(const FusedLaws& laws) {
  return pickDoubleLoop<Width256>(laws);
}

} // namespace sandglass
