#include "analysis/statistics.h"
#include "sim/base/random.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::analysis;

TEST_CASE("quantiles are those of the tables", "[statistics]") {
  CHECK(studentFactor(0.95, 10) == Approx(2.228139).epsilon(1e-6)); // Abramowitz & Stegun, table 26.10
  CHECK(chiSquaredProbability(18.307038, 10) == Approx(0.05).epsilon(1e-6));
}

TEST_CASE("a straight line is found exactly, its errors by the textbook", "[statistics]") {
  const std::vector<double> x{1, 2, 3, 4};
  const std::vector<double> exact{5, 7, 9, 11};
  CHECK(fitLine(x, exact).slope == Approx(2));
  CHECK(fitLine(x, exact).intercept == Approx(3));
  CHECK(fitLine(x, exact).r2 == 1);
  // By hand: slope 1.1, intercept 1, residuals -0.1 0.8 -1.3 0.6: sum of squares 2.7, s^2 = 1.35, sxx = 5,
  // syy = 8.75.
  const std::vector<double> noisy{2, 4, 3, 6};
  const Line line = fitLine(x, noisy);
  CHECK(line.slope == Approx(1.1));
  CHECK(line.intercept == Approx(1.0));
  CHECK(line.slopeError == Approx(std::sqrt(1.35 / 5)));
  CHECK(line.r2 == Approx(1 - 2.7 / 8.75));
}

TEST_CASE("blocking sees correlation", "[statistics]") {
  // AR(1) with coefficient 0.9: the variance of the mean is (1 + 0.9) / (1 - 0.9) = 19 times that of
  // independent values, the correlation time 19 samples.
  RandomStream random(5, RandomPurpose::test, 1);
  std::vector<double> values(1 << 15);
  double v = 0;
  for (auto& out : values)
    out = v = 0.9 * v + std::sqrt(1 - 0.81) * random.normal();
  const double expected = std::sqrt(19.0 / static_cast<double>(values.size()));
  // The largest of the block errors, eight blocks at least: biased upwards by up to some tens of per cent.
  CHECK(blockedStandardError(values) > 0.8 * expected);
  CHECK(blockedStandardError(values) < 2.0 * expected);
  CHECK(correlationTime(values) == Approx(19).epsilon(0.25));
}
