#pragma once
// One timed run and what becomes of many: the CSV and the table of medians.

#include <cstdint>
#include <string>
#include <vector>

namespace sandglass::bench {

struct Timing {
  std::string benchCase, program;
  int threads = 1;
  std::string precision; ///< "double", "double fast", "mixed"
  std::int64_t grains = 0, steps = 0;
  double cpuSeconds = 0, wallSeconds = 0;
  double bytesPerGrain = 0;    ///< 0: unknown
  double cyclesPerContact = 0; ///< of one thread, a touching contact and step; 0: unknown
  double kineticEnergy = 0;    ///< translational, at step 300; < 0: not looked at
  std::string check;           ///< a hash, or why the row is void
  int round = 0;

  double rate() const { return static_cast<double>(grains) * static_cast<double>(steps) / wallSeconds; }
  bool counts() const { return wallSeconds > 0 && !check.starts_with("void"); }
};

/// Every round of every case. Columns beyond the common ones: round, cycles_per_contact.
std::string csv(const std::vector<Timing>& timings);

/// Medians over the rounds, and the medians over rounds of the ratios to others on as many ranks or threads;
/// Markdown.
std::string summary(const std::vector<Timing>& timings);

double median(std::vector<double> values);

} // namespace sandglass::bench
