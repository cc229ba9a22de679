#pragma once
// What the rolling laws read of contact i of a block.

#include "sim/contact/contact_block.h"
#include "sim/contact/laws/rolling_formula.h"

namespace sandglass {

template <class Real> SANDGLASS_LOOP RollingPair<Real> rollingPair(const ContactBlockOf<Real>& b, int i) {
  const Vector3<Real> n{b.nx[i], b.ny[i], b.nz[i]}, spin{b.wx[i], b.wy[i], b.wz[i]};
  return {acrossNormal<ScalarArithmetic>(n, spin), b.effectiveRadius[i],
          rollingInverse(1 / b.radiusA[i], b.inverseMassA[i]) +
              rollingInverse(1 / b.radiusB[i], b.inverseMassB[i])};
}

} // namespace sandglass
