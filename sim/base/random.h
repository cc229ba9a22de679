#pragma once
// Counter-based random numbers (Philox 4x32-10; Salmon et al., SC'11, through the Random123 library):
// a number depends on seed, purpose and item alone, so the order in which items are visited never matters.

#include "sim/base/vec.h"

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace sandglass {

/// What a stream of random numbers is for. Values are part of the file format of a run: never renumber.
enum class RandomPurpose : std::uint32_t {
  grainSize = 1,
  grainPosition = 2,
  grainVelocity = 3,
  grainSpin = 4,
  speciesChoice = 5,
  analysisSample = 6,
  test = 7,
  recyclePlace = 8,
};

/// An endless stream for one (seed, purpose, item).
class RandomStream {
public:
  RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint64_t item)
      : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}},
        counter_{{static_cast<std::uint32_t>(item), static_cast<std::uint32_t>(item >> 32),
                  static_cast<std::uint32_t>(purpose), 0}} {}

  /// Uniform in (0, 1), 52 random bits: never 0, never 1.
  double uniform() {
    const std::uint64_t bits = (static_cast<std::uint64_t>(next()) << 32) | next();
    return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Standard normal (Box-Muller).
  double normal() {
    constexpr double twoPi = 6.283185307179586476925286766559;
    const double r = std::sqrt(-2.0 * std::log(uniform()));
    return r * std::cos(twoPi * uniform());
  }

  /// Uniform on the unit sphere.
  Vec3 direction() {
    constexpr double twoPi = 6.283185307179586476925286766559;
    const double z = uniform(-1.0, 1.0), phi = uniform(0.0, twoPi), s = std::sqrt(1.0 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

private:
  std::uint32_t next() {
    if (used_ == 4) {
      block_ = r123::Philox4x32()(counter_, key_);
      ++counter_.v[3];
      used_ = 0;
    }
    return block_.v[used_++];
  }

  r123::Philox4x32::key_type key_;
  r123::Philox4x32::ctr_type counter_;
  r123::Philox4x32::ctr_type block_{};
  int used_ = 4;
};

} // namespace sandglass
