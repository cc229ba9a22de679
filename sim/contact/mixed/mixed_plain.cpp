// Mixed precision one pair at a time: the oracle of the wider loops.

#include "sim/contact/fused/fused_pick.h"
#include "sim/contact/mixed/mixed_loops.h"
#include "sim/contact/mixed/mixed_reach.h"

#include <algorithm>

namespace sandglass {

namespace {

struct Width1 {
  using V = float;
  using Real = float;
  using Arithmetic = ScalarArithmetic;
  static constexpr int lanes = 1, quad = 2;
  static constexpr bool addsAtOnce = false;
  using Reach = MixedReach<Arithmetic, V>;
  static const std::int32_t* record(const ParticleView& v, std::int64_t p, int side) {
    return v.mixed + v.pairs[2 * p + side] * std::int64_t{4} * v.quads;
  }
  static float number(const std::int32_t* at) { return std::bit_cast<float>(*at); }

  template <bool turning> static Vector3<V> places(const ParticleView& v, std::int64_t p, Reach& reach) {
    const std::int32_t *a = record(v, p, 0), *z = record(v, p, 1);
    std::int32_t apart[3];
    for (int k = 0; k < 3; ++k) {
      std::uint32_t far = static_cast<std::uint32_t>(z[k]);
      if (v.mixedShifts) far += static_cast<std::uint32_t>(v.mixedShifts[4 * v.shiftOf[p] + k]);
      apart[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(a[k]) - far);
    }
    const double x = apart[0], y = apart[1], z0 = apart[2], radii = a[3] + z[3];
    using A = ScalarArithmetic;
    const double squares = A::fnma(z0, z0, A::fnma(y, y, A::fnma(x, x, radii * radii)));
    reach.radii = static_cast<float>(a[3] + z[3]);
    reach.squares = static_cast<float>(squares * v.unit);
    return {static_cast<float>(apart[0]), static_cast<float>(apart[1]), static_cast<float>(apart[2])};
  }
  template <bool turning, bool> static Motions<V> motions(const ParticleView& v, std::int64_t p) {
    const std::int32_t *a = record(v, p, 0), *z = record(v, p, 1);
    Motions<V> out;
    out.inverseMass = number(a + 7) + number(z + 7);
    if constexpr (turning)
      out.roll = {number(a + 8) + number(z + 8), number(a + 9) + number(z + 9),
                  number(a + 10) + number(z + 10)};
    out.velocity = {number(a + 4) - number(z + 4), number(a + 5) - number(z + 5),
                    number(a + 6) - number(z + 6)};
    return out;
  }
  static V read(const float* from) { return *from; }
  static void write(float* to, V value) { *to = value; }
  template <int quads> static void clear(double* out) { store<quads>(out, {}, {}); }
  template <int quads> static void store(double* out, const Vector3<V>& f, const Vector3<V>& t) {
    auto* to = reinterpret_cast<float*>(out);
    const V numbers[8] = {f.x, f.y, f.z, 0.0F, t.x, t.y, t.z, 0.0F};
    std::copy_n(numbers, 4 * quads, to);
  }
};

void narrow(const ParticleView& v, std::int64_t first, int count) {
  for (std::int64_t i = first; i < first + count; ++i) {
    const double* from = v.records + i * 4 * v.quads;
    std::int32_t* to = v.mixed + i * 4 * v.quads;
    for (int k = 0; k < 4; ++k)
      to[k] = fixedPoint(from[k] * v.perUnit);
    for (int k = 4; k < 4 * v.quads; ++k)
      to[k] = std::bit_cast<std::int32_t>(static_cast<float>(from[k]));
  }
}

void moveAndNarrow(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt,
                   const double* gravity, double speedLimit, Speeds& speeds) {
  plainKernel().move(v, first, count, s, dt, gravity, speedLimit, speeds);
  narrow(v, first, count);
}

} // namespace

FusedLoop mixedLoopPlain(const FusedLaws& laws) {
  return pickGeneralLoop<Width1>(laws);
}

Kernel mixedKernelPlain() {
  Kernel kernel = plainKernel();
  kernel.addSides = addSides<float>;
  kernel.move = moveAndNarrow;
  kernel.narrow = narrow;
  return kernel;
}

} // namespace sandglass
