#include "analysis/statistics.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::analysis {

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double v : values)
    sum += v;
  return sum / static_cast<double>(values.size());
}

double variance(std::span<const double> values) {
  if (values.size() < 2) return 0;
  const double m = mean(values);
  double sum = 0;
  for (const double v : values)
    sum += (v - m) * (v - m);
  return sum / static_cast<double>(values.size() - 1);
}

double blockedStandardError(std::span<const double> values) {
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> blocks(values.begin(), values.end());
  double error = std::sqrt(variance(blocks) / static_cast<double>(blocks.size()));
  while (blocks.size() >= 16) {
    const std::size_t half = blocks.size() / 2;
    for (std::size_t b = 0; b < half; ++b)
      blocks[b] = 0.5 * (blocks[2 * b] + blocks[2 * b + 1]);
    blocks.resize(half);
    error = std::max(error, std::sqrt(variance(blocks) / static_cast<double>(half)));
  }
  return error;
}

double correlationTime(std::span<const double> values) {
  const std::size_t n = values.size();
  if (n < 4) return 1;
  const double m = mean(values);
  const auto covariance = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = 0; i + lag < n; ++i)
      sum += (values[i] - m) * (values[i + lag] - m);
    return sum / static_cast<double>(n);
  };
  const double c0 = covariance(0);
  if (!(c0 > 0)) return 1;
  double sum = 0;
  for (std::size_t k = 0; 2 * k + 1 < n / 2; ++k) {
    const double pair = (covariance(2 * k) + covariance(2 * k + 1)) / c0;
    if (pair <= 0) break;
    sum += pair;
  }
  return std::max(1.0, 2 * sum - 1);
}

double studentFactor(double confidence, double degreesOfFreedom) {
  return boost::math::quantile(boost::math::students_t(degreesOfFreedom), 0.5 + 0.5 * confidence);
}

double chiSquaredProbability(double chiSquared, double degreesOfFreedom) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degreesOfFreedom), chiSquared));
}

Line fitLine(std::span<const double> x, std::span<const double> y) {
  const double n = static_cast<double>(x.size()), mx = mean(x), my = mean(y);
  double sxx = 0, sxy = 0, syy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - mx) * (x[i] - mx);
    sxy += (x[i] - mx) * (y[i] - my);
    syy += (y[i] - my) * (y[i] - my);
  }
  Line line;
  line.slope = sxy / sxx;
  line.intercept = my - line.slope * mx;
  // Residuals summed afresh: syy - sxy^2/sxx loses all digits for nearly exact lines.
  double residual = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    residual += std::pow(y[i] - line.at(x[i]), 2);
  line.r2 = syy > 0 ? 1 - residual / syy : 1;
  if (x.size() > 2) {
    const double s2 = residual / (n - 2);
    line.slopeError = std::sqrt(s2 / sxx);
    line.interceptError = std::sqrt(s2 * (1 / n + mx * mx / sxx));
    line.covariance = -s2 * mx / sxx;
  }
  return line;
}

} // namespace sandglass::analysis
