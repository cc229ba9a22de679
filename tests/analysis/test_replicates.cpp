// Statistics over seeds, by hand.

#include "analysis/replicates.h"
#include "sim/base/error.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sandglass;
using namespace sandglass::analysis;

TEST_CASE("mean, scatter and interval of four runs", "[replicates]") {
  const std::vector<double> values{1, 2, 3, 4};
  const Spread s = spreadOf(values);
  CHECK(s.count == 4);
  CHECK(s.mean == 2.5);
  CHECK(s.standardDeviation == Approx(std::sqrt(5.0 / 3)));
  // t = 3.182446 at three degrees of freedom (Abramowitz & Stegun, table 26.10).
  CHECK(s.halfWidth == Approx(3.182446 * std::sqrt(5.0 / 3) / 2).epsilon(1e-6));
  const std::vector<double> one{7};
  CHECK(spreadOf(one).mean == 7);
  CHECK(std::isnan(spreadOf(one).halfWidth)); // one run says nothing about the scatter
}

TEST_CASE("the summary counts the runs that give a quantity", "[replicates]") {
  std::vector<Replicate> runs(3);
  for (std::size_t k = 0; k < 3; ++k) {
    runs[k].seed = 5 + k;
    runs[k].quantities["mass"] = 1 + static_cast<double>(k);
  }
  runs[0].quantities["rate"] = 10;
  runs[1].quantities["rate"] = std::nan("");
  runs[2].quantities["rate"] = 14;
  const Table summary = replicateSummary(runs, {{"mass", "kg"}});
  REQUIRE(summary.rowNames == std::vector<std::string>{"mass [kg]", "rate"});
  CHECK(summary.rows[0][0] == 2);
  CHECK(summary.rows[0][1] == 1);
  CHECK(summary.rows[0][3] == 3);
  CHECK(summary.rows[1][0] == 12);
  CHECK(summary.rows[1][1] == Approx(std::sqrt(8.0)));
  CHECK(summary.rows[1][2] == Approx(12.7062047 * 2)); // t at one degree of freedom; sqrt(8)/sqrt(2) = 2
  CHECK(summary.rows[1][3] == 2);
  const std::string each = toCsv(replicateTable(runs, {{"mass", "kg"}}));
  CHECK(each.find("\nseed,mass [kg],rate\n5,1,10\n6,2,\n7,3,14\n") != std::string::npos);
  CHECK(toCsv(summary).find("\nquantity,mean,standard_deviation,half_width_95,runs\nmass [kg],2,1,") !=
        std::string::npos);
}

TEST_CASE("the mean discharge curve ends with the first run to end", "[replicates]") {
  std::vector<Replicate> runs(2);
  // Two straight lines, 1 kg/s and 3 kg/s, sampled at different times: their mean is 2 kg/s everywhere.
  runs[0].discharge = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  runs[1].discharge = {{0, 0.7, 1.6, 2.5}, {0, 2.1, 4.8, 7.5}};
  const Curve curve = meanDischarge(runs);
  REQUIRE(curve.series.size() == 3);
  const Series& mean = curve.series[0];
  CHECK(mean.x == std::vector<double>{0, 1, 2});
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(mean.y[i] == Approx(2 * mean.x[i]));
    // Two values t and 3t: standard deviation t sqrt 2, standard error t.
    CHECK(mean.error[i] == Approx(mean.x[i]));
    CHECK(curve.series[2].y[i] - curve.series[1].y[i] == Approx(2 * 12.7062047 * mean.x[i]));
  }
  CHECK_THROWS_AS(meanDischarge({Replicate{}}), InputError);
}
