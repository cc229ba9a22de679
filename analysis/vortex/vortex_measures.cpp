#include "analysis/vortex/vortex_measures.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::analysis {

namespace {

constexpr double none = -std::numeric_limits<double>::infinity();

} // namespace

VortexMeasures::VortexMeasures(const VortexTank& tank, const VortexGrainThresholds& limits, double density)
    : tank_(tank), limits_(limits), density_(density > 0 ? density : 2500) {
  if (!(tank.radius > 0) || !(tank.gravity > 0) || !(tank.top > tank.floor))
    throw InputError(fmt::format("the states of a vortex need a round tank with gravity: its radius is {} m, "
                                 "its floor at {} m, its top at {} m, gravity {} m/s^2",
                                 tank.radius, tank.floor, tank.top, tank.gravity));
}

void VortexMeasures::begin(const Frame& frame) {
  const auto& radii = frame.scalar(quantity::radius);
  if (frame.size() < 2) throw InputError("the states of a vortex need at least two grains");
  radius_ = 0;
  for (const double r : radii)
    radius_ += r / static_cast<double>(radii.size());
  bins_ = std::max(1, static_cast<int>(std::lround(tank_.radius / (2 * radius_) + 1e-9))); // 7.5 is 8
  if (frame.has(quantity::mass)) {
    mass_ = frame.scalar(quantity::mass);
  } else {
    mass_.clear();
    for (const double r : radii)
      mass_.push_back(4.0 / 3.0 * std::numbers::pi * r * r * r * density_);
  }
  ids_ = frame.id;
  before_ = frame.position;
  tops_.assign(profileFrames * static_cast<std::size_t>(bins_), std::numeric_limits<float>::quiet_NaN());
  speed_.resize(frame.size());
  top_.resize(static_cast<std::size_t>(bins_));
}

void VortexMeasures::add(const Frame& frame) {
  if (!samples_.empty() && frame.time <= samples_.back().time) return;
  if (before_.empty()) begin(frame);
  if (frame.id != ids_)
    throw InputError(fmt::format("the states of a vortex follow the same grains through all frames, but at "
                                 "{} s grains have come or gone",
                                 frame.time));
  const std::size_t n = frame.size();
  const double perGrain = 1 / static_cast<double>(n);
  const std::vector<Vec3>* velocity =
      frame.has(quantity::velocity) ? &frame.vector(quantity::velocity) : nullptr;
  const std::vector<Vec3>* spin = frame.has(quantity::spin) ? &frame.vector(quantity::spin) : nullptr;
  const auto& radii = frame.scalar(quantity::radius);
  const bool first = samples_.empty();
  const double span = first ? 0 : frame.time - samples_.back().time;

  VortexSample s;
  s.time = frame.time;
  double highest = none, meanHeight = 0, core = std::numeric_limits<double>::infinity(), meanStep = 0;
  double momentum = 0, inertia = 0;
  std::fill(top_.begin(), top_.end(), none);
  std::vector<double>& distance = speed_; // squares: what it holds until the rising grains are counted
  const double perBin = bins_ / tank_.radius, most = 10 * (tank_.top - tank_.floor);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 x = frame.position[i] - tank_.onAxis;
    const double height = frame.position[i].dot(tank_.up);
    const Vec3 out = x - x.dot(tank_.up) * tank_.up;
    const double square = out.squaredNorm(), rho = std::sqrt(square);
    if (!std::isfinite(square) || !std::isfinite(height) || rho > 2 * tank_.radius || std::abs(height) > most)
      s.sound = false;
    distance[i] = rho;
    highest = std::max(highest, height);
    core = std::min(core, rho);
    meanHeight += height * perGrain;
    const Vec3 v = velocity     ? (*velocity)[i]
                   : span > 0.0 ? Vec3((frame.position[i] - before_[i]) / span)
                                : Vec3::Zero();
    momentum += mass_[i] * out.cross(v).dot(tank_.up);
    inertia += mass_[i] * square;
    double moving = 0.5 * mass_[i] * v.squaredNorm();
    if (spin) moving += 0.2 * mass_[i] * radii[i] * radii[i] * (*spin)[i].squaredNorm();
    s.energy += (moving + mass_[i] * tank_.gravity * height) * perGrain;
    s.aboveFloor += (moving + mass_[i] * tank_.gravity * (height - tank_.floor)) * perGrain;
    if (s.sound) {
      const auto bin = static_cast<std::size_t>(std::min(bins_ - 1, static_cast<int>(rho * perBin)));
      top_[bin] = std::max(top_[bin], height);
    }
    meanStep += (frame.position[i] - before_[i]).dot(tank_.up) * perGrain;
  }
  s.highest = static_cast<float>(highest);
  s.meanHeight = static_cast<float>(meanHeight);
  s.core = static_cast<float>(core);
  s.rotation = static_cast<float>(inertia > 0 ? momentum / inertia : 0);

  float* ring = &tops_[samples_.size() % profileFrames * static_cast<std::size_t>(bins_)];
  for (std::size_t b = 0; b < top_.size(); ++b) {
    ring[b] = top_[b] == none ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(top_[b]);
    if (top_[b] == none) top_[b] = tank_.floor; // the source's sentinel
    if (b > 0)
      for (std::size_t f = 0; f < 3; ++f)
        s.rises[f] += top_[b] - top_[b - 1] >= VortexGrainThresholds::factors[f] * limits_.rise * radius_;
  }
  if (span > 0) {
    const double reach = limits_.spoutReach * tank_.radius, step = limits_.riserStep * radius_,
                 climb = limits_.riserSpeed * std::sqrt(tank_.gravity * radius_) * span;
    for (std::size_t i = 0; i < n; ++i) {
      if (distance[i] > reach) continue;
      const double up = (frame.position[i] - before_[i]).dot(tank_.up) - meanStep;
      for (std::size_t f = 0; f < 3; ++f) {
        s.stepRisers[f] += up >= VortexGrainThresholds::factors[f] * step;
        s.speedRisers[f] += up >= VortexGrainThresholds::factors[f] * climb;
      }
    }
  }
  before_ = frame.position;
  samples_.push_back(s);
}

double VortexMeasures::interval() const {
  if (samples_.size() < 2) return 0;
  std::vector<double> spans;
  for (std::size_t k = 1; k < samples_.size(); ++k)
    spans.push_back(samples_[k].time - samples_[k - 1].time);
  const auto middle = spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2);
  std::nth_element(spans.begin(), middle, spans.end());
  return *middle;
}

SurfaceProfile VortexMeasures::profile() const {
  SurfaceProfile p;
  const std::size_t frames = std::min(samples_.size(), profileFrames), bins = static_cast<std::size_t>(bins_);
  double count = 0, u = 0, uu = 0, z = 0, uz = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    double sum = 0, filled = 0;
    for (std::size_t k = 0; k < frames; ++k)
      if (const float top = tops_[k * bins + b]; !std::isnan(top)) sum += top, filled += 1;
    const double at = (static_cast<double>(b) + 0.5) * tank_.radius / static_cast<double>(bins);
    p.distance.push_back(at);
    p.filled.push_back(frames ? filled / static_cast<double>(frames) : 0);
    p.height.push_back(filled > 0 ? sum / filled : std::numeric_limits<double>::quiet_NaN());
    if (p.filled.back() < 0.5) continue; // bins that are mostly empty have no surface
    count += 1;
    u += at * at;
    uu += at * at * at * at;
    z += p.height.back();
    uz += at * at * p.height.back();
  }
  const double determinant = count * uu - u * u;
  if (count < 3 || !(determinant > 0)) {
    p.apex = p.curvature = p.rms = p.rotation = std::numeric_limits<double>::quiet_NaN();
    return p;
  }
  p.curvature = (count * uz - u * z) / determinant;
  p.apex = (z - p.curvature * u) / count;
  double squares = 0;
  for (std::size_t b = 0; b < bins; ++b)
    if (p.filled[b] >= 0.5)
      squares += std::pow(p.height[b] - p.apex - p.curvature * p.distance[b] * p.distance[b], 2);
  p.rms = std::sqrt(squares / count);
  p.rotation = std::sqrt(2 * tank_.gravity * p.curvature); // NaN when negative
  return p;
}

} // namespace sandglass::analysis
