#pragma once
// The same scenes in LAMMPS: what two independent programs must agree on.

#include "sim/scene/scene.h"
#include "tests/peers/lammps.h"
#include "tests/validate/verdicts.h"

#include <string>

namespace sandglass::validate {

/// A contact of both programs: linear spring and dashpot without attraction, tangential spring that is
/// projected, full radii as lever arms.
struct SharedLaw {
  double stiffness = 0, dampingRate = 0; ///< [N/m], [1/s]
  double friction = 0;
  std::string contact(const std::string& a, const std::string& b) const; ///< a [[contact]] of a scene
  peers::HookeHistory coefficients() const;
};

void comparePairs(Report& report);               ///< trajectories of one and two grains
void compareBeds(Report& report, bool quick);    ///< height, coordination, stress of a settled bed
void compareHoppers(Report& report, bool quick); ///< discharge rates from common settled beds

} // namespace sandglass::validate
