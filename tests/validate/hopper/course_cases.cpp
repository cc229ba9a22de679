// V15, V25: how far the steady range reaches, and the heap that stays behind on the flat floor.

#include "analysis/statistics.h"
#include "tests/validate/hopper/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass::validate {

namespace {

double at(const std::vector<double>& x, const std::vector<double>& y, double where) {
  const auto k = std::lower_bound(x.begin(), x.end(), where) - x.begin();
  if (k == 0) return y.front();
  if (k == static_cast<std::ptrdiff_t>(x.size())) return y.back();
  const double part = (where - x[k - 1]) / (x[k] - x[k - 1]);
  return y[k - 1] + part * (y[k] - y[k - 1]);
}

constexpr double window = 0.04; ///< [s] over which a rate is taken
/// The rate below this share of the slope ends the steady range, as in analysis::fitDischarge.
constexpr double lastPart = 0.9;

/// Rate against time, by differences over the window.
analysis::Series rateSeries(const HopperRun& run) {
  analysis::Series s{fmt::format("seed {}", run.seed), {}, {}, {}};
  const auto& d = run.discharged;
  for (double t = run.opened + window; t + 0.5 * window < d.time.back(); t += 0.25 * window) {
    s.x.push_back(t);
    s.y.push_back((at(d.time, d.mass, t + 0.5 * window) - at(d.time, d.mass, t - 0.5 * window)) / window);
  }
  return s;
}

/// When the rate last was at its steady value, after half is out [s].
double endOfSteady(const HopperRun& run, double depth) {
  const analysis::Series s = rateSeries(run);
  double end = run.opened;
  for (std::size_t k = 0; k < s.x.size(); ++k)
    if (s.y[k] >= lastPart * run.rate * depth) end = s.x[k];
  return end;
}

void judgeCourse(const HopperRuns& runs, Report& report) {
  const HopperBed bed = baseBed();
  std::vector<double> heights, shares;
  analysis::Curve curve;
  curve.name = "V15";
  curve.title = "V15: rate against the height of the surface above the outlet";
  curve.definition = fmt::format(
      "rate over {:g} ms; height of the highest grain of the bed above the outlet's middle", 1e3 * window);
  curve.x = {"height above the outlet / outlet", ""};
  curve.y = {"rate per depth", "g/(cm s)"};
  for (const HopperRun& r : runs.of(bed)) {
    const double end = endOfSteady(r, bed.depth);
    heights.push_back(at(r.heightTime, r.heightAboveOutlet, end) / bed.outlet);
    shares.push_back(at(r.discharged.time, r.discharged.mass, end) / r.massEntered);
    analysis::Series s = rateSeries(r);
    std::vector<std::pair<double, double>> points;
    for (std::size_t k = 0; k < s.x.size(); ++k)
      points.emplace_back(at(r.heightTime, r.heightAboveOutlet, s.x[k]) / bed.outlet,
                          10 * s.y[k] / bed.depth);
    std::sort(points.begin(), points.end());
    for (std::size_t k = 0; k < points.size(); ++k)
      s.x[k] = points[k].first, s.y[k] = points[k].second;
    curve.series.push_back(s);
  }
  const Mean h = meanOf(heights), share = meanOf(shares);
  report.between("V15 end of the steady range",
                 "height of the surface above the outlet there, over the outlet", h.value, h.halfWidth, 0.3,
                 1.0, "about half an outlet (Anand 2009)");
  report.recorded("V15 end of the steady range", "share discharged there", share.value, share.halfWidth, "",
                  "", "no number in the source");
  curve.marks = {{"half an outlet", 0.5, true}, {"Anand 2009, base case", 140.4, false}};
  report.curves.push_back(curve);
}

struct Heap {
  double left = 0, right = 0; ///< [deg]
  analysis::Series tops;
};

/// Highest grain in bins one diameter wide on either side of the outlet, first and last bin left out, a line
/// through the others.
Heap heapOf(const HopperRun& run, const HopperBed& bed) {
  Heap heap;
  heap.tops.name = fmt::format("seed {}", run.seed);
  std::vector<std::pair<double, double>> all;
  for (const int side : {-1, 1}) {
    const double ledge = 0.5 * (bed.width - bed.outlet);
    const int bins = static_cast<int>(ledge / bed.diameter);
    std::vector<double> top(bins, 0.0), x, y;
    for (const Vec3& p : run.last->position) {
      const double out = side * p.x() - 0.5 * bed.outlet;
      const int k = static_cast<int>(out / bed.diameter);
      if (out >= 0 && k < bins && p.y() > 0) top[k] = std::max(top[k], p.y());
    }
    for (int k = 1; k + 1 < bins; ++k) {
      x.push_back((k + 0.5) * bed.diameter);
      y.push_back(top[k]);
      all.emplace_back(side * (0.5 * bed.outlet + x.back()), y.back());
    }
    const double angle = std::atan(analysis::fitLine(x, y).slope) * 180 / std::numbers::pi;
    (side < 0 ? heap.left : heap.right) = angle;
  }
  std::sort(all.begin(), all.end());
  for (const auto& [x, y] : all) {
    heap.tops.x.push_back(100 * x);
    heap.tops.y.push_back(100 * y);
  }
  return heap;
}

void judgeHeap(const HopperRuns& runs, Report& report) {
  const HopperBed bed = baseBed();
  std::vector<double> angles;
  analysis::Curve curve;
  curve.name = "V25";
  curve.title = "V25: surface of the heap left on the flat floor";
  curve.definition = "highest grain in bins one diameter wide";
  curve.x = {"x", "cm"};
  curve.y = {"height", "cm"};
  for (const HopperRun& r : runs.of(bed)) {
    const Heap heap = heapOf(r, bed);
    angles.push_back(0.5 * (heap.left + heap.right));
    curve.series.push_back(heap.tops);
  }
  const Mean mean = meanOf(angles);
  report.between(
      "V25 heap angle", "angle left on a flat floor [deg], both sides", mean.value, mean.halfWidth, 16.65,
      22.65, "19.65 simulated ± 3, 17 measured (Anand 2009, table 4-4); 22 (an independent small program)");
  report.curves.push_back(curve);
}

} // namespace

std::vector<HopperCase> courseCases() {
  return {{"V15", "end of the steady range", {baseBed()}, judgeCourse},
          {"V25", "heap left behind", {baseBed()}, judgeHeap}};
}

} // namespace sandglass::validate
