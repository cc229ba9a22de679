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
  held_.clear();
  moving_.clear();
  for (std::size_t i = 0; any_ && i < grains.size(); ++i) {
    if (!frozen_[grains.species[i]]) continue;
    held_.push_back({static_cast<std::int32_t>(i), grains.place[i], grains.motion[i],
                     grains.turning ? grains.roll[i] : Quad{}});
    if (held_.back().moves()) moving_.push_back(held_.size() - 1);
  }
}

std::vector<std::int32_t> FrozenGrains::moving() const {
  std::vector<std::int32_t> grains;
  for (const std::size_t k : moving_)
    grains.push_back(held_[k].grain);
  return grains;
}

void FrozenGrains::hold(GrainStore& grains) const {
  for (const Held& h : held_) {
    grains.place[h.grain] = h.place;
    grains.motion[h.grain] = h.motion;
    if (grains.turning) grains.roll[h.grain] = h.roll;
  }
}

void FrozenGrains::advance(double dt) {
  for (const std::size_t k : moving_) {
    Held& h = held_[k];
    h.place.x += dt * h.motion.x;
    h.place.y += dt * h.motion.y;
    h.place.z += dt * h.motion.z;
  }
}

void FrozenGrains::tally(const ParticleLoop& loop, double worked) {
  double power = 0.0;
  Vec3 force, torque;
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    const Held& h = held_[moving_[k]];
    loop.watchedForce(k, force, torque);
    power -= force.dot(h.motion.vec()) + torque.dot(h.roll.w * h.roll.vec());
  }
  work_ += 0.5 * worked * (power_ + power);
  power_ = power;
}

double FrozenGrains::workWith(const std::vector<Quad>& force, const std::vector<Quad>& torque,
                              double worked) const {
  double power = 0.0;
  for (const Held& h : held_) {
    power -= force[h.grain].vec().dot(h.motion.vec());
    if (!torque.empty()) power -= torque[h.grain].vec().dot(h.roll.w * h.roll.vec());
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
