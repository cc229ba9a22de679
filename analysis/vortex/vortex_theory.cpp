#include "analysis/vortex/vortex_theory.h"

#include <cmath>
#include <numbers>

namespace sandglass::analysis {

using std::numbers::pi;

double bedVolume(double grains, double radius, double packing) {
  return grains * 4.0 / 3.0 * pi * radius * radius * radius / packing;
}

double paraboloidVolume(double rotation, double tankRadius, double gravity) {
  const double square = tankRadius * tankRadius;
  return pi * rotation * rotation * square * square / (4 * gravity);
}

double criticalRotation(double grains, double radius, double tankRadius, double gravity, double packing) {
  return 2 / (tankRadius * tankRadius) * std::sqrt(bedVolume(grains, radius, packing) * gravity / pi);
}

double grainsForVolume(double volume, double radius, double packing) {
  return volume / bedVolume(1, radius, packing);
}

double netLift(double radius, double pressure, double decay, double height, double density, double gravity) {
  return pi * radius * radius * pressure * std::exp(-decay * height) -
         4.0 / 3.0 * pi * radius * radius * radius * density * gravity;
}

double liftRadius(double pressure, double decay, double height, double density, double gravity) {
  return 3 * pressure * std::exp(-decay * height) / (4 * density * gravity);
}

} // namespace sandglass::analysis
