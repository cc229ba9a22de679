#include "analysis/pair_correlation.h"

#include "analysis/first_shell.h"
#include "analysis/grain_sizes.h"
#include "analysis/neighbours.h"
#include "analysis/shell_coverage.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass::analysis {

namespace {

double shellVolume(double low, double high) {
  return 4.0 / 3.0 * std::numbers::pi * (high * high * high - low * low * low);
}

} // namespace

Estimator parseEstimator(const std::string& name) {
  for (const Estimator e : {Estimator::uncorrected, Estimator::guardZone, Estimator::localShell})
    if (name == nameOf(e)) return e;
  throw InputError(fmt::format(
      "there is no g(r) estimator '{}': choose E0 (none), E1 (guard zone) or E3 (local shell volume)", name));
}

const char* nameOf(Estimator estimator) {
  return estimator == Estimator::uncorrected ? "E0" : estimator == Estimator::guardZone ? "E1" : "E3";
}

PairCorrelation::PairCorrelation(PairCorrelationOptions options) : options_(std::move(options)) {
  if (options_.bins < 1) throw InputError(fmt::format("g(r) needs at least one bin, not {}", options_.bins));
  if (options_.rMax < 0 || !std::isfinite(options_.rMax))
    throw InputError(
        fmt::format("the largest distance of g(r) is {} m, but must be positive", options_.rMax));
}

bool PairCorrelation::add(const Frame& frame) {
  if (frame.size() < 2) {
    ++skipped_;
    return false;
  }
  if (options_.diameter <= 0) options_.diameter = meanDiameter(frame);
  if (options_.rMax <= 0) options_.rMax = 5 * options_.diameter;
  const double radius = 0.5 * options_.diameter;

  RegionOptions regionOptions = options_.region;
  regionOptions.diameter = options_.diameter;
  if (regionOptions.clearance <= 0) regionOptions.clearance = radius;
  if (regionOptions.up && regionOptions.freeSurface && regionOptions.surfaceMargin <= 0)
    regionOptions.surfaceMargin = 2 * options_.diameter;
  const Region region(frame, regionOptions);
  if (regionText_.empty()) regionText_ = region.description();

  const auto* radii = frame.scalars.contains(quantity::radius) ? &frame.scalar(quantity::radius) : nullptr;
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (region.containsGrain(frame.position[i], radii ? (*radii)[i] : radius))
      centres.push_back(frame.position[i]);

  const bool guard = options_.estimator == Estimator::guardZone;
  std::vector<char> reference;
  double references = static_cast<double>(centres.size());
  if (guard) {
    // A hair of slack: a centre in the exact middle of a region 2 rMax thick counts.
    for (const auto& x : centres)
      reference.push_back(region.depthInside(x, options_.rMax) >= options_.rMax * (1 - 1e-12));
    references = static_cast<double>(std::count(reference.begin(), reference.end(), 1));
  }
  const Volume volume = region.volume(options_.seed);
  if (centres.size() < 2 || references < 1 || !(volume.value > 0)) {
    ++skipped_;
    return false;
  }

  Sample sample;
  sample.counts =
      countPairs(centres, reference, frame.domain, {options_.rMax, options_.bins, options_.selfImages});
  if (options_.estimator == Estimator::localShell) {
    // Another seed for each Frame, so that sampling errors average out like all others.
    auto coverage = shellCoverage(region, centres,
                                  {options_.rMax, options_.bins, options_.directions, options_.pointsPerShell,
                                   options_.seed + 1000003ULL * samples_.size()});
    sample.share = std::move(coverage.share);
    sample.shareError = std::move(coverage.error);
  } else {
    sample.share.assign(options_.bins, 1.0);
    sample.shareError.assign(options_.bins, 0.0);
  }
  sample.references = references;
  sample.centres = static_cast<double>(centres.size());
  sample.density = (sample.centres - (options_.selfImages ? 0 : 1)) / volume.value;
  sample.volumeError = volume.error / volume.value;
  const double dr = options_.rMax / options_.bins;
  for (int b = 0; b < options_.bins; ++b)
    sample.expected.push_back(references * sample.density * shellVolume(b * dr, (b + 1) * dr) *
                              sample.share[b]);
  samples_.push_back(std::move(sample));
  return true;
}

PairCorrelationResult PairCorrelation::result() const {
  if (samples_.empty())
    throw InputError(fmt::format("g(r) by {} found no frame with enough grains in its region ({} left "
                                 "out{}): choose other frames, wider limits, "
                                 "or, for E1, a smaller largest distance",
                                 nameOf(options_.estimator), skipped_,
                                 regionText_.empty() ? "" : "; " + regionText_));
  const std::size_t frames = samples_.size();
  const double d = options_.diameter, dr = options_.rMax / options_.bins;

  PairCorrelationResult out;
  Series g{"g", {}, {}, {}}, z{"Z", {}, {}, {}};
  double worstSampling = 0, neighbours = 0, neighbourVariance = 0;
  for (int b = 0; b < options_.bins; ++b) {
    double counted = 0, expected = 0, sampling = 0, perReference = 0, covered = 0;
    std::vector<double> each;
    for (const auto& s : samples_) {
      const double n = static_cast<double>(s.counts[b]);
      counted += n;
      expected += s.expected[b];
      covered += s.references * s.share[b];
      perReference += n;
      if (s.share[b] > 0) sampling += std::pow(s.expected[b] * s.shareError[b] / s.share[b], 2);
      if (s.expected[b] > 0) each.push_back(n / s.expected[b]);
    }
    const double value = expected > 0 ? counted / expected : 0;
    const double relativeSampling = expected > 0 ? std::sqrt(sampling) / expected : 0;
    worstSampling = std::max(worstSampling, relativeSampling);
    // counted / 2 independent pairs at most, hence sqrt(2 counted) and not sqrt(counted).
    double error = expected > 0 ? std::hypot(std::sqrt(2 * counted) / expected, value * relativeSampling) : 0;
    if (each.size() >= 4) error = blockedStandardError(each);
    g.x.push_back((b + 0.5) * dr / d);
    g.y.push_back(value);
    g.error.push_back(error);

    const double inBin = covered > 0 ? perReference / covered : 0;
    neighbours += inBin;
    if (value > 0) neighbourVariance += std::pow(inBin * error / value, 2);
    z.x.push_back((b + 1) * dr / d);
    z.y.push_back(neighbours);
    z.error.push_back(std::sqrt(neighbourVariance));
  }

  Curve& curve = out.g;
  curve.name = "gr";
  curve.title = "Pair correlation";
  curve.x = {"r / d", ""};
  curve.y = {"g(r)", ""};
  curve.frames = frames;
  double density = 0, references = 0, volumeError = 0;
  for (const auto& s : samples_) {
    density += s.density / static_cast<double>(frames);
    references += s.references / static_cast<double>(frames);
    volumeError = std::max(volumeError, s.volumeError);
  }
  const char* what = options_.estimator == Estimator::uncorrected ? "no correction"
                     : options_.estimator == Estimator::guardZone ? "guard zone"
                                                                  : "local shell volume";
  curve.definition =
      fmt::format("{} ({}); W: {}; rho = {} / |W|; all periodic images{}; d = {:.5g} m; {}",
                  nameOf(options_.estimator), what, regionText_, options_.selfImages ? "N" : "(N - 1)",
                  options_.selfImages ? "" : " but a grain's own", d,
                  frames >= 16  ? "error: blocks of frames"
                  : frames >= 4 ? "error: scatter of the frames, taken as independent"
                                : "error: pair counts and shell sampling, a lower bound");
  curve.numbers = {{"diameter", d},
                   {"density", density},
                   {"references", references},
                   {"volume_relative_error", volumeError},
                   {"shell_sampling_error", worstSampling},
                   {"frames_left_out", static_cast<double>(skipped_)}};
  curve.marks.push_back({"uniform points", 1.0, false});

  Curve& shells = out.coordination;
  shells.name = "gr_coordination";
  shells.title = "Neighbours within r";
  shells.definition = curve.definition;
  shells.x = curve.x;
  shells.y = {"neighbours", ""};
  shells.frames = frames;
  if (const auto shell = firstShell(g.x, g.y, g.error)) {
    const auto at = static_cast<std::size_t>(std::lround(shell->minimum * d / dr));
    const double count = at > 0 ? z.y[std::min(at, z.y.size()) - 1] : 0;
    for (Curve* c : {&curve, &shells}) {
      c->marks.push_back({"first minimum", shell->minimum, true});
      c->numbers["contact_peak"] = shell->peak;
      c->numbers["first_minimum"] = shell->minimum;
      c->numbers["coordination_first_shell"] = count;
    }
  }
  curve.series.push_back(std::move(g));
  shells.series.push_back(std::move(z));
  return out;
}

PairCorrelationResult pairCorrelation(const Frame& frame, const PairCorrelationOptions& options) {
  PairCorrelation correlation(options);
  correlation.add(frame);
  return correlation.result();
}

} // namespace sandglass::analysis
