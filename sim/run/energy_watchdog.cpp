#include "sim/run/energy_watchdog.h"

#include "sim/base/error.h"
#include "sim/run/bytes.h"
#include "sim/run/probe.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass {

EnergyWatchdog::EnergyWatchdog(const Scene& scene) : scene_(scene), on_(true) {
  measureFrom(scene.gravity);
}

void EnergyWatchdog::measureFrom(const Vec3& gravity) {
  const Domain& domain = scene_.domain;
  gravity_ = gravity;
  on_ = std::all_of(scene_.contacts.begin(), scene_.contacts.end(), [](const ContactSpec& contact) {
    const Parameters& friction = contact.tangential.parameters;
    return contact.gap.empty() && !(friction.has("slip") && friction.text("slip") == "spin");
  });
  lowestPotential_ = 0;
  for (int k = 0; k < 3; ++k) {
    if (domain.periodic[static_cast<std::size_t>(k)] && gravity[k] != 0) on_ = false;
    lowestPotential_ -= std::max(gravity[k] * domain.upper[k], gravity[k] * domain.lower[k]);
  }
  negligible_ = 1e-6 * gravity.norm() * (domain.upper - domain.lower).norm();
}

void EnergyWatchdog::gravityChanged(const Vec3& gravity, const Solver& solver, const Energies& energies) {
  measureFrom(gravity);
  const Flow& flow = solver.flow();
  const double mass = flow.massEntered + flow.massRecycled - flow.massDischarged;
  ever_ = energies.total() - mass * lowestPotential_ - solver.wallWork();
  recent_.clear();
}

void EnergyWatchdog::entered(const std::vector<GrainSeed>& grains, double measured) {
  if (!on_) return;
  double energy = 0, mass = 0;
  for (const auto& grain : grains) {
    mass += grainMass(scene_, grain);
    const double inertia = 0.4 * grain.radius * grain.radius; // per mass, of a solid sphere
    energy += grainMass(scene_, grain) *
              (0.5 * grain.velocity.squaredNorm() + 0.5 * inertia * grain.spin.squaredNorm() -
               gravity_.dot(grain.position) - lowestPotential_);
  }
  energy = std::max(energy, measured - mass * lowestPotential_);
  ever_ += energy;
  for (Check& check : recent_)
    check.energy += energy;
}

void EnergyWatchdog::check(const Solver& solver, const Energies& energies) {
  if (!on_) return;
  const Flow& flow = solver.flow();
  const double mass = flow.massEntered + flow.massRecycled - flow.massDischarged;
  const double now = energies.total() - mass * lowestPotential_, work = solver.wallWork();
  // Without sources, energy minus work of the walls never grows. Its size says nothing (a mixer's work is all
  // dissipated again): the margin is a share of the energy that is there or has just passed through.
  double before = ever_, through = std::abs(ever_);
  largestWork_ = std::max(largestWork_, std::abs(work));
  if (!recent_.empty()) {
    const auto freed = [](const Check& c) { return c.energy - c.work; };
    const auto most = *std::max_element(recent_.begin(), recent_.end(),
                                        [&](const Check& a, const Check& b) { return freed(a) < freed(b); });
    before = std::min(ever_, freed(most));
    through = std::abs(freed(most) < ever_ ? most.energy : ever_);
  }
  const double sinceThen = recent_.empty() ? work : work - recent_.front().work;
  const double margin =
      allowedGain * (through + std::abs(sinceThen)) + mass * negligible_ + 1e-9 * largestWork_;
  if (now - work > before + margin)
    throw RunError(fmt::format("at {:.6g} s the mechanical energy grew from {:.4g} J to {:.4g} J within {} "
                               "grains and without a source "
                               "(at most {:.0f} % may come from round-off and hidden springs); reduce the "
                               "time step ({:.3g} s now) or "
                               "check the contact parameters",
                               solver.time(), before + work, now, solver.grains(), 100 * allowedGain,
                               solver.stepSize()));
  recent_.push_back({now, work});
  if (recent_.size() > window) recent_.erase(recent_.begin());
}

std::vector<std::byte> EnergyWatchdog::save() const {
  ByteWriter out;
  out << gravity_.x() << gravity_.y() << gravity_.z() << ever_ << recent_ << largestWork_;
  return out.take();
}

void EnergyWatchdog::load(const std::vector<std::byte>& bytes) {
  Vec3 gravity;
  ByteReader(bytes) >> gravity.x() >> gravity.y() >> gravity.z() >> ever_ >> recent_ >> largestWork_;
  measureFrom(gravity);
}

} // namespace sandglass
