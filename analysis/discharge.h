#pragma once
// The discharge rate of a vessel: mass that has left against time, the range in which it grows evenly, its
// slope there with a confidence interval.

#include "analysis/result.h"

#include <optional>
#include <utility>
#include <vector>

namespace sandglass::analysis {

/// Mass discharged [kg] at ascending times [s].
struct DischargeData {
  std::vector<double> time, mass;
};

struct DischargeOptions {
  /// Fixed range as shares of the total (0.1 to 0.5, say); absent: found from the curve itself.
  std::optional<std::pair<double, double>> shares;
  double totalMass = 0; ///< [kg] what the shares refer to; 0: all that was discharged in the data
  double depth = 0;     ///< [m]; > 0: the rate per unit depth of a slot is reported too
  double confidence = 0.95;
};

/// rate +- halfWidth is the confidence interval.
struct DischargeFit {
  double rate = 0, halfWidth = 0, standardError = 0; ///< [kg/s]
  double intercept = 0;                              ///< [kg], of the line mass = intercept + rate t
  double startTime = 0, endTime = 0;                 ///< [s]
  double startMass = 0, endMass = 0;                 ///< [kg]
  double r2 = 0;
  int blocks = 0;
};

/// Range, when not fixed: the mass is cut into up to 40 equal parts; the plateau is the median of their rates
/// between 20 and 60 % discharged; a part is even while the mean of three neighbours is within 10 % of the
/// plateau (or three robust standard deviations, if larger). From the middle outwards the range grows until
/// three parts in a row are uneven, and gives up one part at either end.
///
/// Slope: least squares. Error: slopes of 5 to 20 blocks of equal duration, each at least ten correlation
/// times of the rate, Student's t. For a rate that fluctuates this is the error of the long-time mean rate;
/// for a steady rate with noise on the mass alone it is larger than needed.
///
/// Throws InputError when too little was discharged or too few samples lie in the range.
DischargeFit fitDischarge(const DischargeData& data, const DischargeOptions& options = {});

/// Mass against time, the fitted line, the range as marks; numbers rate, rate_error_95, rate_per_depth, ...
Curve dischargeCurve(const DischargeData& data, const DischargeFit& fit,
                     const DischargeOptions& options = {});

} // namespace sandglass::analysis
