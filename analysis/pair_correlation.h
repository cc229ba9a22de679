#pragma once
// The pair correlation function g(r) of grain centres, right near walls and in thin periodic domains.
//
// n(r): ordered pairs by distance, every periodic image counted; v(r) = 4/3 pi (r2^3 - r1^3): exact shell
// volumes; W: the region open to centres; rho = (N - 1) / |W|, so that N uniform points give 1.
//   E0  n / (N rho v): no correction, falls below 1 near walls; shows the size of the effect
//   E1  guard zone: the same over those centres alone whose shells lie in W entirely
//   E2  translation (Ohser, Math. Operationsforsch. Statist. 14, 63, 1983): each pair weighted with
//       |W| / gamma(h), gamma(h) = |W n (W + h)|
//   E3  local shell volume (after Ripley, J. R. Stat. Soc. B 39, 172, 1977; boxes: Kopera & Retsch, Anal.
//   Chem. 90,
//       13909, 2018): sum_i n_i / sum_i rho |S_i n W|, the volumes by quasi-random points. Ratio of sums.
//   E4  inhomogeneous (after Baddeley, Moller & Waagepetersen, Statist. Neerlandica 54, 329, 2000): E3 with
//   the
//       density at each partner instead of the mean one: sum_ij 1/rho(x_j) / sum_i |S_i n W|. rho(x_j) is
//       (n + 1) / |B n W| with the n centres, i and j left out, in the ball B of two diameters about x_j: the
//       mean of 1 / (n + 1) over Poisson numbers is 1 / <n>, so that uniform points give 1 here, too.
// Of species a and b: i runs over a, j over b, each in its own W (their radii differ; E2 takes the space open
// to both), rho is b's density.

#include "analysis/region.h"
#include "analysis/result.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sandglass::analysis {

enum class Estimator { uncorrected, guardZone, translation, localShell, inhomogeneous };

/// "E0" to "E4"; throws InputError for others.
Estimator parseEstimator(const std::string& name);
const char* nameOf(Estimator estimator);

struct PairCorrelationOptions {
  Estimator estimator = Estimator::localShell;
  double rMax = 0; ///< [m]; 0: five diameters
  int bins = 200;
  double diameter = 0;  ///< [m]; 0: twice the mean radius of the first Frame
  RegionOptions region; ///< clearance 0: the mean radius; surfaceMargin 0: two diameters
  int directions = 32;  ///< see ShellCoverageOptions
  std::int64_t pointsPerShell = 200000;
  bool selfImages = false; ///< count a grain's own periodic images: a spike at the period, lattices need it
  std::uint64_t seed = 1;
  std::optional<std::pair<int, int>> species; ///< of grains of these species alone
};

struct PairCorrelationResult {
  Curve g;            ///< against r / d; numbers: first_minimum, coordination, density, references, ...
  Curve coordination; ///< mean number of neighbours within r, missing shell parts made up for
};

/// Add Frames, then ask for the result. Each Frame has its own region and density.
class PairCorrelation {
public:
  explicit PairCorrelation(PairCorrelationOptions options);

  /// False when the Frame has fewer than two centres in the region or no reference centre, and was left out.
  /// Throws InputError when radii are missing and no diameter was given.
  bool add(const Frame& frame);

  std::size_t frames() const { return samples_.size(); }

  /// Error bars: from blocks of Frames where there are 16 or more, from their scatter where there are 4; else
  /// counting (Poisson, a lower bound) and shell sampling together. Throws InputError when no Frame was good.
  PairCorrelationResult result() const;

private:
  struct Sample {
    std::vector<std::uint64_t> counts;     ///< ordered pairs
    std::vector<double> weights;           ///< the same, weighted (E2, E4)
    std::vector<double> expected;          ///< counts, or weights, of uniform points
    std::vector<double> share, shareError; ///< shell coverage
    double references = 0, centres = 0, density = 0, volumeError = 0;
  };
  struct Centres;
  double meanRadius(const Frame& frame, std::optional<int> species) const;
  Centres centresOf(const Frame& frame, std::optional<int> species, double radius) const;
  void countInto(Sample& sample, const Frame& frame, const Centres& a, const Centres& b) const;

  PairCorrelationOptions options_;
  std::string regionText_, speciesText_;
  std::size_t skipped_ = 0;
  std::vector<Sample> samples_;
};

/// One Frame, in one call.
PairCorrelationResult pairCorrelation(const Frame& frame, const PairCorrelationOptions& options);

} // namespace sandglass::analysis
