#include "sim/base/error.h"
#include "sim/grains/size_distribution.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace sandglass;

namespace {

Parameters parameters(std::map<std::string, double> numbers, const std::string& by = "number") {
  Parameters p;
  for (const auto& [name, value] : numbers)
    p.set(name, value);
  p.set("by", by);
  return p;
}

/// Draws many and compares mean d and mean d^3 with what the distribution states: within five standard
/// errors, which a right sampler misses once in 1.7 million.
void checkMoments(const SizeDistribution& sizes, int count = 200'000) {
  double first = 0, second = 0, third = 0, sixth = 0;
  const double unit = sizes.largest();
  for (int i = 0; i < count; ++i) {
    RandomStream random(11, RandomPurpose::test, static_cast<std::uint64_t>(i));
    const double d = sizes.draw(random);
    REQUIRE(d >= sizes.smallest());
    REQUIRE(d <= sizes.largest());
    const double x = d / unit, cube = x * x * x;
    first += x;
    second += x * x;
    third += cube;
    sixth += cube * cube;
  }
  const double n = count, mean = first / n, cube = third / n;
  const double errorMean = std::sqrt((second / n - mean * mean) / n),
               errorCube = std::sqrt((sixth / n - cube * cube) / n);
  CHECK(std::abs(mean - sizes.mean() / unit) < 5 * errorMean);
  CHECK(std::abs(cube - sizes.meanCube() / std::pow(unit, 3)) < 5 * errorCube);
}

} // namespace

TEST_CASE("single sizes", "[sizes]") {
  const auto sizes = makeSizeDistribution("single", parameters({{"diameter", 2e-3}}));
  RandomStream random(1, RandomPurpose::test, 0);
  CHECK(sizes->draw(random) == 2e-3);
  CHECK(sizes->mean() == 2e-3);
  CHECK(sizes->meanCube() == Approx(8e-9).epsilon(1e-15));
}

TEST_CASE("moments of uniform sizes", "[sizes]") {
  // By number: means of d and d^3 over [1, 3] are 2 and (81 - 1)/(4 * 2) = 10.
  const auto number = makeSizeDistribution("uniform", parameters({{"smallest", 1.0}, {"largest", 3.0}}));
  CHECK(number->mean() == Approx(2).epsilon(1e-12));
  CHECK(number->meanCube() == Approx(10).epsilon(1e-12));
  checkMoments(*number);
  // By mass: grains ~ d^-3, normalisation (1 - 1/9)/2 = 4/9; mean (1 - 1/3) * 9/4 = 1.5; mean cube 2 * 9/4.
  const auto mass =
      makeSizeDistribution("uniform", parameters({{"smallest", 1.0}, {"largest", 3.0}}, "mass"));
  CHECK(mass->mean() == Approx(1.5).epsilon(1e-10));
  CHECK(mass->meanCube() == Approx(4.5).epsilon(1e-10));
  checkMoments(*mass);
}

TEST_CASE("moments of normal sizes", "[sizes]") {
  // Cut at three deviations on both sides: the mean stays; <d^3> = m^3 + 3 m s^2 v with v the variance of the
  // cut normal, 1 - 2*3*phi(3)/(2*Phi(3) - 1) = 0.973336925.
  const auto sizes = makeSizeDistribution("normal", parameters({{"mean", 2.0}, {"deviation", 0.3}}));
  CHECK(sizes->smallest() == Approx(1.1));
  CHECK(sizes->largest() == Approx(2.9));
  CHECK(sizes->mean() == Approx(2).epsilon(1e-9));
  CHECK(sizes->meanCube() == Approx(8 + 6 * 0.09 * 0.973336925).epsilon(1e-8));
  checkMoments(*sizes);
  checkMoments(*makeSizeDistribution("normal", parameters({{"mean", 2.0}, {"deviation", 0.3}}, "mass")));
}

TEST_CASE("moments of lognormal sizes", "[sizes]") {
  // Cut so far out that the moments are those of the whole: exp(s^2/2) and exp(9 s^2/2).
  const std::map<std::string, double> wide{
      {"median", 1.0}, {"sigma", 0.2}, {"smallest", 0.1}, {"largest", 10.0}};
  const auto number = makeSizeDistribution("lognormal", parameters(wide));
  CHECK(number->mean() == Approx(std::exp(0.02)).epsilon(1e-9));
  CHECK(number->meanCube() == Approx(std::exp(0.18)).epsilon(1e-9));
  checkMoments(*number);
  // By mass the number median is exp(-3 s^2) (Hatch and Choate, J. Franklin Inst. 207, 369, 1929).
  const auto mass = makeSizeDistribution("lognormal", parameters(wide, "mass"));
  CHECK(mass->mean() == Approx(std::exp(-0.12 + 0.02)).epsilon(1e-9));
  CHECK(mass->meanCube() == Approx(std::exp(-0.36 + 0.18)).epsilon(1e-9));
  checkMoments(*mass);
}

TEST_CASE("moments of tabulated sizes", "[sizes]") {
  Parameters p = parameters({});
  p.set("diameters", std::vector<double>{1, 2});
  p.set("shares", std::vector<double>{1, 3});
  const auto number = makeSizeDistribution("table", p);
  CHECK(number->mean() == Approx(1.75));
  CHECK(number->meanCube() == Approx((1 + 3 * 8) / 4.0));
  checkMoments(*number);
  p.set("by", std::string("mass")); // grains in the ratio 1 : 3/8
  const auto mass = makeSizeDistribution("table", p);
  CHECK(mass->mean() == Approx((1 + 0.375 * 2) / 1.375));
  CHECK(mass->meanCube() == Approx(4 / 1.375)); // total mass over total number
  checkMoments(*mass);
}

TEST_CASE("sizes that contradict themselves are refused", "[sizes]") {
  CHECK_THROWS_AS(makeSizeDistribution("uniform", parameters({{"smallest", 2.0}, {"largest", 2.0}})),
                  InputError);
  CHECK_THROWS_AS(makeSizeDistribution("normal", parameters({{"mean", 1.0}, {"deviation", 0.5}})),
                  InputError);
  CHECK_THROWS_AS(
      makeSizeDistribution(
          "normal", parameters({{"mean", 1.0}, {"deviation", 0.1}, {"smallest", 2.0}, {"largest", 3.0}})),
      InputError);
  CHECK_THROWS_AS(makeSizeDistribution("gamma", parameters({})), InputError);
}
