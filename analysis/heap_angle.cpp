#include "analysis/heap_angle.h"

#include "analysis/grain_sizes.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::analysis {

namespace {

constexpr double leastLedge = 8; ///< diameters
constexpr double degrees = 180 / std::numbers::pi;

struct Side {
  Series tops;
  Line line;
};

/// side: +1 or -1 along slot.across.
Side sideOf(const Frame& frame, const Slot& slot, double diameter, int side) {
  const auto& radius = frame.scalar(quantity::radius);
  const double inner = 0.5 * slot.outlet;
  const auto bins = static_cast<std::size_t>(std::floor((0.5 * slot.width - inner) / diameter * (1 + 1e-9)));
  constexpr double empty = -std::numeric_limits<double>::infinity();
  std::vector<double> top(bins, empty);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec3 d = frame.position[i] - slot.centre;
    const double bin = std::floor((side * d.dot(slot.across) - inner) / diameter);
    if (!(bin >= 0 && bin < static_cast<double>(bins))) continue;
    double& highest = top[static_cast<std::size_t>(bin)];
    highest = std::max(highest, d.dot(slot.up) + radius[i]);
  }
  Side result;
  result.tops.name = side < 0 ? "left" : "right";
  for (std::size_t b = 1; b + 1 < bins; ++b) {
    if (top[b] == empty) continue;
    result.tops.x.push_back(side * (inner + (static_cast<double>(b) + 0.5) * diameter));
    result.tops.y.push_back(top[b]);
  }
  if (result.tops.x.size() < 3)
    throw InputError(
        fmt::format("at {:.6g} s only {} of the bins {} of the outlet hold grains, but a slope needs 3; "
                    "choose a frame with a heap",
                    frame.time, result.tops.x.size(), result.tops.name));
  result.line = fitLine(result.tops.x, result.tops.y);
  return result;
}

} // namespace

Curve heapAngle(const Frame& frame, const HeapOptions& options) {
  const double diameter = options.diameter > 0 ? options.diameter : meanDiameter(frame);
  const Slot& slot = options.slot;
  const double ledge = 0.5 * (slot.width - slot.outlet);
  if (ledge < leastLedge * diameter * (1 - 1e-9))
    throw InputError(
        fmt::format("the ledge beside the outlet is {:.4g} m wide, {:.3g} grain diameters, but a heap "
                    "angle needs {} on each side; take a wider bin",
                    ledge, ledge / diameter, leastLedge));
  Curve curve;
  curve.name = "heap_angle";
  curve.title = "Heaps beside the outlet";
  curve.definition =
      fmt::format("highest grain in bins of {:.4g} m from the outlet's edge, first and last left out; "
                  "least-squares line per side; frame at {:.6g} s",
                  diameter, frame.time);
  curve.x = {"distance from the middle of the outlet", "m"};
  curve.y = {"height", "m"};
  curve.frames = 1;
  double sum = 0, squares = 0;
  for (const int side : {-1, 1}) {
    Side s = sideOf(frame, slot, diameter, side);
    const double slope = side * s.line.slope;
    const double angle = std::atan(slope) * degrees;
    const double error = s.line.slopeError / (1 + slope * slope) * degrees;
    curve.numbers["angle_" + s.tops.name] = angle;
    curve.numbers["angle_" + s.tops.name + "_error"] = error;
    sum += angle;
    squares += error * error;
    const std::vector<double> ends{s.tops.x.front(), s.tops.x.back()};
    curve.series.push_back({s.tops.name + " line", ends, {s.line.at(ends[0]), s.line.at(ends[1])}, {}});
    curve.series.push_back(std::move(s.tops));
  }
  curve.numbers["angle"] = sum / 2;
  curve.numbers["angle_error"] = std::sqrt(squares) / 2;
  return curve;
}

} // namespace sandglass::analysis
