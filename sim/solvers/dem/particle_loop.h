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
#include "sim/fields/field_stack.h"
#include "sim/solvers/dem/group_travel.h"

#include <array>
#include <vector>

namespace sandglass {

class ParticleLoop {
public:
  ParticleLoop(GrainStore& grains, PairList& list, PairForces& pairs, WallContacts& atWalls,
               const std::vector<SolverWall>& walls, const SectorContacts& across, FieldStack& fields,
               Parallel& parallel)
      : grains_(grains), list_(list), pairs_(pairs), atWalls_(atWalls), walls_(walls), across_(across),
        fields_(fields), parallel_(parallel) {}

  /// After a rebuild.
  void bind();

  struct Report {
    bool late = false; ///< some group has moved as far as its list allows
    bool bad = false;  ///< a velocity component reached the limit or is not a number
  };
  /// One step, with the forces that are in `across`, and what `fields` have looked up. Walls stand where
  /// placeWalls() has put them.
  Report step(double dt, const Vec3& gravity, double speedLimit, std::vector<PairEvent>& events,
              DeepestOverlap& deepest);

  /// Forces and torques at the present positions, which the next step of length dt begins with [N, N m], in
  /// storage order; gravity left out. Walls know their loads then. Pair outputs are overwritten, nothing
  /// else.
  void forces(double dt, const Vec3& gravity, std::vector<Quad>& force, std::vector<Quad>& torque);

  /// Storage indices, ascending, of grains whose contact forces are to be kept from each step, until the list
  /// is made anew.
  void watch(std::vector<std::int32_t> grains);
  /// Force and torque of contacts in the step just done on the k-th of them [N, N m].
  void watchedForce(std::size_t k, Vec3& force, Vec3& torque) const;

  /// How far groups may have moved since they were listed.
  GroupTravel& travel() { return travel_; }

private:
  void keepWatched(std::int64_t first, std::int64_t last, GroupSums sums);
  void addWalls(std::int64_t group, std::int64_t last, WallContacts::Sweep& atWalls, GroupSums sums) const;
  template <class Done>
  void sweep(int chunk, double dt, bool keepHistory, PairForces::Scratch& scratch, Done&& done);
  void crossing(double dt, bool keepHistory);

  GrainStore& grains_;
  PairList& list_;
  PairForces& pairs_;
  WallContacts& atWalls_;
  const std::vector<SolverWall>& walls_;
  const SectorContacts& across_;
  FieldStack& fields_;
  Parallel& parallel_;
  GroupTravel travel_;
  std::vector<std::int32_t> watched_;
  std::vector<std::array<double, 12>> watchedSums_; ///< as a row of GroupSums has them
  std::vector<PairEvent> events_;
  DeepestOverlap deepest_;
};

} // namespace sandglass
