#include "sim/contact/restitution.h"

#include <cmath>
#include <numbers>

namespace sandglass {

double dampingRatio(double restitution) {
  const double l = std::log(restitution);
  return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

namespace {

/// Restitution of a clamped contact with damping ratio z: the force k x + gamma v returns to zero at time
/// t = (pi - atan(2 beta w / (w^2 - beta^2))) / w for z < 1, by the hyperbolic twin for z > 1 (natural
/// frequency 1, beta = z).
double clampedRestitution(double z) {
  if (z < 1.0) {
    const double w = std::sqrt(1.0 - z * z);
    const double t = std::atan2(2.0 * z * w, 2.0 * z * z - 1.0) / w;
    return std::exp(-z * t);
  }
  if (z == 1.0) return std::exp(-2.0);
  const double w = std::sqrt(z * z - 1.0);
  return std::exp(-z / w * std::log((z + w) / (z - w)));
}

} // namespace

double dampingRatioClamped(double restitution) {
  double low = 0.0, high = 1.0;
  while (clampedRestitution(high) > restitution)
    high *= 2.0;
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (clampedRestitution(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

} // namespace sandglass
