// V7 to V10: fill height and friction, friction of grains and walls, restitution.

#include "tests/validate/hopper/cases.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::validate {

namespace {

HopperBed with(double friction, double wallFriction, int times = 1) {
  HopperBed bed = baseBed();
  bed.friction = friction;
  bed.wallFriction = wallFriction;
  bed.number *= times;
  bed.emptied = bed.key() == baseBed().key();
  return bed;
}

HopperBed lossy() {
  HopperBed bed = baseBed();
  bed.emptied = false;
  bed.unloading = bed.wallUnloading = 4 * loadingStiffness;
  return bed;
}

const std::vector<double> heightFrictions{0.05, 0.2, 0.84};
const std::vector<double> frictions{0.05, 0.1, 0.2, 0.5, 0.84};

void judgeHeight(const HopperRuns& runs, Report& report) {
  const std::string name = "V7 fill height";
  analysis::Curve curve;
  curve.name = "V7";
  curve.title = "V7: rate against the height of the filling";
  curve.definition = "3500 and 7000 grains; mean and 95 % interval over the seeds";
  curve.x = {"fill height / bin width", ""};
  curve.y = {"rate per depth", "g/(cm s)"};
  for (const double mu : heightFrictions) {
    const HopperBed low = with(mu, mu), high = with(mu, mu, 2);
    const Mean q = runs.ratio(high, low);
    const std::string quantity = fmt::format("rate at twice the filling over once, friction {:g}", mu);
    if (mu < 0.15)
      report.between(name, quantity, q.value, q.halfWidth, 1.08, unbounded,
                     "rises with the height below friction 0.15 (Anand 2009)");
    else
      report.near(name, quantity, q.value, q.halfWidth, 1, 0.06,
                  "independent of it from 0.2 on (Anand 2009)");
    std::vector<double> heights;
    for (const HopperBed& bed : {low, high}) {
      std::vector<double> h;
      for (const HopperRun& r : runs.of(bed))
        h.push_back(r.fillHeight / bed.width);
      heights.push_back(meanOf(h).value);
    }
    curve.series.push_back(measuredSeries(runs, {low, high}, heights));
    curve.series.back().name = fmt::format("friction {:g}", mu);
  }
  report.curves.push_back(curve);
}

void judgeFriction(const HopperRuns& runs, Report& report) {
  const std::string name = "V8 friction";
  std::vector<HopperBed> beds;
  double worst = -unbounded; // largest rise from one friction to the next higher
  for (const double mu : frictions) {
    beds.push_back(with(mu, mu));
    if (beds.size() > 1) worst = std::max(worst, runs.ratio(beds.back(), beds[beds.size() - 2]).value);
  }
  report.between(name, "largest ratio of the rates of neighbouring frictions (falls throughout)", worst, 0, 0,
                 1, "monotone fall (Anand 2009)");
  const Mean q = runs.ratio(beds.back(), with(0.2, 0.2));
  report.between(name, "rate at friction 0.84 over that at 0.2", q.value, q.halfWidth, 0.74, 0.86,
                 "0.80 ± 0.06 (an independent small program)");
  analysis::Curve curve;
  curve.name = "V8";
  curve.title = "V8: rate against friction";
  curve.definition = "the same friction among grains and on walls; mean and 95 % interval over the seeds";
  curve.x = {"friction", ""};
  curve.y = {"rate per depth", "g/(cm s)"};
  curve.series = {measuredSeries(runs, beds, frictions),
                  {"independent small program", {0.05, 0.2, 0.84}, {174, 141, 112}, {}}};
  report.curves.push_back(curve);
}

void judgePairs(const HopperRuns& runs, Report& report) {
  const std::string name = "V9 friction pairs";
  const std::vector<HopperBed> beds{with(0.2, 0.2), with(0.2, 0.84), with(0.84, 0.2), with(0.84, 0.84)};
  const Mean smooth = runs.ratio(beds[1], beds[0]), rough = runs.ratio(beds[2], beds[3]);
  report.near(name, "walls 0.84 over 0.2, grains 0.2", smooth.value, smooth.halfWidth, 1, 0.05,
              "friction among grains dominates (Anand 2009, table 4-1)");
  report.near(name, "walls 0.2 over 0.84, grains 0.84", rough.value, rough.halfWidth, 1, 0.05,
              "friction among grains dominates (Anand 2009, table 4-1)");
  const Mean drop = runs.ratio(beds[3], beds[0]);
  report.between(name, "both 0.84 over both 0.2", drop.value, drop.halfWidth, 0, 0.88,
                 "a drop of 12 % or more (Anand 2009, table 4-1)");
  analysis::Curve curve;
  curve.name = "V9";
  curve.title = "V9: friction among grains and on walls";
  curve.definition = "cases: 1 (0.2, 0.2), 2 (0.2, 0.84), 3 (0.84, 0.2), 4 (0.84, 0.84) of grains and walls";
  curve.x = {"case", ""};
  curve.y = {"rate per depth", "g/(cm s)"};
  curve.series = {measuredSeries(runs, beds, {1, 2, 3, 4})};
  report.curves.push_back(curve);
}

void judgeRestitution(const HopperRuns& runs, Report& report) {
  const Mean q = runs.ratio(lossy(), baseBed());
  report.near("V10 restitution", "rate at restitution 0.5 over that at 0.94", q.value, q.halfWidth, 1, 0.04,
              "negligible (Anand 2009); 1.2 % from 0.3 to 0.7 (literature)");
  analysis::Curve curve;
  curve.name = "V10";
  curve.title = "V10: rate against restitution";
  curve.definition = "restitution of grains; walls 0.5 and 0.90; mean and 95 % interval over the seeds";
  curve.x = {"restitution", ""};
  curve.y = {"rate per depth", "g/(cm s)"};
  curve.series = {measuredSeries(runs, {lossy(), baseBed()}, {0.5, 0.94}),
                  levelSeries("Anand 2009, base case", 0.5, 0.94, 140.4)};
  report.curves.push_back(curve);
}

} // namespace

std::vector<HopperCase> frictionCases() {
  std::vector<HopperBed> heights, singles;
  for (const double mu : heightFrictions)
    for (const int times : {1, 2})
      heights.push_back(with(mu, mu, times));
  for (const double mu : frictions)
    singles.push_back(with(mu, mu));
  return {{"V7", "fill height and friction", heights, judgeHeight},
          {"V8", "friction", singles, judgeFriction},
          {"V9",
           "friction pairs",
           {with(0.2, 0.2), with(0.2, 0.84), with(0.84, 0.2), with(0.84, 0.84)},
           judgePairs},
          {"V10", "restitution", {lossy(), baseBed()}, judgeRestitution}};
}

} // namespace sandglass::validate
