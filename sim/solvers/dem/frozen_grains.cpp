#include "sim/solvers/dem/frozen_grains.h"

#include "sim/base/error.h"
#include "sim/solvers/dem/particle_loop.h"

namespace sandglass {

FrozenGrains::FrozenGrains(const Scene& scene) {
  for (const Species& species : scene.species) {
    frozen_.push_back(species.frozen);
    any_ = any_ || species.frozen;
  }
}

void FrozenGrains::capture(const GrainStore& grains) {
  moving_.clear();
  count_ = 0;
  for (std::size_t i = 0; any_ && i < grains.size(); ++i) {
    if (!frozen_[grains.species[i]]) continue;
    ++count_;
    const Quad motion = grains.motion[i], roll = grains.turning ? grains.roll[i] : Quad{};
    if (motion.vec() != Vec3::Zero() || roll.vec() != Vec3::Zero())
      moving_.push_back({static_cast<std::int32_t>(i), motion, roll});
  }
}

std::vector<std::int32_t> FrozenGrains::moving() const {
  std::vector<std::int32_t> grains;
  for (const Moving& m : moving_)
    grains.push_back(m.grain);
  return grains;
}

void FrozenGrains::tally(const ParticleLoop& loop, double worked) {
  double power = 0.0;
  Vec3 force, torque;
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    const Moving& m = moving_[k];
    loop.watchedForce(k, force, torque);
    power -= force.dot(m.motion.vec()) + torque.dot(m.roll.w * m.roll.vec());
  }
  work_ += 0.5 * worked * (power_ + power);
  power_ = power;
}

double FrozenGrains::workWith(const std::vector<Quad>& force, const std::vector<Quad>& torque,
                              double worked) const {
  double power = 0.0;
  for (const Moving& m : moving_) {
    power -= force[m.grain].vec().dot(m.motion.vec());
    if (!torque.empty()) power -= torque[m.grain].vec().dot(m.roll.w * m.roll.vec());
  }
  return work_ + 0.5 * worked * (power_ + power);
}

void FrozenGrains::setState(const std::vector<double>& state) {
  if (state.size() != 2)
    throw InputError(
        "the checkpoint's 'frozen' does not fit the scene; it belongs to another scene or version");
  work_ = state[0];
  power_ = state[1];
}

} // namespace sandglass
