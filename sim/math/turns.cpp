#include "sim/math/turns.h"

#include <cmath>
#include <numbers>

namespace sandglass {

SineCosine sineCosineOfTurns(double turns) {
  turns -= std::floor(turns);                                         // exact: [0, 1]
  const double quarter = std::floor(4.0 * turns + 0.5);               // nearest multiple of a quarter turn
  const double x = 2.0 * std::numbers::pi * (turns - 0.25 * quarter); // |x| <= pi/4
  const double y = x * x;
  // Taylor series by Horner's rule; the first term left out is below 1e-17 of the sum at pi/4.
  double s = 1.0, c = 1.0;
  for (int k = 16; k >= 2; k -= 2) {
    s = 1.0 - y / (k * (k + 1)) * s;
    c = 1.0 - y / (k * (k - 1)) * c;
  }
  s *= x;
  switch (static_cast<int>(quarter) % 4) {
  case 1:
    return {c, -s};
  case 2:
    return {-s, -c};
  case 3:
    return {-c, s};
  default:
    return {s, c};
  }
}

} // namespace sandglass
