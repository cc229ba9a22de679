#pragma once
// The exponential function for code that changes the state of a run: one algorithm for every vector width and
// processor, element-wise, of + - * and operations on the bits.

#include <bit>
#include <cstdint>

namespace sandglass {

/// e^x to about 2e-16 relative for -690 <= x <= 690; what is below or above is taken as that limit. Nearest
/// power of two into the exponent bits, Taylor series of the rest (|rest| < 0.35, so 14 terms do).
[[gnu::always_inline]] inline double exponential(double x) {
  x = x > -690.0 ? x : -690.0;
  x = x < 690.0 ? x : 690.0;
  constexpr double shift = 0x1.8p52; // its last bits count ones
  const double shifted = x * 1.4426950408889634074 + shift, whole = shifted - shift;
  // ln 2 in two parts: the first has few bits, so that its multiples are exact.
  const double f = (x - whole * 0x1.62e42fee00000p-1) - whole * 0x1.a39ef35793c76p-33;
  constexpr double inverse[] = {1.0,     1.0 / 2, 1.0 / 3,  1.0 / 4,  1.0 / 5,  1.0 / 6,  1.0 / 7,
                                1.0 / 8, 1.0 / 9, 1.0 / 10, 1.0 / 11, 1.0 / 12, 1.0 / 13, 1.0 / 14};
  double sum = 1.0;
  for (int k = 13; k >= 0; --k)
    sum = 1.0 + sum * (f * inverse[k]);
  return sum * std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
}

} // namespace sandglass
