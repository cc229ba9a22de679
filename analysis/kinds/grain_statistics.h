#pragma once
// Averages over the grains of each Frame and over Frames, with errors; for analyses that give one value a
// grain.

#include "analysis/result.h"

#include <span>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// One quantity over all Frames.
class GrainStatistics {
public:
  /// NaN values are left out.
  void add(std::span<const double> values, std::span<const char> used);

  std::size_t count() const { return all_.size(); }
  double mean() const;
  double error() const; ///< of the mean; from the Frames' means where there are four or more, else NaN
  double deviation() const;

  /// Density over the range of the values.
  Curve distribution(const std::string& name, const std::string& title, const Axis& axis,
                     const std::string& definition, int bins) const;
  /// Shares of whole numbers.
  Curve shares(const std::string& name, const std::string& title, const Axis& axis,
               const std::string& definition) const;

private:
  void addNumbers(Curve& curve) const;
  std::vector<double> all_, means_;
};

/// "0.574 +- 0.001"
std::string withError(double value, double error);

} // namespace sandglass::analysis
