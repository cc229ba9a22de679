#include "analysis/flow_profiles.h"

#include "analysis/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::analysis {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double most = 32; // points of a ring

double densestOf(const std::vector<CoarseAverage>& averages) {
  double densest = 0;
  for (const auto& a : averages)
    densest = std::max(densest, a.mass);
  return densest;
}

} // namespace

const std::vector<FlowProfiles::Quantity>& FlowProfiles::quantities() {
  static const std::vector<Quantity> all{
      {"velocity",
       "Downward velocity",
       {"velocity against up", "m/s"},
       false,
       [](const CoarseAverage& a, const ProfileOptions& o) { return -a.velocity().dot(o.axes.up); }},
      {"packing_fraction",
       "Packing fraction",
       {"packing fraction", ""},
       false,
       [](const CoarseAverage& a, const ProfileOptions&) { return a.volume; }},
      {"temperature",
       "Granular temperature",
       {"T_g", "m^2/s^2"},
       false,
       [](const CoarseAverage& a, const ProfileOptions&) { return a.temperature(); }},
      {"shear_rate",
       "Shear rate",
       {"shear rate", "1/s"},
       false,
       [](const CoarseAverage& a, const ProfileOptions&) { return a.shearRate(); }},
      {"pressure",
       "Pressure",
       {"P", "Pa"},
       true,
       [](const CoarseAverage& a, const ProfileOptions&) { return a.pressure(); }},
      {"inertial_number",
       "Inertial number",
       {"I", ""},
       true,
       [](const CoarseAverage& a, const ProfileOptions& o) {
         const double p = a.pressure();
         return p > 0 ? a.shearRate() * o.diameter * std::sqrt(a.mass / a.volume / p) : nan;
       }},
  };
  return all;
}

FlowProfiles::FlowProfiles(ProfileOptions options) : options_(std::move(options)) {
  for (const double h : options_.heights)
    addLine(h, true);
  for (const double r : options_.radii)
    addLine(r, false);
  sum_.resize(points_.size());
}

void FlowProfiles::addLine(double given, bool level) {
  Line line{given, level, {}};
  const auto add = [&](double at) {
    const std::size_t first = points_.size();
    addRing(level ? at : given, level ? given : at);
    line.stations.push_back(
        {at, first, points_.size() - first, std::vector<std::vector<double>>(quantities().size())});
  };
  const auto& o = options_;
  if (!level) {
    for (double h = o.lower.z() + 0.5 * o.step; h < o.upper.z(); h += o.step)
      add(h);
  } else {
    // Whole steps from the axis, on both sides of a plane.
    double low = 0, high = 0;
    for (const double a : {o.lower.x(), o.upper.x()})
      for (const double b : {o.lower.y(), o.upper.y()}) {
        const Vec3 off = a * o.axes.e1 + b * o.axes.e2 - (o.axis - o.axis.dot(o.axes.up) * o.axes.up);
        if (o.across)
          low = std::min(low, off.dot(*o.across)), high = std::max(high, off.dot(*o.across));
        else
          high = std::max({high, std::abs(off.dot(o.axes.e1)), std::abs(off.dot(o.axes.e2))});
      }
    for (auto k = std::lround(std::ceil(low / o.step)); static_cast<double>(k) * o.step <= high; ++k)
      add(static_cast<double>(k) * o.step);
  }
  lines_.push_back(std::move(line));
}

void FlowProfiles::addRing(double distance, double height) {
  const auto& o = options_;
  const Vec3 foot = o.axis + (height - o.axis.dot(o.axes.up)) * o.axes.up;
  if (!o.across) {
    const double wanted = 2 * std::numbers::pi * std::abs(distance) / o.step;
    const int count = static_cast<int>(std::clamp(std::ceil(wanted), 1.0, most));
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      points_.push_back(foot + distance * (std::cos(angle) * o.axes.e1 + std::sin(angle) * o.axes.e2));
    }
    return;
  }
  // Along the plane, the whole depth of the grains, in the middle of equal parts.
  const Vec3 along = o.across->cross(o.axes.up);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double a : {o.lower.x(), o.upper.x()})
    for (const double b : {o.lower.y(), o.upper.y()}) {
      const double s = (a * o.axes.e1 + b * o.axes.e2).dot(along);
      low = std::min(low, s), high = std::max(high, s);
    }
  const int count = static_cast<int>(std::clamp(std::ceil((high - low) / o.step), 1.0, most));
  for (int k = 0; k < count; ++k)
    points_.push_back(foot + distance * *o.across +
                      (low + (high - low) * (k + 0.5) / count - foot.dot(along)) * along);
}

void FlowProfiles::add(const CoarseGrainer& grainer) {
  contacts_ = contacts_ || grainer.hasContacts();
  const auto averages = grainer.at(points_);
  for (std::size_t k = 0; k < points_.size(); ++k)
    sum_[k] += averages[k];
  ++frames_;
  const double densest = densestOf(averages);
  for (auto& line : lines_)
    for (auto& station : line.stations)
      for (std::size_t q = 0; q < quantities().size(); ++q) {
        const double value =
            average(std::span(averages).subspan(station.first, station.count), quantities()[q], densest);
        if (std::isfinite(value)) station.each[q].push_back(value);
      }
}

double FlowProfiles::average(std::span<const CoarseAverage> ring, const Quantity& quantity,
                             double densest) const {
  double sum = 0, mass = 0;
  for (const auto& a : ring)
    if (a.mass > 0.01 * densest)
      if (const double v = quantity.value(a, options_); std::isfinite(v)) sum += v * a.mass, mass += a.mass;
  return mass > 0 ? sum / mass : nan;
}

Curve FlowProfiles::curve(const Quantity& quantity, bool level, const std::string& definition) const {
  const double n = static_cast<double>(frames_);
  const double densest = densestOf(sum_) / n;
  const auto index = static_cast<std::size_t>(&quantity - quantities().data());
  Curve curve;
  curve.name = std::string(quantity.name) + (level ? "_at_heights" : "_at_radii");
  const std::string distance = options_.across ? "distance from the middle plane" : "distance from the axis";
  curve.title = quantity.title + std::string(level ? " across the flow" : " up the flow");
  curve.definition = fmt::format("{} {}, weighted by mass; {}", level ? "by" : "by height, at the same",
                                 distance, definition);
  if (frames_ >= 4)
    curve.definition +=
        frames_ >= 16 ? "; error: blocks of frames" : "; error: scatter of the frames, taken as independent";
  curve.x = level ? Axis{distance, "m"} : Axis{"height", "m"};
  curve.y = quantity.axis;
  curve.frames = frames_;
  for (const auto& line : lines_) {
    if (line.level != level) continue;
    Series series;
    series.name = fmt::format("{} {:.4g} m", level ? "height" : "distance", line.given);
    for (const auto& station : line.stations) {
      std::vector<CoarseAverage> ring(station.count);
      for (std::size_t k = 0; k < station.count; ++k)
        (ring[k] += sum_[station.first + k]) *= 1 / n;
      const double value = average(ring, quantity, densest);
      if (!std::isfinite(value)) continue;
      series.x.push_back(station.at);
      series.y.push_back(value);
      const auto& each = station.each[index];
      if (frames_ >= 4) series.error.push_back(each.size() >= 4 ? blockedStandardError(each) : nan);
    }
    if (!series.x.empty()) curve.series.push_back(std::move(series));
  }
  return curve;
}

std::vector<Curve> FlowProfiles::curves(const std::string& definition) const {
  std::vector<Curve> all;
  for (const bool level : {true, false})
    for (const auto& quantity : quantities()) {
      if (quantity.stress && !contacts_) continue; // without forces the pressure is a part of it only
      Curve one = curve(quantity, level, definition);
      if (!one.series.empty()) all.push_back(std::move(one));
    }
  return all;
}

std::string FlowProfiles::emptyLines() const {
  std::string places;
  for (const auto& line : lines_) {
    const bool met = std::any_of(line.stations.begin(), line.stations.end(), [](const Station& s) {
      return std::any_of(s.each.begin(), s.each.end(), [](const auto& values) { return !values.empty(); });
    });
    if (!met)
      places += fmt::format("{}{} {:.4g} m", places.empty() ? "" : ", ", line.level ? "height" : "distance",
                            line.given);
  }
  if (places.empty()) return places;
  return fmt::format(
      "profiles left out, since no grains are there: {} (grains lie between {:.4g} and {:.4g} m)", places,
      options_.lower.z(), options_.upper.z());
}

} // namespace sandglass::analysis
