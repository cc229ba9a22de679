#include "analysis/k_gamma.h"

#include "analysis/statistics.h"

#include <cmath>
#include <limits>

namespace sandglass::analysis {

double KGamma::density(double v) const {
  const double scale = mean - minimum;
  if (!(v > minimum) || !(scale > 0)) return 0;
  const double x = (v - minimum) / scale;
  return std::exp(k * std::log(k) - std::lgamma(k) + (k - 1) * std::log(x) - k * x) / scale;
}

KGamma fitKGamma(std::span<const double> volumes, double minimum) {
  KGamma fit{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(), minimum,
             analysis::mean(volumes)};
  const double var = variance(volumes), n = static_cast<double>(volumes.size());
  if (volumes.size() < 3 || !(var > 0)) return fit;
  fit.k = (fit.mean - minimum) * (fit.mean - minimum) / var;
  // Delta method: d ln k = 2 d mean / (mean - min) - d var / var, with var(d var) = (m4 - var^2) / n and
  // cov(d mean, d var) = m3 / n.
  double m3 = 0, m4 = 0;
  for (const double v : volumes) {
    const double d = v - fit.mean;
    m3 += d * d * d / n;
    m4 += d * d * d * d / n;
  }
  const double a = 2 / (fit.mean - minimum), b = -1 / var;
  fit.kError =
      fit.k * std::sqrt(std::max(0.0, (a * a * var + b * b * (m4 - var * var) + 2 * a * b * m3) / n));
  return fit;
}

} // namespace sandglass::analysis
