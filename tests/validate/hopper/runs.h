#pragma once
// Runs of the reduced hopper: each bed once a seed, several one-thread runs side by side, results kept for
// all cases that ask for them.

#include "analysis/discharge.h"
#include "sim/frame/frame.h"
#include "tests/validate/hopper/bed.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sandglass::validate {

/// What one run left.
struct HopperRun {
  std::uint64_t seed = 0;
  analysis::DischargeData discharged; ///< mass below the lip against time
  double massEntered = 0;             ///< [kg]
  double rate = 0, halfWidth = 0;     ///< [kg/(m s)], slope of 10 to 50 % per depth, 95 %
  double opened = 0;                  ///< [s], when the gate vanished
  double fillHeight = 0;              ///< [m], of the highest grain of the bed at opening
  double flowingDensity = 0;          ///< [kg/m^3], mean over 10 to 50 % in a box above the outlet
  double imbalance = 0;               ///< mass neither discharged nor present, as a share
  std::vector<double> heightTime, heightAboveOutlet; ///< [s], [m]: surface above the outlet against time
  FramePtr last;                                     ///< at the end
};

/// Mean over seeds and half width of its 95 % interval (Student's t).
struct Mean {
  double value = 0, halfWidth = 0;
};
Mean meanOf(const std::vector<double>& values);

class HopperRuns {
public:
  HopperRuns(std::vector<std::uint64_t> seeds, bool quick) : seeds_(std::move(seeds)), quick_(quick) {}

  void ask(const HopperBed& bed) { asked_.emplace(bed.key(), bed); }
  /// Runs all that was asked for. Throws what a run throws.
  void execute();

  const std::vector<HopperRun>& of(const HopperBed& bed) const { return runs_.at(bed.key()); }
  Mean rate(const HopperBed& bed) const; ///< [g/(cm s)], as the source has it
  /// Ratio of the rates of two beds, seed by seed.
  Mean ratio(const HopperBed& above, const HopperBed& below) const;
  const std::vector<std::uint64_t>& seeds() const { return seeds_; }
  bool quick() const { return quick_; }
  /// bed, seed, rate, half width, grains' mass, fill height, flowing density
  std::string csv() const;

private:
  HopperRun run(const HopperBed& bed, std::uint64_t seed) const;

  std::vector<std::uint64_t> seeds_;
  bool quick_ = false;
  std::map<std::string, HopperBed> asked_;
  std::map<std::string, std::vector<HopperRun>> runs_;
};

} // namespace sandglass::validate
