#include "sim/contact/fused/fused_laws.h"

#include <array>
#include <bit>

namespace sandglass {

void FusedTables::put(int place, const FusedLaws& laws) {
  const auto fill = [place](auto& rows, const auto& constants) {
    constexpr int count = sizeof(constants) / sizeof(double);
    const auto numbers = std::bit_cast<std::array<double, count>>(constants);
    for (int k = 0; k < count; ++k)
      rows[k][place] = numbers[k];
  };
  fill(linear, laws.linear);
  fill(hertz, laws.hertz);
  fill(spring, laws.spring);
  fill(couple, laws.couple);
}

} // namespace sandglass
