#pragma once
// Stops a run whose mechanical energy rises without a source.
//
// Contacts, friction and outlets only take energy away; what fillings and fields bring in is counted. Energy
// that leaves with a grain through an outlet must not look like a gain, so potential energy is measured from
// the lowest corner of the domain, where no grain's is negative. A step that is too long shows as growth
// within a few hundred steps, and a slow leak as growth over the start; both are compared with a margin that
// lets the energy stored in tangential and rolling springs, which solvers need not report, come back. What
// moving walls put in is known and taken off; the margin grows with what they have put in lately.
//
// Off where the sum is not bounded by what came in: gravity along a periodic direction, gap laws (whose
// potential is not in Energies), friction of spins alone (which makes energy).

#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

#include <deque>

namespace sandglass {

class EnergyWatchdog {
public:
  /// Share of the energy that may appear from nowhere.
  static constexpr double allowedGain = 0.1;

  explicit EnergyWatchdog(const Scene& scene);
  /// Grains that a filling or rain has just added; `measured` is the energy that the solver found more
  /// afterwards, which is larger where they began in contact.
  void entered(const std::vector<GrainSeed>& grains, double measured = 0);
  /// Potential energies are others from now on: what is there now is what came in.
  void gravityChanged(const Vec3& gravity, const Solver& solver, const Energies& energies);
  /// To be called every few hundred steps. Throws RunError.
  void check(const Solver& solver, const Energies& energies);

  std::vector<std::byte> save() const;
  void load(const std::vector<std::byte>& bytes);

private:
  static constexpr std::size_t window = 10;
  void measureFrom(const Vec3& gravity);
  const Scene& scene_;
  Vec3 gravity_ = Vec3::Zero();
  bool on_;
  double lowestPotential_ = 0; ///< [J/kg]
  double negligible_ = 0;      ///< [J/kg], round-off of the potential energy
  double ever_ = 0;            ///< [J], all that came in
  /// One check: energies in J, raised by what came in since.
  struct Check {
    double energy = 0; ///< mechanical
    double work = 0;   ///< of moving walls, up to then
  };
  std::vector<Check> recent_; ///< the last checks
  double largestWork_ = 0;    ///< [J] of moving walls, so far
};

} // namespace sandglass
