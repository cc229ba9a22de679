// V16: beads of two sizes.

#include "analysis/beverloo.h"
#include "tests/validate/hopper/cases.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass::validate {

namespace {

const std::vector<double> shares{0, 0.3, 0.6};

HopperBed mixed(double fines) {
  HopperBed bed = baseBed();
  bed.emptied = fines == 0;
  bed.finesShare = fines;
  return bed;
}

/// Humby, Tuzun and Yu (Chem. Eng. Sci. 53, 483, 1998) in the form that the source uses: k d becomes
/// Z = 2.1939 d_vm - 0.9 mm, d_vm = sum(x d^4) / sum(x d^3) with number fractions x, that is the mean
/// diameter by volume. The sign of the constant is the one that gives 1.8 d for 2.24 mm.
double humbyRate(double fines, double flowingDensity) {
  const double mean = (1 - fines) * baseBed().diameter + fines * baseBed().finesDiameter;
  const double z = 2.1939 * mean - 0.9e-3;
  return 10 * 1.03 * flowingDensity * std::sqrt(standardGravity) * std::pow(baseBed().outlet - z, 1.5);
}

void judge(const HopperRuns& runs, Report& report) {
  const std::string name = "V16 two sizes";
  std::vector<HopperBed> beds;
  analysis::Series law{"Humby et al. 1998, measured density", {}, {}, {}};
  for (const double share : shares) {
    beds.push_back(mixed(share));
    std::vector<double> density;
    for (const HopperRun& r : runs.of(beds.back()))
      density.push_back(r.flowingDensity);
    const double expected = humbyRate(share, meanOf(density).value);
    law.x.push_back(100 * share);
    law.y.push_back(expected);
    const Mean rate = runs.rate(beds.back());
    report.near(name, fmt::format("rate per depth [g/(cm s)], {:g} % fines", 100 * share), rate.value,
                rate.halfWidth, expected, 0.15, "Humby et al. 1998 with the flowing density measured here");
  }
  const Mean first = runs.rate(beds[0]), second = runs.rate(beds[1]), third = runs.rate(beds[2]);
  const double step1 = second.value - first.value, step2 = third.value - second.value;
  report.between(name, "rise of the rate from 0 to 30 % fines [g/(cm s)]", step1,
                 std::hypot(first.halfWidth, second.halfWidth), 0, unbounded,
                 "rises (Anand 2009); 15 (an independent small program)");
  report.between(name, "rise from 30 to 60 %", step2, std::hypot(third.halfWidth, second.halfWidth), 0, step1,
                 "rises ever more slowly (Anand 2009); 8 (an independent small program)");
  analysis::Curve curve;
  curve.name = "V16";
  curve.title = "V16: rate against the share of fines";
  curve.definition = "beads of 2.24 and 1.16 mm; share of the mass; mean and 95 % interval over the seeds";
  curve.x = {"fines", "%"};
  curve.y = {"rate per depth", "g/(cm s)"};
  curve.series = {measuredSeries(runs, beds, {0, 30, 60}),
                  law,
                  {"independent small program", {0, 30, 60}, {141, 156, 164}, {}}};
  report.curves.push_back(curve);
}

} // namespace

std::vector<HopperCase> mixtureCases() {
  std::vector<HopperBed> beds;
  for (const double share : shares)
    beds.push_back(mixed(share));
  return {{"V16", "two sizes", beds, judge}};
}

} // namespace sandglass::validate
