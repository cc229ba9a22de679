#pragma once
// The grains that a filling is made of: which species in which shares, and the means that follow.

#include "sim/grains/seeding.h"
#include "sim/grains/size_distribution.h"
#include "sim/scene/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sandglass {

class Mixture {
public:
  Mixture(const Scene& scene, const FillSpec& fill);

  double meanMass() const { return meanMass_; }     ///< [kg], average over grains
  double meanVolume() const { return meanVolume_; } ///< [m^3], average over grains
  double largest() const { return largest_; }       ///< largest diameter [m]
  double smallest() const { return smallest_; }     ///< smallest diameter [m]

  /// `count` grains with ids from `firstId`: species in exact shares (largest remainder), in random order;
  /// diameters drawn by id. Positions and velocities are left at zero.
  std::vector<GrainSeed> draw(std::uint64_t seed, std::int64_t firstId, std::int64_t count) const;

  /// One grain whose species is drawn at random, for fillings that do not know how many will come.
  GrainSeed drawOne(std::uint64_t seed, std::int64_t id) const;

private:
  struct Part {
    int species;
    double numberShare;
    std::unique_ptr<const SizeDistribution> sizes;
  };
  GrainSeed grain(std::uint64_t seed, std::int64_t id, const Part& part) const;

  std::vector<Part> parts_;
  double meanMass_ = 0, meanVolume_ = 0, largest_ = 0, smallest_ = 0;
};

/// Gives a grain the velocity and spin that the filling's parameters ask for.
void setMotion(GrainSeed& grain, std::uint64_t seed, const Parameters& parameters);

} // namespace sandglass
