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
  bool holds(int species) const { return any_ && frozen_[species]; }
  std::size_t count() const { return held_.size(); }

  /// After grains came, left or changed places: takes the motion that they have now as the one to keep.
  void capture(const GrainStore& grains);
  /// Storage indices of those that move or turn, whose forces tally() asks the loop for.
  std::vector<std::int32_t> moving() const;
  /// Gives them back what capture() found, at the places where advance() has brought them.
  void hold(GrainStore& grains) const;
  /// Before a step of the particle loop: where it will leave them.
  void advance(double dt);
  /// After it: adds up the work of their contacts. `worked`: the time since the step before [s]; leap-frog
  /// integration makes it dt times the mean of the powers at its ends, as for walls.
  void tally(const ParticleLoop& loop, double worked);

  /// Work that they have done on other grains [J] up to a full step with these contact forces and torques.
  double workWith(const std::vector<Quad>& force, const std::vector<Quad>& torque, double worked) const;

  /// For checkpoints: work and power of the last step.
  std::vector<double> state() const { return {work_, power_}; }
  void setState(const std::vector<double>& state);

private:
  struct Held {
    std::int32_t grain; ///< storage index
    Quad place, motion, roll;
    bool moves() const { return motion.vec() != Vec3::Zero() || roll.vec() != Vec3::Zero(); }
  };

  std::vector<bool> frozen_; ///< by species
  bool any_ = false;
  std::vector<Held> held_;          ///< in storage order
  std::vector<std::size_t> moving_; ///< which of them move or turn
  double work_ = 0, power_ = 0;
};

} // namespace sandglass
