#pragma once
// What a contact does with an oblique collision: rebound slip against incident slip.
//
// Single spheres without spin hit each other, or a plane wall, with the scene's own laws and step. psi1 is
// the relative tangential velocity of the surfaces at the contact over the normal one before, psi2 the
// tangential one after over the normal one *before*, counted along the incident slip (Maw, Barber & Fawcett,
// Wear 38, 101, 1976; Walton & Braun, J. Rheol. 30, 949, 1986; Foerster et al., Phys. Fluids 6, 1108, 1994).
// Where a solid sphere slides through the whole collision, psi2 = psi1 - (7/2) mu (1 + e), in the limit of
// stiff grains and without rolling resistance, whose couple at a wall takes spin away.

#include "analysis/result.h"
#include "sim/scene/scene.h"

namespace sandglass::analysis {

struct ImpactMapOptions {
  /// [m/s] of the impacts; 0: so slow that the surfaces move by no more than 0.2 % of a diameter meanwhile
  /// and the normal hardly turns
  double normalSpeed = 0;
  double largestSlip = 0; ///< greatest psi1; 0: half as much again as where sliding begins
  int angles = 41;
};

/// Each species on its like and on each material of the walls, mean diameters: a series each, and the sliding
/// branch of each that has friction. Numbers: "<series> restitution" at psi1 = 0 and "<series> friction".
/// Collisions that do not end (adhesion) are NaN. Throws InputError when the solver cannot run the scene's
/// laws, RunError when the impacts are too hard for the step.
Curve impactMap(const Scene& scene, const ImpactMapOptions& options = {});

} // namespace sandglass::analysis
