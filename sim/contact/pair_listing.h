#pragma once
// The arrays of a pair list, kept together so that one listing can be carried over into the next.

#include "sim/base/aligned.h"
#include "sim/contact/image_codes.h"
#include "sim/contact/pair_kernel.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

/// Room for n values that will all be written: old values are not copied into larger memory.
template <class Vector> void makeRoom(Vector& values, std::int64_t n, std::int64_t spare = 0) {
  if (values.capacity() < static_cast<std::size_t>(n + spare)) {
    Vector().swap(values);
    values.reserve(static_cast<std::size_t>(n + n / 16 + spare));
  }
  values.resize(static_cast<std::size_t>(n));
}

struct PairListing {
  static constexpr int lane = ParticleView::lane, group = 32, slotCount = 8;
  struct Pair {
    std::int32_t a = 0, b = 0;
  };
  struct Extra {
    std::int32_t grain, entry;
  };

  std::int64_t grains = 0;  ///< of this listing; the phantoms are grains `grains` and `grains` + 1
  std::int64_t entries = 0; ///< pairs with padding
  AlignedVector<Pair> pairs;
  ImageCodes codes;
  AlignedVector<std::uint8_t> shiftOf; ///< image code of a pair; empty without periodic directions
  AlignedVector<std::int32_t> slots;   ///< slotCount per grain
  std::vector<Extra> extras;
  std::vector<std::int32_t> groupExtras; ///< first of extras of each group of grains; one more at the end
  AlignedVector<double> history;
  std::vector<std::uint8_t> live;

  std::int64_t groups() const { return (grains + group - 1) / group; }
  std::size_t bytes() const {
    return pairs.capacity() * sizeof(Pair) + shiftOf.capacity() + slots.capacity() * sizeof(std::int32_t) +
           extras.capacity() * sizeof(Extra) + groupExtras.capacity() * sizeof(std::int32_t) +
           history.capacity() * sizeof(double) + live.capacity();
  }
};

} // namespace sandglass
