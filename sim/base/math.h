#pragma once
// Roots and powers for code that changes the state of a run: one algorithm for every vector width, so that
// bits do not depend on it. Element-wise, without branches, of + - * / and square root and integer
// operations on the bits; a loop over these becomes vector code. Single precision goes through double.

#include <bit>
#include <cmath>
#include <cstdint>

namespace sandglass {

/// Cube root, right to one unit in the last place; 0 for x <= 0. A first guess from a third of the exponent
/// bits, two steps of Halley and one of Newton.
[[gnu::always_inline]] inline double cubeRoot(double x) {
  const bool tiny = x < 0x1p-960; // denormal results of the steps would lose bits
  const double y = tiny ? x * 0x1p+108 : x;
  const auto bits = std::bit_cast<std::uint64_t>(y);
  const std::uint64_t third = ((bits >> 32) * 0xAAAAAAABull) >> 33;
  double r = std::bit_cast<double>((third + 715094163ull) << 32);
  for (int k = 0; k < 2; ++k) {
    const double cube = r * r * r;
    r = r * ((cube + 2.0 * y) / (2.0 * cube + y));
  }
  r = r - (r * r * r - y) / (3.0 * r * r);
  return x > 0.0 ? (tiny ? r * 0x1p-36 : r) : 0.0;
}

/// Logarithm to base 2 of a normal positive number, to about 1e-15: exponent from the bits, mantissa in
/// [1/sqrt 2, sqrt 2) by the series of the inverse hyperbolic tangent.
[[gnu::always_inline]] inline double binaryLogarithm(double x) {
  constexpr double twoTo52 = 0x1p52;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto shifted = bits + (0x3FF0000000000000ull - 0x3FE6A09E667F3BCDull);
  const double exponent = std::bit_cast<double>((shifted >> 52) | 0x4330000000000000ull) - twoTo52 - 1023.0;
  const double m = std::bit_cast<double>((shifted & 0x000FFFFFFFFFFFFFull) + 0x3FE6A09E667F3BCDull);
  const double s = (m - 1.0) / (m + 1.0), s2 = s * s;
  double sum = 1.0 / 23;
  for (int k = 21; k > 0; k -= 2)
    sum = sum * s2 + 1.0 / k;
  return exponent + 2.0 * s * sum * 1.4426950408889634074;
}

/// Two to the power y for -1000 <= y <= 1000, to about 1e-16 relative: nearest integer into the exponent
/// bits, Taylor series of the rest.
[[gnu::always_inline]] inline double powerOfTwo(double y) {
  constexpr double shift = 0x1.8p52; // its last bits count ones
  const double shifted = y + shift, f = (y - (shifted - shift)) * 0.69314718055994530942;
  double sum = 1.0;
  for (int k = 14; k > 0; --k)
    sum = 1.0 + sum * f / k;
  return sum * std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
}

/// base^exponent for 0 <= base <= 1 and exponent > 0; results below 2^-1000 become 0.
[[gnu::always_inline]] inline double powerOfShare(double base, double exponent) {
  const bool positive = base > 0x1p-1000;
  const double y = exponent * binaryLogarithm(positive ? base : 1.0);
  const bool vanishes = y < -1000.0;
  const double power = powerOfTwo(vanishes ? 0.0 : y);
  return positive && !vanishes ? power : 0.0;
}

} // namespace sandglass
