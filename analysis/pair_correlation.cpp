#include "analysis/pair_correlation.h"

#include "analysis/first_shell.h"
#include "analysis/grain_sizes.h"
#include "analysis/local_density.h"
#include "analysis/neighbours.h"
#include "analysis/pair_sums.h"
#include "analysis/set_covariance.h"
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
  for (const Estimator e : {Estimator::uncorrected, Estimator::guardZone, Estimator::translation,
                            Estimator::localShell, Estimator::inhomogeneous})
    if (name == nameOf(e)) return e;
  throw InputError(fmt::format("there is no g(r) estimator '{}': choose E0 (none), E1 (guard zone), E2 "
                               "(translation), E3 (local shell volume) or E4 (inhomogeneous)",
                               name));
}

const char* nameOf(Estimator estimator) {
  switch (estimator) {
  case Estimator::uncorrected:
    return "E0";
  case Estimator::guardZone:
    return "E1";
  case Estimator::translation:
    return "E2";
  case Estimator::inhomogeneous:
    return "E4";
  default:
    return "E3";
  }
}

namespace {

const char* phraseFor(Estimator estimator) {
  switch (estimator) {
  case Estimator::uncorrected:
    return "no correction";
  case Estimator::guardZone:
    return "guard zone";
  case Estimator::translation:
    return "translation";
  case Estimator::inhomogeneous:
    return "inhomogeneous, local shell volume";
  default:
    return "local shell volume";
  }
}

} // namespace

PairCorrelation::PairCorrelation(PairCorrelationOptions options) : options_(std::move(options)) {
  if (options_.bins < 1) throw InputError(fmt::format("g(r) needs at least one bin, not {}", options_.bins));
  if (options_.rMax < 0 || !std::isfinite(options_.rMax))
    throw InputError(
        fmt::format("the largest distance of g(r) is {} m, but must be positive", options_.rMax));
}

/// The grains of one species (or all) that lie in the region open to their centres.
struct PairCorrelation::Centres {
  Region region;
  std::vector<Vec3> points;
  Volume volume;
};

double PairCorrelation::meanRadius(const Frame& frame, std::optional<int> species) const {
  if (!species || !frame.scalars.contains(quantity::radius)) return 0.5 * options_.diameter;
  const auto& radii = frame.scalar(quantity::radius);
  const auto& kinds = frame.scalar(quantity::species);
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (static_cast<int>(kinds[i]) == *species) sum += radii[i], n += 1;
  return n > 0 ? sum / n : 0.5 * options_.diameter;
}

PairCorrelation::Centres PairCorrelation::centresOf(const Frame& frame, std::optional<int> species,
                                                    double radius) const {
  const auto* radii = frame.scalars.contains(quantity::radius) ? &frame.scalar(quantity::radius) : nullptr;
  const auto* kinds = species ? &frame.scalar(quantity::species) : nullptr;
  const auto counts = [&](std::size_t i) { return !kinds || static_cast<int>((*kinds)[i]) == *species; };
  RegionOptions regionOptions = options_.region;
  regionOptions.diameter = options_.diameter;
  if (regionOptions.clearance <= 0) regionOptions.clearance = radius;
  if (regionOptions.up && regionOptions.freeSurface && regionOptions.surfaceMargin <= 0)
    regionOptions.surfaceMargin = 2 * options_.diameter;
  // Soft grains may be pressed on walls a little, except where the region is that of larger ones.
  const bool strict = meanRadius(frame, species) < radius * (1 - 1e-9);
  Centres centres{Region(frame, regionOptions), {}, {}};
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (counts(i) && (strict ? centres.region.contains(frame.position[i])
                             : centres.region.containsGrain(frame.position[i], radii ? (*radii)[i] : radius)))
      centres.points.push_back(frame.position[i]);
  centres.volume = centres.region.volume(options_.seed);
  return centres;
}

bool PairCorrelation::add(const Frame& frame) {
  if (frame.size() < 2) {
    ++skipped_;
    return false;
  }
  if (options_.diameter <= 0) options_.diameter = meanDiameter(frame);
  if (options_.rMax <= 0) options_.rMax = 5 * options_.diameter;

  const auto& species = options_.species;
  const bool same = !species || species->first == species->second;
  const auto kindA = species ? std::optional(species->first) : std::nullopt;
  const auto kindB = species ? std::optional(species->second) : std::nullopt;
  double radiusA = meanRadius(frame, kindA), radiusB = meanRadius(frame, kindB);
  // A pair and its shifted region have to be of one region: the space that is open to both.
  if (options_.estimator == Estimator::translation) radiusA = radiusB = std::max(radiusA, radiusB);
  const Centres a = centresOf(frame, kindA, radiusA);
  const std::optional<Centres> other = same ? std::nullopt : std::optional(centresOf(frame, kindB, radiusB));
  const Centres& b = other ? *other : a;
  if (regionText_.empty()) regionText_ = a.region.description();
  if (species && speciesText_.empty()) {
    const auto name = [&](int s) {
      return static_cast<std::size_t>(s) < frame.speciesNames.size() ? frame.speciesNames[s]
                                                                     : fmt::format("{}", s);
    };
    speciesText_ = name(species->first) + "-" + name(species->second);
  }

  const std::size_t enough = same ? 2 : 1;
  if (a.points.size() < enough || b.points.size() < enough || !(a.volume.value > 0) ||
      !(b.volume.value > 0)) {
    ++skipped_;
    return false;
  }
  Sample sample;
  sample.centres = static_cast<double>(a.points.size());
  sample.references = sample.centres;
  sample.density =
      (static_cast<double>(b.points.size()) - (same && !options_.selfImages ? 1 : 0)) / b.volume.value;
  sample.volumeError = b.volume.error / b.volume.value;
  sample.share.assign(options_.bins, 1.0);
  sample.shareError.assign(options_.bins, 0.0);
  countInto(sample, frame, a, b);
  if (sample.references < 1) {
    ++skipped_;
    return false;
  }
  const double dr = options_.rMax / options_.bins;
  const bool shares =
      options_.estimator != Estimator::translation; // there the weights make up for the shares
  for (int bin = 0; bin < options_.bins; ++bin)
    sample.expected.push_back(sample.references * sample.density * shellVolume(bin * dr, (bin + 1) * dr) *
                              (shares ? sample.share[bin] : 1));
  samples_.push_back(std::move(sample));
  return true;
}

/// Counts, weights, reference centres and shares, by the estimator.
void PairCorrelation::countInto(Sample& sample, const Frame& frame, const Centres& a,
                                const Centres& b) const {
  const bool same = &a == &b;
  const PairCountOptions counting{options_.rMax, options_.bins, options_.selfImages};
  // Another seed for each Frame, so that sampling errors average out like all others.
  const std::uint64_t seed = options_.seed + 1000003ULL * samples_.size();
  std::vector<char> reference;
  std::vector<Vec3> references = a.points;
  if (options_.estimator == Estimator::guardZone) {
    references.clear();
    // A hair of slack: a centre in the exact middle of a region 2 rMax thick counts.
    for (const auto& x : a.points) {
      reference.push_back(b.region.depthInside(x, options_.rMax) >= options_.rMax * (1 - 1e-12));
      if (reference.back()) references.push_back(x);
    }
    sample.references = static_cast<double>(references.size());
  }

  if (options_.estimator == Estimator::translation) {
    const SetCovariance covariance(a.region, options_.rMax, seed);
    const double least = 1.0 / covariance.points();
    auto sums = sumPairs(
        a.points, b.points, same, frame.domain, counting,
        [&](std::size_t, std::size_t, const Vec3& h, double) { return 1 / std::max(least, covariance(h)); });
    sample.counts = std::move(sums.counts);
    sample.weights = std::move(sums.weights);
    for (int bin = 0; bin < options_.bins; ++bin)
      if (sample.weights[bin] > 0) {
        const double f = static_cast<double>(sample.counts[bin]) / sample.weights[bin];
        sample.share[bin] = f;
        sample.shareError[bin] = std::sqrt(std::max(0.0, f * (1 - f)) / covariance.points());
      }
    return;
  }
  if (options_.estimator == Estimator::inhomogeneous) {
    const double reach = 2 * options_.diameter;
    const LocalDensity local = localDensity(b.region, b.points, reach, seed);
    auto sums = sumPairs(a.points, b.points, same, frame.domain, counting,
                         [&](std::size_t, std::size_t j, const Vec3&, double r) {
                           const int n = local.count[j] - (same && r < reach ? 1 : 0);
                           return sample.density * local.volume[j] / (n + 1);
                         });
    sample.counts = std::move(sums.counts);
    sample.weights = std::move(sums.weights);
  } else {
    sample.counts = same ? countPairs(a.points, reference, frame.domain, counting)
                         : sumPairs(references, b.points, false, frame.domain, counting,
                                    [](std::size_t, std::size_t, const Vec3&, double) { return 0.0; })
                               .counts;
  }
  if (options_.estimator == Estimator::localShell || options_.estimator == Estimator::inhomogeneous) {
    auto coverage =
        shellCoverage(b.region, a.points,
                      {options_.rMax, options_.bins, options_.directions, options_.pointsPerShell, seed});
    sample.share = std::move(coverage.share);
    sample.shareError = std::move(coverage.error);
  }
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
  const bool translation = options_.estimator == Estimator::translation;
  double worstSampling = 0, neighbours = 0, neighbourVariance = 0;
  for (int b = 0; b < options_.bins; ++b) {
    double counted = 0, weighted = 0, expected = 0, sampling = 0, covered = 0;
    std::vector<double> each;
    for (const auto& s : samples_) {
      const double n = s.weights.empty() ? static_cast<double>(s.counts[b]) : s.weights[b];
      counted += static_cast<double>(s.counts[b]);
      weighted += n;
      expected += s.expected[b];
      covered += s.references * (translation ? 1 : s.share[b]);
      if (s.share[b] > 0) sampling += std::pow(s.expected[b] * s.shareError[b] / s.share[b], 2);
      if (s.expected[b] > 0) each.push_back(n / s.expected[b]);
    }
    const double value = expected > 0 ? weighted / expected : 0;
    const double relativeSampling = expected > 0 ? std::sqrt(sampling) / expected : 0;
    worstSampling = std::max(worstSampling, relativeSampling);
    // counted / 2 independent pairs at most, hence sqrt(2 counted) and not sqrt(counted).
    double error = counted > 0 ? std::hypot(value * std::sqrt(2 / counted), value * relativeSampling) : 0;
    if (each.size() >= 4) error = blockedStandardError(each);
    g.x.push_back((b + 0.5) * dr / d);
    g.y.push_back(value);
    g.error.push_back(error);

    const double inBin = covered > 0 ? weighted / covered : 0;
    neighbours += inBin;
    if (value > 0) neighbourVariance += std::pow(inBin * error / value, 2);
    z.x.push_back((b + 1) * dr / d);
    z.y.push_back(neighbours);
    z.error.push_back(std::sqrt(neighbourVariance));
  }

  Curve& curve = out.g;
  const std::string suffix = speciesText_.empty() ? "" : "_" + speciesText_;
  curve.name = "gr" + suffix;
  curve.title = speciesText_.empty() ? "Pair correlation" : "Pair correlation of " + speciesText_;
  curve.x = {"r / d", ""};
  curve.y = {speciesText_.empty() ? "g(r)" : "g(r) of " + speciesText_, ""};
  curve.frames = frames;
  double density = 0, references = 0, volumeError = 0;
  for (const auto& s : samples_) {
    density += s.density / static_cast<double>(frames);
    references += s.references / static_cast<double>(frames);
    volumeError = std::max(volumeError, s.volumeError);
  }
  curve.definition = fmt::format("{} ({}); W: {}; rho = {} / |W|; all periodic images{}; d = {:.5g} m; {}{}",
                                 nameOf(options_.estimator), phraseFor(options_.estimator), regionText_,
                                 options_.species && options_.species->first != options_.species->second
                                     ? "N of the second species"
                                 : options_.selfImages ? "N"
                                                       : "(N - 1)",
                                 options_.selfImages ? "" : " but a grain's own", d,
                                 frames >= 16  ? "error: blocks of frames"
                                 : frames >= 4 ? "error: scatter of the frames, taken as independent"
                                               : "error: pair counts and shell sampling, a lower bound",
                                 speciesText_.empty() ? "" : "; species " + speciesText_);
  curve.numbers = {{"diameter", d},
                   {"density", density},
                   {"references", references},
                   {"volume_relative_error", volumeError},
                   {"shell_sampling_error", worstSampling},
                   {"frames_left_out", static_cast<double>(skipped_)}};
  curve.marks.push_back({"uniform points", 1.0, false});

  Curve& shells = out.coordination;
  shells.name = "gr" + suffix + "_coordination";
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
