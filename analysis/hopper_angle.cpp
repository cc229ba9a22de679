#include "analysis/hopper_angle.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <cmath>
#include <numbers>

namespace sandglass::analysis {

namespace {

double integralOfRootCosine(double to) {
  // t = pi/2 - u^2 takes the root's vertical end away.
  const double from = std::sqrt(std::numbers::pi / 2 - to);
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
      [](double u) { return 2 * u * std::sqrt(std::max(0.0, std::sin(u * u))); }, from,
      std::sqrt(std::numbers::pi / 2));
}

} // namespace

double brownRichards(double halfAngle, OutletShape shape) {
  const double sine = std::sin(halfAngle);
  if (shape == OutletShape::circle)
    return (1 - std::pow(std::max(0.0, std::cos(halfAngle)), 1.5)) / std::pow(sine, 2.5);
  return integralOfRootCosine(halfAngle) / std::pow(sine, 1.5) / integralOfRootCosine(std::numbers::pi / 2);
}

double roseTanaka(double halfAngle, double stagnantAngle) {
  const double product = std::tan(halfAngle) * std::tan(stagnantAngle);
  return product > 0 && product < 1 ? std::pow(product, -0.35) : 1;
}

} // namespace sandglass::analysis
