#pragma once
// Two frames, or two runs, beside each other: grain by grain where ids agree, and as distributions.

#include "analysis/result.h"
#include "sim/frame/frame.h"

#include <span>
#include <vector>

namespace sandglass::analysis {

/// Two-sample Kolmogorov-Smirnov test: the largest distance of the two empirical distribution functions, and
/// the chance of a larger one when both samples are of one distribution (Stephens, J. R. Stat. Soc. B 32,
/// 115, 1970: the asymptotic law at (sqrt(n) + 0.12 + 0.11 / sqrt(n)) D, n = n1 n2 / (n1 + n2)). Values are
/// taken as independent; those of neighbouring grains are not, so that small chances are smaller than true.
struct TwoSampleTest {
  double distance = 0, probability = 1;
};
TwoSampleTest compareSamples(std::vector<double> a, std::vector<double> b);

struct FrameDifference {
  double time = 0;        ///< of the first [s]
  double timeGap = 0;     ///< second minus first [s]
  std::size_t common = 0; ///< grains of the same id
  double largest = 0,
         rms = 0;         ///< of position differences, by the nearest image [m]; NaN without common grains
  double velocityRms = 0; ///< [m/s]; NaN where one has no velocities
};
FrameDifference difference(const Frame& a, const Frame& b);

/// Rows of quantities: both means, the distance of the distributions, the chance of it. Every scalar that
/// both frames know (positions, speed, radius, ...), constant ones left out.
Table compareDistributions(const Frame& a, const Frame& b);

} // namespace sandglass::analysis
