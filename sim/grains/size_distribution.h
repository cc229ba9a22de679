#pragma once
// How large the grains of a species are. To add a distribution: one class and one line in
// size_distribution.cpp.

#include "sim/base/random.h"
#include "sim/scene/parameters.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

/// Diameters [m] between smallest() and largest(); all moments are averages over grains (by number),
/// whichever way the scene weighs the distribution.
class SizeDistribution {
public:
  virtual ~SizeDistribution() = default;
  virtual double smallest() const = 0;
  virtual double largest() const = 0;
  virtual double draw(RandomStream& random) const = 0;
  virtual double mean() const = 0;     ///< of d [m]
  virtual double meanCube() const = 0; ///< of d^3 [m^3]
};

struct SizeKind {
  std::string name;
  std::string description;
  std::vector<ParameterSpec> parameters;
  /// Throws InputError (a phrase without file and line) when the values contradict each other.
  std::function<std::unique_ptr<const SizeDistribution>(const Parameters&)> make;
};

/// All kinds: single, uniform, normal, lognormal, table.
const std::vector<SizeKind>& sizeKinds();

/// The distribution of that kind; throws InputError when there is none.
std::unique_ptr<const SizeDistribution> makeSizeDistribution(const std::string& kind,
                                                             const Parameters& parameters);

} // namespace sandglass
