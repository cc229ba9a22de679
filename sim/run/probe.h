#pragma once
// What a run measures while it goes on. A probe looks at the solver at its own rate and returns named values.

#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

class Probe {
public:
  virtual ~Probe() = default;
  /// Names of the values, in the order of the columns of series.csv.
  virtual std::vector<std::string> values() const = 0;
  /// One number per name in values().
  virtual std::vector<double> sample(const Solver& solver) = 0;
  /// What a probe remembers from sample to sample, for checkpoints.
  virtual std::vector<std::byte> save() const { return {}; }
  virtual void load(const std::vector<std::byte>&) {}
};

/// Kinds:
///   energies        translational, rotational, gravitational, elastic, total [J]
///   mass_in_region  mass [kg] and grains whose centres lie in [lower, upper)
///   flow_rate       rate [kg/s] through the plane (point, normal), mean since the last sample, and mass
///   [kg],
///                   its sum; grains that left count when an outlet lies on the plane or beyond it
///   wall_force      of `wall`: force.x, force.y, force.z [N] of the grains on it; torque.x ... [N m] about
///   its
///                   reference point (FrameWall); power [W] and work [J] that it does on the grains by
///                   moving; wear_work [J] of the tangential forces along the slip; collisions, contacts
///                   begun so far
/// Throws InputError for a kind that is none of these.
std::unique_ptr<Probe> makeProbe(const ProbeSpec& spec, const Scene& scene);

/// Mass of a grain of the scene [kg].
double grainMass(const Scene& scene, const GrainSeed& grain);

} // namespace sandglass
