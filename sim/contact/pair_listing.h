#pragma once
// The arrays of a pair list, kept together so that one listing can be carried over into the next.

#include "sim/base/aligned.h"
#include "sim/contact/image_codes.h"
#include "sim/contact/pair_kernel.h"

#include <cstdint>
#include <vector>

namespace sandglass {

/// What a pair is known by from one listing to the next.
struct PairKeys {
  struct Pair {
    std::int32_t a = 0, b = 0;
  };

  std::int64_t grains = 0;  ///< of this listing; the phantoms are grains `grains` and `grains` + 1
  std::int64_t entries = 0; ///< pairs with padding
  AlignedVector<Pair> pairs;
  ImageCodes codes;
  AlignedVector<std::uint8_t> shiftOf; ///< image code of a pair; empty without periodic directions
  std::vector<std::uint8_t> live;

  std::size_t bytes() const { return pairs.capacity() * sizeof(Pair) + shiftOf.capacity() + live.capacity(); }
};

struct PairListing : PairKeys {
  static constexpr int lane = ParticleView::lane, group = 32;

  AlignedVector<Quad> history; ///< doubles or floats

  std::int64_t groups() const { return (grains + group - 1) / group; }
  std::size_t bytes() const { return PairKeys::bytes() + history.capacity() * sizeof(Quad); }
};

} // namespace sandglass
