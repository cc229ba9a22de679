#pragma once
// Grains that are about to enter a run: what the fillings produce and a solver takes in.

#include "sim/base/log.h"
#include "sim/base/vec.h"
#include "sim/scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace sandglass {

struct GrainSeed {
  std::int64_t id = 0;
  int species = 0;                  ///< index into Scene::species
  double radius = 0;                ///< [m]
  Vec3 position = Vec3::Zero();     ///< [m]
  Vec3 velocity = Vec3::Zero();     ///< [m/s]
  Vec3 spin = Vec3::Zero();         ///< [rad/s]
  std::int32_t life = 0;            ///< how often an outlet has put it back, where outlets do
  std::vector<double> quantities{}; ///< conserved quantities of the laws; empty: zero
};

/// A grain as it passed an outlet.
struct LeftGrain {
  GrainSeed grain;
  int outlet = 0;       ///< index into Scene::outlets
  double time = 0;      ///< [s]
  double residence = 0; ///< [s] since it entered or was put back
};

/// Grains placed at once, before the first step of their stage, by all fillings of `stage` but "rain".
/// No two overlap, none overlaps a wall; ids start at `firstId`. `present` are the grains already there.
/// Throws InputError when they cannot fit (says how many did and what share of the space that is).
std::vector<GrainSeed> placeGrains(const Scene& scene, const std::string& stage, std::int64_t firstId,
                                   const std::vector<GrainSeed>& present, const Log& log = {});

/// Rain: grains that appear in a region at a rate while a stage runs. Which grains appear at a step depends
/// on the scene, the step's time and the grains near the region alone.
class Rain {
public:
  virtual ~Rain() = default;
  /// Grains due in (timeBefore, timeNow] that found room; `isFree(position, radius)` asks the solver whether
  /// a sphere there touches nothing. Those that find none are tried again next time.
  virtual std::vector<GrainSeed> due(double timeInStage, std::int64_t firstId,
                                     const std::function<bool(const Vec3&, double)>& isFree) = 0;
  virtual bool finished() const = 0; ///< never for rain without a number
  virtual bool endless() const = 0;  ///< whether some of it has no number
  /// What has not been delivered by the end of the stage, a sentence for each filling that lags.
  virtual std::vector<std::string> shortfall(double timeInStage) const = 0;
  /// State for checkpoints: counts of grains placed so far.
  virtual std::vector<std::int64_t> state() const = 0;
  virtual void setState(const std::vector<std::int64_t>& state) = 0;
};

/// The rain of one stage, or null when the stage has none.
std::unique_ptr<Rain> makeRain(const Scene& scene, const std::string& stage);

/// Largest and smallest diameter and mean mass that a species can have; for steps, lists and estimates.
struct SizeRange {
  double smallest = 0, largest = 0, meanDiameter = 0; ///< [m]
  double meanMass = 0;                                ///< [kg]
};
SizeRange sizeRange(const Scene& scene, const Species& species);

/// Number of grains that a rain will bring: as it says, or rate times duration; 0 when the stage has none.
std::int64_t rainCount(const Scene& scene, const FillSpec& fill);

/// Number of grains that the whole scene will bring in, as far as it can be known beforehand.
std::int64_t expectedGrains(const Scene& scene);

} // namespace sandglass
