// Discharge curves with a planted rate.

#include "analysis/discharge.h"
#include "sim/base/error.h"
#include "sim/base/random.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sandglass;
using namespace sandglass::analysis;

namespace {

constexpr double planted = 0.08; // kg/s

/// Opening delay, start-up over 0.1 s, an even stretch of 4 s, a tail that dies out. The rate fluctuates with
/// relative strength `flow` about its mean (correlated over `memory` seconds), the balance adds `balance` kg.
DischargeData curve(std::uint64_t seed, double flow, double memory, double balance) {
  RandomStream random(seed, RandomPurpose::test, 2);
  DischargeData data;
  const double dt = 0.01;
  double mass = 0, fluctuation = 0;
  const double keep = memory > 0 ? std::exp(-dt / memory) : 0;
  for (double t = 0; t < 7; t += dt) {
    fluctuation = keep * fluctuation + std::sqrt(1 - keep * keep) * random.normal();
    double shape = 0;
    if (t > 0.2) shape = std::min(1.0, (t - 0.2) / 0.1);
    if (t > 4.2) shape = std::exp(-(t - 4.2) / 0.25);
    mass += planted * shape * (1 + flow * fluctuation) * dt;
    data.time.push_back(t + dt);
    data.mass.push_back(mass + balance * random.normal());
  }
  return data;
}

/// Share of seeds whose 95 % interval holds the planted rate, and the mean relative bias.
std::pair<double, double> coverage(double flow, double memory, double balance) {
  constexpr int seeds = 500;
  int covered = 0;
  double bias = 0;
  for (int s = 0; s < seeds; ++s) {
    const auto fit = fitDischarge(curve(s, flow, memory, balance));
    covered += std::abs(fit.rate - planted) <= fit.halfWidth;
    bias += (fit.rate / planted - 1) / seeds;
  }
  return {static_cast<double>(covered) / seeds, bias};
}

} // namespace

TEST_CASE("an even discharge without noise", "[discharge]") {
  const auto fit = fitDischarge(curve(1, 0, 0, 0));
  // The even stretch is 0.3 s to 4.2 s. Parts are 1/40 of the mass, 0.1 s each; one is given up at either
  // end.
  CHECK(fit.rate == Approx(planted).epsilon(1e-3));
  CHECK(fit.startTime > 0.25);
  CHECK(fit.startTime < 0.6);
  CHECK(fit.endTime > 3.9);
  CHECK(fit.endTime < 4.3);
  CHECK(fit.r2 > 0.99999);
}

TEST_CASE("the 95 % interval holds the planted rate in 95 % of cases", "[discharge]") {
  // 500 seeds: the binomial standard deviation is 1 %; three of them either side of 95 %.
  SECTION("rate with white noise") {
    const auto [share, bias] = coverage(0.3, 0, 0);
    INFO("coverage " << share << " bias " << bias);
    CHECK(share > 0.92);
    CHECK(share < 0.98);
    CHECK(std::abs(bias) < 0.002);
  }
  SECTION("rate with memory") {
    const auto [share, bias] = coverage(0.1, 0.03, 0);
    INFO("coverage " << share << " bias " << bias);
    CHECK(share > 0.92);
    CHECK(share < 0.98);
    CHECK(std::abs(bias) < 0.002);
  }
  SECTION("noise of the balance alone: the interval is wider than needed") {
    const auto [share, bias] = coverage(0, 0, 2e-4);
    INFO("coverage " << share << " bias " << bias);
    CHECK(share > 0.95);
    CHECK(std::abs(bias) < 0.002);
  }
}

TEST_CASE("a range that the user fixes", "[discharge]") {
  DischargeOptions options;
  options.shares = {0.1, 0.5};
  options.depth = 0.0056;
  const auto data = curve(1, 0, 0, 0);
  const auto fit = fitDischarge(data, options);
  CHECK(fit.startMass == Approx(0.1 * data.mass.back()));
  CHECK(fit.endMass == Approx(0.5 * data.mass.back()));
  const Curve c = dischargeCurve(data, fit, options);
  CHECK(c.numbers.at("rate_per_depth") == Approx(planted / 0.0056).epsilon(1e-3));
  options.totalMass = 10 * data.mass.back();
  CHECK_THROWS_WITH(fitDischarge(data, options), Catch::Contains("only 0.1 of the mass was discharged"));
}

TEST_CASE("no rate without a discharge", "[discharge]") {
  CHECK_THROWS_AS(fitDischarge({{1, 2, 3}, {0, 1, 2}}), InputError);
  CHECK_THROWS_WITH(fitDischarge({std::vector<double>(20, 1.0), std::vector<double>(20, 0.0)}),
                    Catch::Contains("nothing was discharged"));
}
