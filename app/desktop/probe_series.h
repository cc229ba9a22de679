#pragma once
// What the probes of the open run have seen, and the curves that the panels show of it.

#include "analysis/result.h"
#include "sim/run/run.h"

#include <filesystem>
#include <optional>
#include <string>

namespace sandglass::desktop {

class ProbeSeries {
public:
  void clear() { columns_.clear(); }
  void add(const ProbeSample& sample);
  /// Forgets samples later than `time`: a resumed run makes them again.
  void restartFrom(double time);
  /// Reads series.csv of a run; leaves everything as it was when there is none. Throws InputError.
  void load(const std::filesystem::path& runFolder);

  /// Energies by kind against time; nothing when the scene has no such probe or it has not been sampled.
  std::optional<analysis::Curve> energies(const Scene& scene) const;
  /// Mass through the plane of the first flow_rate probe per time, as means over equal spans of time.
  std::optional<analysis::Curve> flowRate(const Scene& scene) const;

private:
  struct Column {
    std::vector<double> time, value;
  };
  const Column* find(const std::string& probe, const std::string& value) const;
  std::map<std::string, Column> columns_; ///< "<probe>.<value>"
};

} // namespace sandglass::desktop
