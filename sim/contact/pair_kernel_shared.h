#pragma once
// What all widths of the pair kernel share: the loops that the compiler turns into vector code itself. Each
// file that includes this is compiled for its own processor, so everything here is inlined or private.

#include "sim/contact/contact_geometry.h"
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
  using A = ScalarArithmetic;
  LANES(c) {
    const Vector3<Real> apart{b.nx[c], b.ny[c], b.nz[c]};
    Real distance;
    const Vector3<Real> n = times(inverseDistance<A>(apart, distance), apart);
    Vector3<Real> roll{};
    Real arm = 1;
    if constexpr (turning) {
      roll = {p.rollX[c], p.rollY[c], p.rollZ[c]};
      // Contact arms over radii add up to the distance, so angular momentum is kept.
      if (!radiusArm) arm = distance / p.sum[c];
    }
    const ContactMotion<Real> contact =
        contactMotion<A, turning>(n, Vector3<Real>{b.vtx[c], b.vty[c], b.vtz[c]}, roll, arm);
    b.nx[c] = n.x;
    b.ny[c] = n.y;
    b.nz[c] = n.z;
    b.overlap[c] = p.sum[c] - distance;
    b.vn[c] = contact.vn;
    b.vtx[c] = contact.slip.x;
    b.vty[c] = contact.slip.y;
    b.vtz[c] = contact.slip.z;
    p.arm[c] = arm;
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
  if (v.reads & LawColumns::effectiveRadius) {
    if (v.quads > 2)
      LANES(c) b.effectiveRadius[c] = 1.0 / p.inverseRadii[c];
    else
      LANES(c) b.effectiveRadius[c] = 1.0 / (1.0 / b.radiusA[c] + 1.0 / b.radiusB[c]);
  }
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
  b.type[0] = v.oneType;
  if (!v.oneMaterial)
    for (int c = 0; c < b.size; ++c)
      b.type[c] = v.material[pairs[2 * c]] * v.materials + v.material[pairs[2 * c + 1]];
}

inline void fillHistory(const ParticleView& v, std::int64_t first, ContactBlock& b) {
  constexpr int lanes = ParticleView::lane;
  const auto copy = [&](const auto* all) {
    for (int c = 0; c < b.size; c += lanes) {
      const auto* from = all + (first + c) * v.historySize;
      for (int k = 0; k < v.historySize; ++k)
        for (int l = 0; l < lanes; ++l)
          b.history[k][c + l] = from[k * lanes + l];
    }
  };
  v.mixed ? copy(reinterpret_cast<const float*>(v.history)) : copy(v.history);
}

inline void writeHistory(const ParticleView& v, std::int64_t first, const ContactBlock& b) {
  constexpr int lanes = ParticleView::lane;
  for (int c = 0; c < b.size; c += lanes) {
    double* to = v.history + (first + c) * v.historySize;
    for (int k = 0; k < v.historySize; ++k)
      for (int l = 0; l < lanes; ++l)
        to[k * lanes + l] = b.history[k][c + l];
  }
}

/// Force on a, and what turns either grain.
struct OutputColumns {
  alignas(64) double fx[64], fy[64], fz[64], tx[64], ty[64], tz[64];
  alignas(64) double overlap[64]{}; ///< zero where nobody sums it
};

inline void outputs(const ParticleView& v, const ContactBlock& b, const PairColumns& p, OutputColumns& o) {
  using A = ScalarArithmetic;
  LANES(c) {
    const Vector3<double> n{b.nx[c], b.ny[c], b.nz[c]}, tangential{b.ftx[c], b.fty[c], b.ftz[c]};
    const Vector3<double> force = plus<A>(tangential, b.normalForce[c], n);
    o.fx[c] = force.x;
    o.fy[c] = force.y;
    o.fz[c] = force.z;
  }
  if (v.sumsOverlaps) LANES(c) o.overlap[c] = b.overlap[c] > 0.0 ? b.overlap[c] : 0.0;
  if (v.ownTorque) LANES(c) {
      o.tx[c] = b.mx[c] / b.radiusA[c];
      o.ty[c] = b.my[c] / b.radiusA[c];
      o.tz[c] = b.mz[c] / b.radiusA[c];
    }
  else if (v.outputQuads > 1)
    LANES(c) {
      const Vector3<double> n{b.nx[c], b.ny[c], b.nz[c]}, tangential{b.ftx[c], b.fty[c], b.ftz[c]};
      const Vector3<double> torque = contactTorque<A>(n, p.arm[c], tangential);
      o.tx[c] = torque.x;
      o.ty[c] = torque.y;
      o.tz[c] = torque.z;
    }
}

} // namespace

} // namespace sandglass
