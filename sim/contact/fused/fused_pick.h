#pragma once
// Which combinations of laws have a loop, and which loop.

#include "sim/contact/fused/fused_loop.h"

namespace sandglass {

namespace {

/// The loop of a combination, or null.
template <class W> FusedLoop pickFusedLoop(const FusedLaws& laws) {
  using Normal = FusedLaws::Normal;
  using Tangential = FusedLaws::Tangential;
  constexpr Dashpot none = Dashpot::none, coefficient = Dashpot::coefficient;
  if (laws.rolling != FusedLaws::Rolling::none) return nullptr;
  if (laws.tangential == Tangential::none) {
    if (laws.normal == Normal::linear) return fusedLoop<W, Normal::linear, false, false, none>;
    if (laws.normal == Normal::linearOfMass) return fusedLoop<W, Normal::linearOfMass, false, false, none>;
    return nullptr;
  }
  if (laws.tangential != Tangential::spring) return nullptr;
  if (laws.dashpot == none) {
    if (laws.normal == Normal::linear)
      return laws.project ? fusedLoop<W, Normal::linear, true, true, none>
                          : fusedLoop<W, Normal::linear, true, false, none>;
    if (laws.normal == Normal::linearOfMass)
      return laws.project ? fusedLoop<W, Normal::linearOfMass, true, true, none>
                          : fusedLoop<W, Normal::linearOfMass, true, false, none>;
  }
  if (laws.dashpot == coefficient && !laws.project) {
    if (laws.normal == Normal::linear) return fusedLoop<W, Normal::linear, true, false, coefficient>;
    if (laws.normal == Normal::linearOfMass)
      return fusedLoop<W, Normal::linearOfMass, true, false, coefficient>;
    if (laws.normal == Normal::hertz) return fusedLoop<W, Normal::hertz, true, false, coefficient>;
  }
  return nullptr;
}

/// The loop of a spring, perhaps with rolling resistance, among grains of one or several materials, or null.
template <class W, FusedLaws::Rolling rolling, bool several> FusedLoop pickSpringLoop(const FusedLaws& laws) {
  using Normal = FusedLaws::Normal;
  constexpr Dashpot none = Dashpot::none, coefficient = Dashpot::coefficient;
  if (laws.tangential != FusedLaws::Tangential::spring || laws.project) return nullptr;
  if (laws.normal == Normal::linear && laws.dashpot == none)
    return fusedLoop<W, Normal::linear, true, false, none, rolling, several>;
  if (laws.normal == Normal::linear && laws.dashpot == coefficient)
    return fusedLoop<W, Normal::linear, true, false, coefficient, rolling, several>;
  if (laws.normal == Normal::linearOfMass && laws.dashpot == none)
    return fusedLoop<W, Normal::linearOfMass, true, false, none, rolling, several>;
  if (laws.normal == Normal::linearOfMass && laws.dashpot == coefficient)
    return fusedLoop<W, Normal::linearOfMass, true, false, coefficient, rolling, several>;
  if (laws.normal == Normal::hertz && laws.dashpot == coefficient)
    return fusedLoop<W, Normal::hertz, true, false, coefficient, rolling, several>;
  if (laws.normal == Normal::hertzOfSize && laws.dashpot == coefficient)
    return fusedLoop<W, Normal::hertzOfSize, true, false, coefficient, rolling, several>;
  return nullptr;
}

/// The same, whatever the rolling resistance.
template <class W, bool several> FusedLoop pickFrictionLoop(const FusedLaws& laws) {
  using Rolling = FusedLaws::Rolling;
  if (laws.rolling == Rolling::none) return pickSpringLoop<W, Rolling::none, several>(laws);
  if (laws.rolling == Rolling::elasticPlastic)
    return pickSpringLoop<W, Rolling::elasticPlastic, several>(laws);
  if (laws.rolling == Rolling::constantTorque)
    return pickSpringLoop<W, Rolling::constantTorque, several>(laws);
  return nullptr;
}

/// All loops of double precision.
template <class W> FusedLoop pickDoubleLoop(const FusedLaws& laws) {
  using Normal = FusedLaws::Normal;
  using Rolling = FusedLaws::Rolling;
  if (!laws.tables) {
    if (const FusedLoop spring = pickFrictionLoop<W, false>(laws)) return spring;
    return pickFusedLoop<W>(laws);
  }
  if (laws.tangential != FusedLaws::Tangential::none) return pickFrictionLoop<W, true>(laws);
  if (laws.normal == Normal::linear)
    return fusedLoop<W, Normal::linear, false, false, Dashpot::none, Rolling::none, true>;
  if (laws.normal == Normal::linearOfMass)
    return fusedLoop<W, Normal::linearOfMass, false, false, Dashpot::none, Rolling::none, true>;
  return nullptr;
}

/// As pickFusedLoop, and for what has none a loop that reads each pair's mass and has all dashpots: the same
/// forces, though not the bits of the laws one by one.
template <class W> FusedLoop pickGeneralLoop(const FusedLaws& laws) {
  using Normal = FusedLaws::Normal;
  using Tangential = FusedLaws::Tangential;
  if (const FusedLoop own = pickFusedLoop<W>(laws)) return own;
  if (laws.normal == Normal::other || laws.tangential == Tangential::other ||
      laws.rolling != FusedLaws::Rolling::none)
    return nullptr;
  const bool hertz = laws.normal == Normal::hertz;
  if (laws.tangential == Tangential::none) return fusedLoop<W, Normal::hertz, false, false, Dashpot::none>;
  if (laws.project)
    return hertz ? fusedLoop<W, Normal::hertz, true, true, Dashpot::rate>
                 : fusedLoop<W, Normal::linearOfMass, true, true, Dashpot::rate>;
  return hertz ? fusedLoop<W, Normal::hertz, true, false, Dashpot::rate>
               : fusedLoop<W, Normal::linearOfMass, true, false, Dashpot::rate>;
}

} // namespace

} // namespace sandglass
