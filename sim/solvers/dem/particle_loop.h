#pragma once
// The step of all grains in one sweep through memory. Pairs stand in rows in storage order, so as soon as the
// rows of a group of grains have been evaluated, nothing later reads the old state of that group: its forces
// are summed and it is moved at once, while it is still in the cache.
//
// Leapfrog: positions and forces at full steps, velocities half a step behind,
//   v(n+1/2) = v(n-1/2) + dt (f(n)/m + g),  x(n+1) = x(n) + dt v(n+1/2),
// which is velocity Verlet with its two half kicks merged.

#include "sim/base/parallel.h"
#include "sim/contact/pair_forces.h"
#include "sim/contact/sector_contacts.h"
#include "sim/contact/wall_contacts.h"

#include <vector>

namespace sandglass {

class ParticleLoop {
public:
  ParticleLoop(GrainStore& grains, PairList& list, PairForces& pairs, const WallContacts& walls,
               const SectorContacts& across, Parallel& parallel)
      : grains_(grains), list_(list), pairs_(pairs), walls_(walls), across_(across), parallel_(parallel) {}

  /// After a rebuild: grains of a group may move as far as `listed.w` of its first says.
  void bind();

  struct Report {
    bool late = false; ///< some group has moved as far as its list allows
    bool bad = false;  ///< a velocity component reached the limit or is not a number
  };
  /// One step, with the forces that are in `walls` and `across`.
  Report step(double dt, const Vec3& gravity, double speedLimit, std::vector<PairEvent>& events,
              DeepestOverlap& deepest);

  /// Forces and torques at the present positions, which the next step of length dt begins with [N, N m], in
  /// storage order; gravity left out. Pair outputs are overwritten, nothing else.
  void forces(double dt, std::vector<Quad>& force, std::vector<Quad>& torque);

  /// Force and torque of contacts in the step just done on a grain [N, N m], until the list is made anew.
  /// `sums` keeps those of its group from call to call; `group` is -1 at first.
  void contactForce(std::int64_t grain, std::int64_t& group, GroupSums& sums, Vec3& force,
                    Vec3& torque) const;

  /// For checkpoints: how far each group may have moved since it was listed [m].
  std::vector<double>& moved() { return moved_; }

private:
  void sumGroup(int chunk, std::int64_t group, std::int64_t last, const double* ring, GroupSums& sums) const;
  template <class Done>
  void sweep(int chunk, double dt, bool keepHistory, PairForces::Scratch& scratch, Done&& done);
  void crossing(double dt, bool keepHistory);

  GrainStore& grains_;
  PairList& list_;
  PairForces& pairs_;
  const WallContacts& walls_;
  const SectorContacts& across_;
  Parallel& parallel_;
  std::vector<double> moved_, allowed_;
  std::vector<PairEvent> events_;
  DeepestOverlap deepest_;
};

} // namespace sandglass
