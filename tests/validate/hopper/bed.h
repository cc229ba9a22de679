#pragma once
// The reduced bed on which the dry hopper of Anand (PhD thesis, University of Florida, 2009) is reproduced,
// and all that his cases vary on it.

#include "sim/scene/scene.h"

#include <cstdint>
#include <string>

namespace sandglass::validate {

/// Lengths in metres, angles in degrees. The defaults are the base case: 3500 glass beads in a flat-bottomed
/// bin three outlets wide, periodic in depth.
struct HopperBed {
  double width = 7.5e-2, outlet = 2.5e-2, depth = 0.56e-2;
  double halfAngle = 90;
  int number = 3500; ///< of beads of `diameter`; with fines: as many as would have the same mass without
  double diameter = 2.24e-3;
  double finesDiameter = 1.16e-3;
  double finesShare = 0;                         ///< of the mass, in beads of `finesDiameter`
  double friction = 0.2;                         ///< grain on grain
  double wallFriction = 0.2;                     ///< grain on wall
  double unloading = 283, wallUnloading = 308.6; ///< [N/m]; loading is 250: restitution 0.94 and 0.90
  double rollingLength = 1e-4;                   ///< couple over normal force, grains and walls
  bool emptied = false;                          ///< run until nothing leaves any more, not only to 55 %

  /// Names the bed in tables and keeps equal beds from being run twice.
  std::string key() const;
  /// The same vessel with grains `times` as large: far fewer of them, for a quick look.
  HopperBed coarser(double times) const;
  double totalMass() const; ///< [kg]
  double lip() const;       ///< [m] height of the short walls below the outlet
  double timeStep() const;  ///< [s], a 21st of the shortest collision as in the base case
  Scene scene(std::uint64_t seed, double coarse = 1) const; ///< `coarse`: times the step (quick look only)
};

inline constexpr double glassDensity = 2500, loadingStiffness = 250;
inline constexpr double standardGravity = 9.81;

double sphereMass(double diameter, double density = glassDensity);
/// Duration of a head-on collision under the partially latching spring of Walton and Braun:
/// (pi/2) sqrt(m) (1/sqrt(k1) + 1/sqrt(k2)), m the reduced mass.
double latchingTime(double reducedMass, double loading, double unloading);
/// The law as a scene writes it.
std::string latchingLaw(double loading, double unloading);

} // namespace sandglass::validate
