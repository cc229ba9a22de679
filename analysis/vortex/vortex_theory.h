#pragma once
// What rotating-fluid theory says of a bed in a round tank (Rice, M.S. thesis, University of Mississippi,
// 2012, chapter 4, with the corrections that make the units right). SI units throughout.
//
// In the frame that turns with the bed the surface is z(x) = z(0) + Omega^2 x^2 / (2 g). The critical
// rotation is that at which its apex touches the floor: the volume under such a paraboloid, pi Omega^2 R^4 /
// (4 g), is then that of the bed.

namespace sandglass::analysis {

/// Packing fraction of the closest packing of equal spheres, pi / (3 sqrt 2).
inline constexpr double closestPacking = 0.74048048969306104;

/// Volume [m^3] that `grains` equal spheres take up at packing fraction `packing`.
double bedVolume(double grains, double radius, double packing = closestPacking);

/// Volume [m^3] under the paraboloid whose apex touches the floor of a tank of this radius.
double paraboloidVolume(double rotation, double tankRadius, double gravity);

/// Omega_c = (2 / R^2) sqrt(V g / pi) [rad/s]; at the closest packing (4 / R^2) sqrt(sqrt(2) n r^3 g / pi).
double criticalRotation(double grains, double radius, double tankRadius, double gravity,
                        double packing = closestPacking);

/// Grains of radius `radius` that fill `volume` at this packing: not rounded.
double grainsForVolume(double volume, double radius, double packing = closestPacking);

/// Net vertical force [N] on a lone grain in a wind of pressure scale S [N/m^2] that decays with height,
/// pi r^2 S exp(-beta z) - (4/3) pi r^3 rho g: zero at liftRadius(), greatest at two thirds of it.
double netLift(double radius, double pressure, double decay, double height, double density, double gravity);
double liftRadius(double pressure, double decay, double height, double density, double gravity);

} // namespace sandglass::analysis
