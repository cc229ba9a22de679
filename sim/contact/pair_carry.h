#pragma once
// Carries histories from one listing to the next. No keys are stored: the old pair is looked up through the
// old slots of one of its grains, by the old storage index of the other and by the image.

#include "sim/contact/pair_listing.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

class PairCarrier {
public:
  /// Shifts of a grain by whole boxes as one number: sums and differences of shifts are those of the numbers
  /// (components below 512).
  static std::int32_t pack(const std::array<int, 3>& shift) {
    return (shift[0] * 1024 + shift[1]) * 1024 + shift[2];
  }

  /// `order` gives the old storage index of each grain, and `wrapped` by how many boxes (packed, by old
  /// index) its image counters have grown since then; empty when no grain was wrapped.
  PairCarrier(PairListing& past, PairListing& now, const std::vector<std::int32_t>& order,
              const std::vector<std::int32_t>& wrapped, int historySize);

  /// The row of grain i follows.
  void openRow(std::int64_t i);
  /// Pair p of that row, with partner j: copies history and live flag, or sets them to zero.
  void carry(std::int32_t j, std::int64_t p);

private:
  bool sameImage(std::int64_t old, std::int64_t p) const;
  std::int64_t find(std::int32_t partner, std::int64_t p) const;
  std::int64_t findAmong(std::int32_t grain, std::int32_t partner, std::int64_t p) const;
  std::int64_t findFurther(std::int32_t partner, std::int64_t p) const;

  const PairListing& past_;
  PairListing& now_;
  const std::vector<std::int32_t>&order_, &wrapped_;
  const std::int32_t* flat_; ///< old pairs as numbers: entry ^ 1 is where the other grain of an entry stands
  const int historySize_;
  std::int32_t grain_ = -1; ///< old storage index of the row's grain; negative: it is new
  alignas(32) std::array<std::int32_t, PairListing::slotCount> partners_{};
};

} // namespace sandglass
