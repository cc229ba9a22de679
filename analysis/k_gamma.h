#pragma once
// The k-gamma law of cell volumes in packings (Aste & Di Matteo, Phys. Rev. E 77, 021309, 2008):
//   f(V) = k^k / Gamma(k) (V - V_min)^(k-1) / (V_mean - V_min)^k exp(-k (V - V_min) / (V_mean - V_min))
// with k = (V_mean - V_min)^2 / variance.

#include <span>

namespace sandglass::analysis {

struct KGamma {
  double k = 0, kError = 0; ///< standard error from the fourth moment of independent values
  double minimum = 0, mean = 0;
  double density(double v) const;
};

/// By moments; NaN for fewer than three values or without spread.
KGamma fitKGamma(std::span<const double> volumes, double minimum);

/// Least volume of the Voronoi cell of a sphere in any packing of equal spheres of diameter 1: that of the
/// regular dodecahedron around it, 5^(5/4) / sqrt(2 (29 + 13 sqrt(5))) = 0.69379 (Hales & McLaughlin 2010).
inline constexpr double dodecahedronVolume = 0.6937863785644388;

} // namespace sandglass::analysis
