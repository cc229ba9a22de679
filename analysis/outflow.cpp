#include "analysis/outflow.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass::analysis {

namespace {

/// Diameter between small and large grains; 0 where all are about one size.
double border(const std::vector<double>& diameters) {
  const auto [least, most] = std::minmax_element(diameters.begin(), diameters.end());
  return *most > 1.1 * *least ? 0.5 * (*least + *most) : 0.0;
}

struct Leaving {
  std::vector<double> place, speed, diameter; ///< [m], [m/s] downwards, [m]
  double reach = 0;                           ///< [m], of the places
};

Leaving leaving(const SeriesColumns& rows, const OutletFrame& outlet, const std::string& source) {
  const auto &x = recordedColumn(rows, "x", source), &y = recordedColumn(rows, "y", source),
             &z = recordedColumn(rows, "z", source);
  const auto &vx = recordedColumn(rows, "vx", source), &vy = recordedColumn(rows, "vy", source),
             &vz = recordedColumn(rows, "vz", source);
  Leaving all;
  all.diameter = recordedColumn(rows, "diameter", source);
  if (x.empty())
    throw InputError(fmt::format("{}: no grain has left, so nothing is known of the outlet", source));
  const bool slot = outlet.across.squaredNorm() > 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 from = Vec3(x[i], y[i], z[i]) - outlet.centre;
    all.place.push_back(slot ? from.dot(outlet.across) : (from - from.dot(outlet.down) * outlet.down).norm());
    all.speed.push_back(Vec3(vx[i], vy[i], vz[i]).dot(outlet.down));
    all.reach = std::max(all.reach, std::abs(all.place.back()));
  }
  all.reach = all.reach > 0.0 ? all.reach * (1 + 1e-12) : 1.0;
  return all;
}

struct Bins {
  Bins(const Leaving& all, const OutletFrame& outlet)
      : slot(outlet.across.squaredNorm() > 0.0), low(slot ? -all.reach : 0.0),
        width((all.reach - low) / outlet.bins), count(outlet.bins) {}
  std::size_t of(double place) const {
    return static_cast<std::size_t>(std::clamp(static_cast<int>((place - low) / width), 0, count - 1));
  }
  double middle(std::size_t k) const { return low + (static_cast<double>(k) + 0.5) * width; }
  /// Length of the bin, or area of its ring.
  double size(std::size_t k) const { return slot ? width : 2.0 * std::numbers::pi * middle(k) * width; }
  Axis axis() const { return {slot ? "place across the outlet" : "distance from the middle", "m"}; }
  bool slot;
  double low, width;
  int count;
};

} // namespace

Curve outletPositions(const SeriesColumns& rows, const OutletFrame& outlet, const std::string& source) {
  const Leaving all = leaving(rows, outlet, source);
  const Bins bins(all, outlet);
  const double edge = border(all.diameter), total = static_cast<double>(all.place.size());
  Curve curve;
  curve.name = "outlet_positions";
  curve.title = "Where grains leave";
  curve.definition = fmt::format("share of all leaving grains per {}; errors: square root of the count",
                                 bins.slot ? "length across the slot" : "area of a ring");
  curve.x = bins.axis();
  curve.y = {"density", bins.slot ? "1/m" : "1/m^2"};
  const auto add = [&](const std::string& name, auto&& counts) {
    std::vector<std::int64_t> n(static_cast<std::size_t>(bins.count));
    for (std::size_t i = 0; i < all.place.size(); ++i)
      if (counts(all.diameter[i])) ++n[bins.of(all.place[i])];
    Series s;
    s.name = name;
    for (std::size_t k = 0; k < n.size(); ++k) {
      s.x.push_back(bins.middle(k));
      s.y.push_back(static_cast<double>(n[k]) / (total * bins.size(k)));
      s.error.push_back(std::sqrt(static_cast<double>(n[k])) / (total * bins.size(k)));
    }
    curve.series.push_back(std::move(s));
  };
  add("all grains", [](double) { return true; });
  if (edge > 0.0) {
    add("small", [edge](double d) { return d < edge; });
    add("large", [edge](double d) { return d >= edge; });
  }
  curve.numbers = {{"grains", total}};
  return curve;
}

Curve outletVelocities(const SeriesColumns& rows, const OutletFrame& outlet, const std::string& source) {
  const Leaving all = leaving(rows, outlet, source);
  const Bins bins(all, outlet);
  std::vector<std::vector<double>> speeds(static_cast<std::size_t>(bins.count));
  for (std::size_t i = 0; i < all.place.size(); ++i)
    speeds[bins.of(all.place[i])].push_back(all.speed[i]);
  Curve curve;
  curve.name = "outlet_velocities";
  curve.title = "How fast grains leave";
  curve.definition = "mean velocity along the way out where the outlet was looked at; errors: of the mean, "
                     "grains taken as independent";
  curve.x = bins.axis();
  curve.y = {"speed", "m/s"};
  Series s;
  s.name = "leaving grains";
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    if (speeds[k].empty()) continue;
    s.x.push_back(bins.middle(k));
    s.y.push_back(mean(speeds[k]));
    s.error.push_back(std::sqrt(variance(speeds[k]) / static_cast<double>(speeds[k].size())));
  }
  curve.series.push_back(std::move(s));
  curve.numbers = {{"mean_speed", mean(all.speed)}, {"speed_deviation", std::sqrt(variance(all.speed))}};
  return curve;
}

Curve dischargeSegregation(const SeriesColumns& rows, const std::vector<double>& density,
                           const std::string& source) {
  constexpr int samples = 20;
  const auto &diameter = recordedColumn(rows, "diameter", source),
             &species = recordedColumn(rows, "species", source);
  if (diameter.size() < 100)
    throw InputError(fmt::format("{}: {} grains have left; segregation of the discharge needs 100 or more",
                                 source, diameter.size()));
  const double edge = border(diameter);
  if (edge == 0.0)
    throw InputError(
        fmt::format("{}: all grains are of about one size, so there is nothing to segregate", source));
  std::vector<double> mass(diameter.size());
  double total = 0.0, fines = 0.0, fineGrains = 0.0;
  for (std::size_t i = 0; i < diameter.size(); ++i) {
    const auto kind = static_cast<std::size_t>(species[i]);
    const double rho = kind < density.size() ? density[kind] : 1.0;
    mass[i] = rho * std::numbers::pi / 6.0 * diameter[i] * diameter[i] * diameter[i];
    total += mass[i];
    if (diameter[i] < edge) fines += mass[i], ++fineGrains;
  }
  const double share = fines / total;
  std::vector<double> sampleMass(samples), sampleFines(samples);
  double before = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const auto k = static_cast<std::size_t>(
        std::min(samples - 1, static_cast<int>(samples * (before + 0.5 * mass[i]) / total)));
    sampleMass[k] += mass[i];
    if (diameter[i] < edge) sampleFines[k] += mass[i];
    before += mass[i];
  }
  Curve curve;
  curve.name = "discharge_segregation";
  curve.title = "Fines in the discharge";
  curve.definition =
      "mass share of the fines in samples of a twentieth of the discharged mass over that of all; "
      "errors: of a perfect mixture";
  curve.x = {"discharged mass / all of it", ""};
  curve.y = {"x_i / x_f", ""};
  Series s;
  s.name = "samples";
  s.scatter = true;
  double index = 0.0;
  // Of n grains in random order those in a sample of mass M have x = sum m f / M; its variance is that of
  // sum m (f - x) / M: (x_f (1 - x_f))^2 (1/n_f + 1/n_c) with n_f fine and n_c coarse grains a sample.
  const double perSample = fineGrains / samples,
               coarse = (static_cast<double>(mass.size()) - fineGrains) / samples,
               deviation = (1.0 - share) * std::sqrt(1.0 / perSample + 1.0 / coarse);
  for (std::size_t k = 0; k < samples; ++k) {
    if (sampleMass[k] == 0.0) continue;
    s.x.push_back((static_cast<double>(k) + 0.5) / samples);
    s.y.push_back(sampleFines[k] / sampleMass[k] / share);
    s.error.push_back(deviation);
    index += std::abs(s.y.back() - 1.0);
  }
  index /= static_cast<double>(s.x.size());
  const double floor = std::sqrt(2.0 / std::numbers::pi) * deviation;
  const Line line = fitLine(s.x, s.y);
  curve.series.push_back(std::move(s));
  curve.marks = {{"perfect mixture", 1.0, false}};
  curve.numbers = {{"SI", index},
                   {"floor", floor},
                   {"SI_above_floor", std::sqrt(std::max(0.0, index * index - floor * floor))},
                   {"slope", line.slope},
                   {"slope_error", line.slopeError},
                   {"fines", share},
                   {"fines_per_sample", perSample}};
  return curve;
}

} // namespace sandglass::analysis
