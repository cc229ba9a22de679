#pragma once
// The same scene over several seeds: mean, scatter and confidence interval of what the runs end with, and the
// mean discharge curve with its band.

#include "analysis/discharge.h"
#include "analysis/result.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// One finished run.
struct Replicate {
  std::uint64_t seed = 0;
  std::map<std::string, double> quantities; ///< by name; one that this run does not give is absent or NaN
  DischargeData discharge;                  ///< time [s] since its stage began; empty: no flow_rate probe
  double opened = 0;                        ///< [s], start of the stage in which discharge began
};

/// mean +- halfWidth is Student's interval; NaN for fewer than two values.
struct Spread {
  double mean = 0, standardDeviation = 0, halfWidth = 0;
  std::size_t count = 0;
};
Spread spreadOf(std::span<const double> values, double confidence = 0.95);

/// SI symbols by name of the quantity; none for those that have none.
using Units = std::map<std::string, std::string>;

/// One row for each run: its seed and what it ended with.
Table replicateTable(const std::vector<Replicate>& runs, const Units& units);

/// One row for each quantity: mean, standard deviation, half width of the interval, number of runs.
Table replicateSummary(const std::vector<Replicate>& runs, const Units& units, double confidence = 0.95);

/// Mean of the discharged mass over the runs (its error: the standard error of the mean) with the lower and
/// the upper end of Student's interval, at the times of the first run's samples, linear between samples. It
/// ends where the first run ends. Throws InputError when no run has a curve.
Curve meanDischarge(const std::vector<Replicate>& runs, double confidence = 0.95);

} // namespace sandglass::analysis
