#pragma once
// Discharge laws of the Beverloo family (Beverloo, Leniger & van de Velde, Chem. Eng. Sci. 15, 260, 1961) and
// the fit of one to rates at several outlet widths.

#include "analysis/result.h"

#include <span>
#include <vector>

namespace sandglass::analysis {

/// Slot: 1.03 rho sqrt(g) L (W0 - k d)^1.5 [kg/s] (Myers & Sellers 1977, quoted by Anand 2009); 0 where the
/// outlet is narrower than k d. rho: flowing density [kg/m^3]; `length` [m] is the depth of a periodic slot;
/// a slot that ends at walls loses k d of it (`endWalls`).
double slotRate(double flowingDensity, double gravity, double length, double outlet, double diameter,
                double k, double c = 1.03, bool endWalls = false);

/// Circular outlet: C rho sqrt(g) (D0 - k d)^2.5 [kg/s], rho the bulk density, usually C = 0.58, k = 1.5.
double circularRate(double bulkDensity, double gravity, double outlet, double diameter, double k = 1.5,
                    double c = 0.58);

enum class OutletShape { slot, circle };

/// One run. For a slot the rate is per unit depth [kg/(m s)], for a circle [kg/s].
struct OutletRate {
  double outlet = 0; ///< width or diameter [m]
  double rate = 0;
  double error = 0; ///< standard error of rate; drawn, not used as a weight
};

struct BeverlooFit {
  double slope = 0, slopeError = 0, intercept = 0, interceptError = 0; ///< of rate^p against the outlet
  double k = 0, kError = 0;                                            ///< - intercept / (slope d)
  double c = 0, cError = 0;                                            ///< slope^(1/p) / (rho sqrt g)
  double r2 = 0;
};

/// Straight line through rate^p against the outlet: p = 2/3 for a slot, 2/5 for a circle. Standard errors
/// from the residuals, carried to k and C to first order (zero for two points). Throws InputError for fewer
/// than two widths or rates that are not positive.
BeverlooFit fitBeverloo(std::span<const OutletRate> points, OutletShape shape, double diameter,
                        double density, double gravity);

/// rate^p against the outlet: the points, the fit, and the law with k = 1.5.
Curve beverlooCurve(std::span<const OutletRate> points, const BeverlooFit& fit, OutletShape shape,
                    double diameter, double density, double gravity);

} // namespace sandglass::analysis
