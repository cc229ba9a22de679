#include "analysis/beverloo.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {
double linearizing(OutletShape shape) {
  return shape == OutletShape::slot ? 2.0 / 3.0 : 2.0 / 5.0;
}
} // namespace

double slotRate(double flowingDensity, double gravity, double length, double outlet, double diameter,
                double k, double c, bool endWalls) {
  const double open = std::max(0.0, outlet - k * diameter);
  return c * flowingDensity * std::sqrt(gravity) *
         (endWalls ? std::max(0.0, length - k * diameter) : length) * std::pow(open, 1.5);
}

double circularRate(double bulkDensity, double gravity, double outlet, double diameter, double k, double c) {
  return c * bulkDensity * std::sqrt(gravity) * std::pow(std::max(0.0, outlet - k * diameter), 2.5);
}

BeverlooFit fitBeverloo(std::span<const OutletRate> points, OutletShape shape, double diameter,
                        double density, double gravity) {
  std::vector<double> x, y;
  for (const auto& p : points) {
    if (!(p.outlet > 0 && p.rate > 0))
      throw InputError(
          fmt::format("the outlet of {:.4g} m has the rate {:.4g}: a Beverloo fit needs positive ones",
                      p.outlet, p.rate));
    x.push_back(p.outlet);
    y.push_back(std::pow(p.rate, linearizing(shape)));
  }
  if (x.size() < 2 || *std::min_element(x.begin(), x.end()) == *std::max_element(x.begin(), x.end()))
    throw InputError("a Beverloo fit needs runs with at least two different outlets");
  const Line line = fitLine(x, y);
  BeverlooFit fit;
  fit.slope = line.slope;
  fit.slopeError = line.slopeError;
  fit.intercept = line.intercept;
  fit.interceptError = line.interceptError;
  fit.r2 = line.r2;
  fit.k = -line.intercept / (line.slope * diameter);
  // First order: (dk/k)^2 = (da/a)^2 + (db/b)^2 - 2 cov(a, b) / (a b), written without dividing by a.
  const double a = line.intercept, b = line.slope;
  const double variance =
      (line.interceptError * line.interceptError + a * a / (b * b) * line.slopeError * line.slopeError -
       2 * a / b * line.covariance) /
      (b * b * diameter * diameter);
  fit.kError = std::sqrt(std::max(0.0, variance));
  if (b > 0) {
    fit.c = std::pow(b, 1 / linearizing(shape)) / (density * std::sqrt(gravity));
    fit.cError = fit.c / linearizing(shape) * line.slopeError / b;
  }
  return fit;
}

Curve beverlooCurve(std::span<const OutletRate> points, const BeverlooFit& fit, OutletShape shape,
                    double diameter, double density, double gravity) {
  const bool slot = shape == OutletShape::slot;
  const double p = linearizing(shape);
  Curve curve;
  curve.name = "beverloo";
  curve.title = slot ? "Rate per depth to the power 2/3" : "Rate to the power 2/5";
  curve.definition = fmt::format(
      "line through rate^{} against the outlet; k = -intercept / (slope d), C = slope^{} / (rho sqrt g); "
      "rho = {:.5g} kg/m^3, d = {:.4g} m, g = {:.5g} m/s^2",
      slot ? "(2/3)" : "(2/5)", slot ? "1.5" : "2.5", density, diameter, gravity);
  curve.x = {slot ? "outlet width" : "outlet diameter", "m"};
  curve.y = slot ? Axis{"(rate / depth)^(2/3)", "(kg/(m s))^(2/3)"} : Axis{"rate^(2/5)", "(kg/s)^(2/5)"};
  Series measured{"runs", {}, {}, {}}, line{"fit", {}, {}, {}}, law{"law with k = 1.5", {}, {}, {}};
  std::vector<OutletRate> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.outlet < b.outlet; });
  for (const auto& q : sorted) {
    const double y = std::pow(q.rate, p);
    measured.x.push_back(q.outlet);
    measured.y.push_back(y);
    measured.error.push_back(p * y * q.error / q.rate);
    line.x.push_back(q.outlet);
    line.y.push_back(fit.intercept + fit.slope * q.outlet);
    const double rate = slot ? slotRate(density, gravity, 1, q.outlet, diameter, 1.5)
                             : circularRate(density, gravity, q.outlet, diameter);
    law.x.push_back(q.outlet);
    law.y.push_back(std::pow(rate, p));
  }
  curve.series = {measured, line, law};
  curve.numbers = {{"runs", static_cast<double>(points.size())},
                   {"k", fit.k},
                   {"k_error", fit.kError},
                   {"C", fit.c},
                   {"C_error", fit.cError},
                   {"r2", fit.r2},
                   {"slope", fit.slope},
                   {"slope_error", fit.slopeError},
                   {"intercept", fit.intercept},
                   {"intercept_error", fit.interceptError}};
  return curve;
}

} // namespace sandglass::analysis
