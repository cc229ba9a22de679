// Roots and powers of sim/base/math.h against the library's in extended precision.

#include "sim/base/math.h"
#include "sim/base/random.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sandglass;

namespace {

/// Difference in units of the last place of `exact` rounded to double.
double ulps(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double unit = std::nextafter(std::abs(rounded), INFINITY) - std::abs(rounded);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / unit);
}

} // namespace

TEST_CASE("the cube root is right to one unit in the last place, over all magnitudes") {
  RandomStream random(7, RandomPurpose::test, 0);
  double worst = 0.0;
  for (int k = 0; k < 200000; ++k) {
    const double x = std::ldexp(random.uniform(0.5, 1.0), static_cast<int>(random.uniform(-1020, 1020)));
    worst = std::max(worst, ulps(cubeRoot(x), std::cbrt(static_cast<long double>(x))));
  }
  CHECK(worst < 1.0);
  for (const double x : {1.0, 8.0, 27.0, 1e-9, 1e300})
    CHECK(ulps(cubeRoot(x), std::cbrt(static_cast<long double>(x))) < 1.0);
  CHECK(cubeRoot(0.0) == 0.0);
  CHECK(cubeRoot(-1.0) == 0.0);
}

TEST_CASE("powers of a share of one are right to 1e-14") {
  RandomStream random(7, RandomPurpose::test, 1);
  for (int k = 0; k < 50000; ++k) {
    const double x = random.uniform(), y = random.uniform(0.01, 10.0);
    const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
    REQUIRE(std::abs(powerOfShare(x, y) - exact) <= 1e-14L * exact);
  }
  CHECK(powerOfShare(0.0, 0.7) == 0.0);
  CHECK(powerOfShare(1.0, 0.7) == 1.0);
  CHECK(powerOfShare(0.25, 0.5) == Approx(0.5).epsilon(1e-15));
  CHECK(powerOfShare(1e-300, 9.0) == 0.0);
}
