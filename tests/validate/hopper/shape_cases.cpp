// V12 to V14: diameter, depth and rolling resistance, half angle.

#include "tests/validate/hopper/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::validate {

namespace {

HopperBed shorter() {
  HopperBed bed = baseBed();
  bed.emptied = false;
  return bed;
}

/// The same bed of grains 30 % smaller: depth and rolling length in proportion.
HopperBed finer() {
  HopperBed bed = shorter();
  const double scale = 1.57e-3 / bed.diameter;
  bed.diameter = 1.57e-3;
  bed.depth *= scale;
  bed.rollingLength *= scale;
  bed.number = static_cast<int>(std::lround(bed.number / (scale * scale)));
  return bed;
}

HopperBed deeper() {
  HopperBed bed = shorter();
  bed.depth *= 2;
  bed.number *= 2;
  return bed;
}

HopperBed rolling(double times) {
  HopperBed bed = shorter();
  bed.rollingLength *= times;
  return bed;
}

HopperBed angled(double degrees) {
  HopperBed bed = degrees == 90 ? baseBed() : shorter();
  bed.halfAngle = degrees;
  return bed;
}

const std::vector<double> angles{90, 75, 60, 55, 45, 30, 15};

/// Slot law: rate per depth with grains of d1 over that with grains of d2.
double lawRatio(double k, double d1, double d2) {
  return std::pow((baseBed().outlet - k * d1) / (baseBed().outlet - k * d2), 1.5);
}

void judgeDiameter(const HopperRuns& runs, Report& report) {
  const std::string name = "V12 diameter";
  const Mean q = runs.ratio(finer(), baseBed());
  report.between(name, "rate at d = 1.57 mm over that at 2.24 mm", q.value, q.halfWidth, 1, 1.14,
                 "1.03 (Anand 2009); 1.116 (an independent small program)");
  const double k = fittedK(runs), law = lawRatio(k, finer().diameter, baseBed().diameter);
  report.between(name, fmt::format("the same over the slot law with k = {:.2f} of V6", k), q.value / law,
                 q.halfWidth / law, 0.96, 1.04, "slot law");
  analysis::Curve curve;
  curve.name = "V12";
  curve.title = "V12: rate against the diameter";
  curve.definition = "outlet 2.5 cm, depth 2.5 diameters, rolling length in proportion";
  curve.x = {"diameter", "mm"};
  curve.y = {"rate per depth", "g/(cm s)"};
  curve.series = {measuredSeries(runs, {finer(), baseBed()}, {1.57, 2.24})};
  analysis::Series line{fmt::format("slot law, k = {:.2f}", k), {}, {}, {}};
  for (double d = 1.5e-3; d < 2.3e-3; d += 0.1e-3) {
    line.x.push_back(1e3 * d);
    line.y.push_back(runs.rate(baseBed()).value * lawRatio(k, d, baseBed().diameter));
  }
  curve.series.push_back(line);
  report.curves.push_back(curve);
}

void judgeDepth(const HopperRuns& runs, Report& report) {
  const std::string name = "V13 depth and rolling";
  const Mean q = runs.ratio(deeper(), baseBed());
  report.near(name, "rate per depth at 5 d over that at 2.5 d", q.value, q.halfWidth, 1, 0.05,
              "insensitive (Anand 2009); 0.97 (an independent small program)");
  const std::string why = "recorded: the source's claim contradicts its own law";
  for (const double times : {0.0, 0.5, 2.0}) {
    const Mean r = runs.ratio(rolling(times), baseBed());
    report.recorded(name, fmt::format("rate at {:g} times the rolling length over the base", times), r.value,
                    r.halfWidth, times == 0 ? "1.12" : "1",
                    times == 0 ? "an independent small program" : "insensitive (Anand 2009)", why);
  }
  analysis::Curve curve;
  curve.name = "V13";
  curve.title = "V13: rate against the rolling resistance";
  curve.definition =
      "rolling length over that of the base case, 0.1 mm; mean and 95 % interval over the seeds";
  curve.x = {"rolling length / 0.1 mm", ""};
  curve.y = {"rate per depth", "g/(cm s)"};
  curve.series = {measuredSeries(runs, {rolling(0), rolling(0.5), baseBed(), rolling(2)}, {0, 0.5, 1, 2})};
  report.curves.push_back(curve);
}

void judgeAngle(const HopperRuns& runs, Report& report) {
  const std::string name = "V14 half angle";
  std::vector<HopperBed> beds;
  std::vector<double> ratios;
  for (const double a : angles) {
    beds.push_back(angled(a));
    const Mean q = runs.ratio(beds.back(), baseBed());
    ratios.push_back(q.value);
    const std::string quantity = fmt::format("rate at {:g}° over that at 90°", a);
    if (a == 90) continue;
    if (a >= 55)
      report.near(name, quantity, q.value, q.halfWidth, 1, 0.05,
                  a == 55 ? "0.984 (Anand 2009, table 4-3)" : "flat down to 55° (Anand 2009)");
    else if (a == 45)
      report.recorded(name, quantity, q.value, q.halfWidth, "between those at 55° and 30°", "Anand 2009",
                      "no number in the source");
    else
      report.between(name, quantity, q.value, q.halfWidth, a == 30 ? 1.15 : 1.5, a == 30 ? 1.4 : 1.85,
                     a == 30 ? "Rose and Tanaka 1959: 1.21 to 1.37" : "Rose and Tanaka 1959: 1.59 to 1.80");
  }
  const std::size_t n = ratios.size();
  report.between(name, "smallest step up from 45° to 30° to 15°",
                 std::min(ratios[n - 2] - ratios[n - 3], ratios[n - 1] - ratios[n - 2]), 0, 0, unbounded,
                 "monotone below 45° (Anand 2009)");
  analysis::Curve curve;
  curve.name = "V14";
  curve.title = "V14: rate against the half angle of the hopper";
  curve.definition =
      "half angle from the vertical, 90 degrees is a flat floor; Rose-Tanaka: (tan tan phi)^-0.35";
  curve.x = {"half angle", "deg"};
  curve.y = {"rate per depth", "g/(cm s)"};
  analysis::Series measured = measuredSeries(runs, beds, angles);
  for (auto* v : {&measured.x, &measured.y, &measured.error})
    std::reverse(v->begin(), v->end());
  curve.series = {measured};
  for (const double phi : {35.0, 45.0}) {
    analysis::Series law{fmt::format("Rose and Tanaka, {:g} deg", phi), {}, {}, {}};
    const double degree = std::acos(-1.0) / 180;
    for (double a = 15; a < 90; a += 2.5) {
      law.x.push_back(a);
      law.y.push_back(runs.rate(baseBed()).value *
                      std::max(1.0, std::pow(std::tan(a * degree) * std::tan(phi * degree), -0.35)));
    }
    curve.series.push_back(law);
  }
  report.curves.push_back(curve);
}

} // namespace

std::vector<HopperCase> shapeCases() {
  std::vector<HopperBed> diameters = outletBeds(), slopes;
  diameters.push_back(finer());
  for (const double a : angles)
    slopes.push_back(angled(a));
  return {{"V12", "diameter", diameters, judgeDiameter},
          {"V13",
           "depth and rolling resistance",
           {baseBed(), deeper(), rolling(0), rolling(0.5), rolling(2)},
           judgeDepth},
          {"V14", "half angle", slopes, judgeAngle}};
}

} // namespace sandglass::validate
