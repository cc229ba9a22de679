#pragma once
// What all widths of the pair kernel share: the loops that the compiler turns into vector code itself. Each
// file that includes this is compiled for its own processor, so everything here is inlined or private.

#include "sim/contact/law_columns.h"
#include "sim/contact/pair_kernel.h"

/// Over all lanes, also those behind the last contact, whose values nobody reads: loops of fixed length need
/// no remainder.
#define LANES(c) _Pragma("GCC ivdep") for (int c = 0; c < ContactBlock::capacity; ++c)

namespace sandglass {

namespace {

/// From differences of positions (in n), of velocities (in v_t) and sums of surface speeds (in roll) to
/// normal, overlap and relative motion at the contact.
template <bool turning, class Real>
inline void finishGeometry(ContactBlockOf<Real>& b, PairColumnsOf<Real>& p, bool radiusArm) {
  LANES(c) {
    const Real x = b.nx[c], y = b.ny[c], z = b.nz[c];
    const Real d = __builtin_sqrt(x * x + y * y + z * z);
    const Real inverse = 1 / d;
    const Real nx = x * inverse, ny = y * inverse, nz = z * inverse;
    const Real dvx = b.vtx[c], dvy = b.vty[c], dvz = b.vtz[c];
    const Real vn = dvx * nx + dvy * ny + dvz * nz;
    b.nx[c] = nx;
    b.ny[c] = ny;
    b.nz[c] = nz;
    const Real overlap = p.sum[c] - d;
    b.overlap[c] = overlap;
    b.vn[c] = vn;
    b.vtx[c] = dvx - vn * nx;
    b.vty[c] = dvy - vn * ny;
    b.vtz[c] = dvz - vn * nz;
    p.arm[c] = d;
  }
  if constexpr (turning) {
    // Contact arms over radii: they add up to the distance, so angular momentum is kept.
    if (radiusArm)
      LANES(c) p.arm[c] = 1;
    else
      LANES(c) p.arm[c] = p.arm[c] / p.sum[c];
    LANES(c) { // slip: minus (arm_a w_a + arm_b w_b) x n
      const Real wx = p.rollX[c] * p.arm[c], wy = p.rollY[c] * p.arm[c], wz = p.rollZ[c] * p.arm[c];
      b.vtx[c] -= wy * b.nz[c] - wz * b.ny[c];
      b.vty[c] -= wz * b.nx[c] - wx * b.nz[c];
      b.vtz[c] -= wx * b.ny[c] - wy * b.nx[c];
    }
  }
}

/// The optional columns.
inline void fillExtras(const ParticleView& v, std::int64_t first, ContactBlock& b, const PairColumns& p) {
  const std::int32_t* pairs = v.pairs + 2 * first;
  const std::int64_t stride = 4 * v.quads;
  if (v.reads & (LawColumns::radii | LawColumns::effectiveRadius)) {
    if (v.oneRadius > 0.0)
      LANES(c) b.radiusA[c] = b.radiusB[c] = v.oneRadius;
    else
      for (int c = 0; c < b.size; ++c) {
        b.radiusA[c] = v.records[pairs[2 * c] * stride + 3];
        b.radiusB[c] = v.records[pairs[2 * c + 1] * stride + 3];
      }
  }
  if (v.reads & LawColumns::effectiveRadius)
    LANES(c) b.effectiveRadius[c] = b.radiusA[c] * b.radiusB[c] / p.sum[c];
  if (v.reads & LawColumns::masses) {
    if (v.oneInverseMass > 0.0)
      LANES(c) b.inverseMassA[c] = b.inverseMassB[c] = v.oneInverseMass;
    else
      for (int c = 0; c < b.size; ++c) {
        b.inverseMassA[c] = v.records[pairs[2 * c] * stride + 7];
        b.inverseMassB[c] = v.records[pairs[2 * c + 1] * stride + 7];
      }
  }
  if (v.reads & LawColumns::effectiveMass) LANES(c) b.effectiveMass[c] = 1.0 / p.inverseMass[c];
  b.oneType = v.oneMaterial;
  b.type[0] = 0;
  if (!v.oneMaterial)
    for (int c = 0; c < b.size; ++c)
      b.type[c] = v.material[pairs[2 * c]] * v.materials + v.material[pairs[2 * c + 1]];
}

inline void fillHistory(const ParticleView& v, std::int64_t first, ContactBlock& b) {
  const int lanes = 8;
  for (int c = 0; c < b.size; c += lanes) {
    const double* from = v.history + (first + c) * v.historySize;
    for (int k = 0; k < v.historySize; ++k)
      for (int l = 0; l < lanes; ++l)
        b.history[k][c + l] = from[k * lanes + l];
  }
}

inline void writeHistory(const ParticleView& v, std::int64_t first, const ContactBlock& b) {
  const int lanes = 8;
  for (int c = 0; c < b.size; c += lanes) {
    double* to = v.history + (first + c) * v.historySize;
    for (int k = 0; k < v.historySize; ++k)
      for (int l = 0; l < lanes; ++l)
        to[k * lanes + l] = b.history[k][c + l];
  }
}

/// Force on a, and what turns either grain. The torque on a grain is -arm (n x f_t); divided by its own
/// radius it is the same for both.
struct OutputColumns {
  alignas(64) double fx[64], fy[64], fz[64], tx[64], ty[64], tz[64];
};

inline void outputs(const ContactBlock& b, const PairColumns& p, bool turning, OutputColumns& o) {
  LANES(c) {
    o.fx[c] = b.normalForce[c] * b.nx[c] + b.ftx[c];
    o.fy[c] = b.normalForce[c] * b.ny[c] + b.fty[c];
    o.fz[c] = b.normalForce[c] * b.nz[c] + b.ftz[c];
  }
  if (turning) LANES(c) {
      o.tx[c] = p.arm[c] * (b.nz[c] * b.fty[c] - b.ny[c] * b.ftz[c]);
      o.ty[c] = p.arm[c] * (b.nx[c] * b.ftz[c] - b.nz[c] * b.ftx[c]);
      o.tz[c] = p.arm[c] * (b.ny[c] * b.ftx[c] - b.nx[c] * b.fty[c]);
    }
}

} // namespace

} // namespace sandglass
