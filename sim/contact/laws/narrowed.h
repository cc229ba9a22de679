#pragma once
// Constants of a law, a struct of doubles and no more, in another precision.

#include <array>
#include <bit>

namespace sandglass {

template <class Wanted, class Real, class Given> Wanted narrowed(const Given& given) {
  constexpr int fields = sizeof(Given) / sizeof(double);
  const auto numbers = std::bit_cast<std::array<double, fields>>(given);
  std::array<Real, fields> out;
  for (int k = 0; k < fields; ++k)
    out[k] = static_cast<Real>(numbers[k]);
  return std::bit_cast<Wanted>(out);
}

} // namespace sandglass
