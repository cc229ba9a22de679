// V5, V6, V11: the base rate, the 3/2 power of the outlet, the width of the bin.

#include "analysis/beverloo.h"
#include "analysis/statistics.h"
#include "tests/validate/hopper/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::validate {

namespace {

constexpr double flowingFraction = 0.59; ///< of the source, in the slot law

analysis::BeverlooFit fitOutlets(const HopperRuns& runs, std::vector<analysis::OutletRate>& points) {
  for (const HopperBed& bed : outletBeds()) {
    const Mean rate = runs.rate(bed);
    points.push_back({bed.outlet, 0.1 * rate.value, 0.1 * rate.halfWidth / 1.96});
  }
  return analysis::fitBeverloo(points, analysis::OutletShape::slot, baseBed().diameter,
                               flowingFraction * glassDensity, standardGravity);
}

void judgeBase(const HopperRuns& runs, Report& report) {
  const Mean rate = runs.rate(baseBed());
  report.near(
      "V5 base rate", "rate per depth [g/(cm s)]", rate.value, rate.halfWidth, 140.4, 0.08,
      "simulation 140.4, experiment 139.4 ± 16.7 (Anand 2009, table 4-2); an independent small program 134 "
      "± 2 on this bed");
  const HopperRun& first = runs.of(baseBed()).front();
  analysis::DischargeOptions options;
  options.shares = {0.1, 0.5};
  options.totalMass = first.massEntered;
  options.depth = baseBed().depth;
  analysis::Curve curve =
      analysis::dischargeCurve(first.discharged, analysis::fitDischarge(first.discharged, options), options);
  curve.name = "V5";
  curve.title = "V5: mass discharged from the base bed, seed " + std::to_string(first.seed);
  report.curves.push_back(curve);
}

void judgeOutlets(const HopperRuns& runs, Report& report) {
  std::vector<analysis::OutletRate> points;
  const analysis::BeverlooFit fit = fitOutlets(runs, points);
  const std::string name = "V6 outlet width";
  report.between(name, "R² of rate^(2/3) against width", fit.r2, 0, 0.99, unbounded,
                 "scaling of Beverloo et al. 1961");
  report.near(name, "C at a flowing solid fraction of 0.59", fit.c, 2 * fit.cError, 1.03, 0.10,
              "Myers and Sellers 1977");
  report.between(name, "k", fit.k, 2 * fit.kError, 1.0, 2.4,
                 "1.3 (Anand 2009); 1.5 ± 0.1 (literature); 2.2 (an "
                 "independent small program)");
  std::vector<double> x, y;
  for (const auto& p : points) {
    x.push_back(std::log(p.outlet - fit.k * baseBed().diameter));
    y.push_back(std::log(p.rate));
  }
  const analysis::Line line = analysis::fitLine(x, y);
  report.between(name, "exponent of (outlet - k d)", line.slope, 2 * line.slopeError, 1.4, 1.6,
                 "3/2 of the slot law");
  analysis::Curve curve =
      analysis::beverlooCurve(points, fit, analysis::OutletShape::slot, baseBed().diameter,
                              flowingFraction * glassDensity, standardGravity);
  curve.name = "V6";
  curve.title = "V6: " + curve.title;
  report.curves.push_back(curve);
}

HopperBed wide(double width) {
  HopperBed bed = baseBed();
  bed.emptied = width == bed.width;
  bed.number = static_cast<int>(std::lround(bed.number * width / bed.width));
  bed.width = width;
  return bed;
}

const std::vector<double> binWidths{6.25e-2, 7.5e-2, 12.5e-2, 25e-2}; // 2.5, 3, 5, 10 outlets

/// From the opening until half the mass is out [s], mean of the seeds.
double halfTime(const HopperRuns& runs, const HopperBed& bed) {
  double sum = 0;
  for (const HopperRun& r : runs.of(bed)) {
    const auto& m = r.discharged.mass;
    const auto at = std::lower_bound(m.begin(), m.end(), 0.5 * r.massEntered) - m.begin();
    sum += r.discharged.time.at(at) - r.opened;
  }
  return sum / static_cast<double>(runs.seeds().size());
}

void judgeWidths(const HopperRuns& runs, Report& report) {
  const std::string name = "V11 bin width";
  std::vector<HopperBed> beds;
  for (const double width : binWidths) {
    beds.push_back(wide(width));
    if (width == baseBed().width) continue;
    const Mean q = runs.ratio(beds.back(), baseBed());
    report.near(name, fmt::format("rate at W/W0 = {:g} over that at 3", width / baseBed().outlet), q.value,
                q.halfWidth, 1, 0.06, "same rate for W/W0 > 2.5 (Anand 2009)");
  }
  report.near(name, "time to half discharged, W/W0 = 5 over 2.5",
              halfTime(runs, beds[2]) / halfTime(runs, beds[0]), 0, 2, 0.06,
              "double width lasts twice as long (Anand 2009)");
  analysis::Curve curve;
  curve.name = "V11";
  curve.title = "V11: rate against the width of the bin";
  curve.definition = "slope of discharged mass, 10 to 50 %, per depth; mean and 95 % interval over the seeds";
  curve.x = {"bin width / outlet", ""};
  curve.y = {"rate per depth", "g/(cm s)"};
  curve.series = {measuredSeries(runs, beds, {2.5, 3, 5, 10}),
                  levelSeries("Anand 2009, base case", 2.5, 10, 140.4)};
  report.curves.push_back(curve);
}

} // namespace

HopperBed baseBed() {
  HopperBed bed;
  bed.emptied = true;
  return bed;
}

std::vector<HopperBed> outletBeds() {
  std::vector<HopperBed> beds;
  for (const double outlet : {1.5e-2, 2.0e-2, 2.5e-2, 3.0e-2, 3.5e-2}) {
    HopperBed bed = baseBed();
    bed.emptied = outlet == bed.outlet;
    bed.outlet = outlet;
    if (outlet > 3e-2) { // the bin stays two and a half outlets wide, the bed as high
      bed.width = 2.5 * outlet;
      bed.number = static_cast<int>(std::lround(bed.number * bed.width / baseBed().width));
    }
    beds.push_back(bed);
  }
  return beds;
}

double fittedK(const HopperRuns& runs) {
  std::vector<analysis::OutletRate> points;
  return fitOutlets(runs, points).k;
}

analysis::Series measuredSeries(const HopperRuns& runs, const std::vector<HopperBed>& beds,
                                const std::vector<double>& x) {
  analysis::Series series{"ours", x, {}, {}};
  for (const HopperBed& bed : beds) {
    const Mean rate = runs.rate(bed);
    series.y.push_back(rate.value);
    series.error.push_back(rate.halfWidth);
  }
  return series;
}

analysis::Series levelSeries(const std::string& name, double low, double high, double value) {
  return {name, {low, high}, {value, value}, {}};
}

std::vector<HopperCase> rateCases() {
  std::vector<HopperBed> widths;
  for (const double width : binWidths)
    widths.push_back(wide(width));
  return {{"V5", "base rate", {baseBed()}, judgeBase},
          {"V6", "outlet width", outletBeds(), judgeOutlets},
          {"V11", "bin width", widths, judgeWidths}};
}

} // namespace sandglass::validate
