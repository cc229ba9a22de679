#pragma once
// Grains of species that are frozen (Species::frozen): as heavy as a wall, so that contacts change neither
// their velocity nor their spin, and gravity and drag do not act on them. They keep the motion that their
// filling gave them: zero for a rough floor, a velocity for a rough plate that is drawn along.
// To the contact core they are grains like others, of a mass so large that its share in any reduced mass is
// lost in rounding; what a step does to their records all the same is taken back here. Scenes without them
// pay nothing.

#include "sim/grains/grain_store.h"
#include "sim/scene/scene.h"

#include <cstdint>
#include <vector>

namespace sandglass {

class ParticleLoop;

class FrozenGrains {
public:
  explicit FrozenGrains(const Scene& scene);

  bool any() const { return any_; }
  std::size_t count() const { return count_; } ///< grains held fast
  bool holds(int species) const { return any_ && frozen_[species]; }

  /// After grains came, left or changed places: finds those that move or turn, as they will always do.
  void capture(const GrainStore& grains);
  /// Storage indices of those that move or turn, whose forces tally() asks the loop for.
  std::vector<std::int32_t> moving() const;
  /// After a step of the particle loop: adds up the work of their contacts. `worked`: the time since the step
  /// before [s]; leap-frog integration makes it dt times the mean of the powers at its ends, as for walls.
  void tally(const ParticleLoop& loop, double worked);

  /// Work that they have done on other grains [J] up to a full step with these contact forces and torques.
  double workWith(const std::vector<Quad>& force, const std::vector<Quad>& torque, double worked) const;

  /// For checkpoints: work and power of the last step.
  std::vector<double> state() const { return {work_, power_}; }
  void setState(const std::vector<double>& state);

private:
  struct Moving {
    std::int32_t grain; ///< storage index
    Quad motion, roll;
  };

  std::vector<bool> frozen_; ///< by species
  bool any_ = false;
  std::size_t count_ = 0;
  std::vector<Moving> moving_; ///< in storage order
  double work_ = 0, power_ = 0;
};

} // namespace sandglass
