#pragma once
// Means and lines with honest errors.

#include <span>
#include <vector>

namespace sandglass::analysis {

double mean(std::span<const double> values);

/// Sample variance (n - 1); 0 for fewer than two values.
double variance(std::span<const double> values);

/// Standard error of the mean of values that may be correlated in order: the largest over block lengths 1, 2,
/// 4, ... as long as eight blocks remain (Flyvbjerg & Petersen, J. Chem. Phys. 91, 461, 1989). NaN for fewer
/// than two values.
double blockedStandardError(std::span<const double> values);

/// Integrated autocorrelation time in samples (>= 1): 1 + 2 sum of rho(k), summed over the initial run of
/// positive pair sums (Geyer, Statist. Sci. 7, 473, 1992).
double correlationTime(std::span<const double> values);

/// The half width, in standard errors, of the two-sided Student interval. `confidence` in (0, 1).
double studentFactor(double confidence, double degreesOfFreedom);

/// Upper-tail probability of chi-squared.
double chiSquaredProbability(double chiSquared, double degreesOfFreedom);

/// Ordinary least squares y = intercept + slope x.
struct Line {
  double intercept = 0, slope = 0;
  double interceptError = 0, slopeError = 0; ///< standard errors, residuals taken as independent
  double covariance = 0;                     ///< of intercept and slope
  double r2 = 0;
  double at(double x) const { return intercept + slope * x; }
};
Line fitLine(std::span<const double> x, std::span<const double> y);

} // namespace sandglass::analysis
