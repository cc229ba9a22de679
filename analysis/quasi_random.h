#pragma once
// Evenly spread points for integrals over regions and shells: the additive (Kronecker) sequence whose steps
// are powers of the inverse of the root of x^4 = x + 1 (three dimensions), shifted at random (Cranley &
// Patterson 1976), so that independent shifts give an error estimate. Fixed-point arithmetic: point n is
// exact for every n, in any order.

#include "sim/base/random.h"

#include <array>
#include <cstdint>

namespace sandglass::analysis {

class QuasiRandom3 {
public:
  QuasiRandom3(std::uint64_t seed, std::uint64_t item) {
    RandomStream random(seed, RandomPurpose::analysisSample, item);
    for (auto& s : shift_)
      s = static_cast<std::uint64_t>(random.uniform() * 0x1p52) << 12;
  }

  /// Point n, each coordinate in (0, 1).
  std::array<double, 3> operator()(std::uint64_t n) const {
    std::array<double, 3> u;
    for (int k = 0; k < 3; ++k)
      u[k] = (static_cast<double>((shift_[k] + n * step_[k]) >> 12) + 0.5) * 0x1p-52;
    return u;
  }

private:
  // 2^64 / g, 2^64 / g^2, 2^64 / g^3 with g = 1.2207440846057596
  static constexpr std::array<std::uint64_t, 3> step_{15111065706836454659u, 12378569675163806722u,
                                                      10140184033053478359u};
  std::array<std::uint64_t, 3> shift_{};
};

} // namespace sandglass::analysis
