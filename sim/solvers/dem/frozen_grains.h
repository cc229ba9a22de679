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
  /// [1/kg] Small beside that of any grain, and far from the smallest numbers of single precision. Not zero:
  /// the reduced mass of two frozen grains must be a number.
  static constexpr double inverseMass = 1e-30;

  explicit FrozenGrains(const Scene& scene);

  bool any() const { return any_; }
  bool holds(int species) const { return any_ && frozen_[species]; }
  std::size_t count() const { return held_.size(); }

  /// After grains came, left or changed places: takes the motion that they have now as the one to keep.
  void capture(const GrainStore& grains);
  /// Calls visit(storage index) for each.
  template <class Visit> void each(Visit&& visit) const {
    for (const Held& h : held_)
      visit(h.grain);
  }
  /// Storage indices of those that move or turn, whose forces advance() asks the loop for.
  std::vector<std::int32_t> moving() const;
  /// Gives them back what capture() found, at the place where advance() has brought them.
  void hold(GrainStore& grains) const;
  /// After a step of the particle loop: they go on as they are. `worked`: the time since the step before [s],
  /// over which the work of their contacts is added up; leap-frog integration makes it dt times the mean of
  /// the powers at its ends, as for walls.
  void advance(GrainStore& grains, const ParticleLoop& loop, double dt, double worked);

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
  std::vector<Held> held_; ///< in storage order
  double work_ = 0, power_ = 0;
};

} // namespace sandglass
