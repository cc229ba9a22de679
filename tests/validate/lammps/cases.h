#pragma once
// The same scenes in LAMMPS: what two independent programs must agree on.

#include "sim/scene/scene.h"
#include "tests/peers/lammps.h"
#include "tests/validate/verdicts.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sandglass::validate {

/// A contact of both programs: linear spring and dashpot without attraction, tangential spring that is
/// projected, full radii as lever arms.
struct SharedLaw {
  double stiffness = 0, dampingRate = 0; ///< [N/m], [1/s]
  double friction = 0;
  std::string contact(const std::string& a, const std::string& b) const; ///< a [[contact]] of a scene
  peers::HookeHistory coefficients() const;
};

void comparePairs(Report& report); ///< trajectories of one and two grains
/// Height, coordination, stress of settled beds, one a seed.
void compareBeds(Report& report, const std::vector<std::uint64_t>& seeds, bool quick);
/// Discharge rates from common settled beds, one a seed.
void compareHoppers(Report& report, const std::vector<std::uint64_t>& seeds, bool quick);

} // namespace sandglass::validate
