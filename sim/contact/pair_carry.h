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
  /// Makes a listing the old one: what empty slots point at gets a pair and the like.
  static void retire(PairListing& listing);

  /// `order` gives the old storage index of each grain, and `wrapped` by how many boxes (packed, by old
  /// index) its image counters have grown since then (empty without periodic directions).
  /// `pastHistory` is the old array of histories with `lane` histories of zeros behind it; both arrays are of
  /// floats if they are `single`.
  PairCarrier(const PairListing& past, const double* pastHistory, PairListing& now,
              const std::vector<std::int32_t>& order, const std::vector<std::int32_t>& wrapped,
              int historySize, bool single);

  /// The row of grain i, `count` partners whose pairs stand at `places`: copies histories and live flags, or
  /// sets them to zero. The pairs are written already.
  void carry(std::int64_t i, const std::int32_t* partners, std::int64_t count, const std::int64_t* places);

private:
  struct Row; ///< a grain whose old contacts are at hand
  template <int fixedSize, class Real>
  void carryRow(const Row& row, const std::int32_t* partners, std::int64_t count, const std::int64_t* places);
  void startAnew(std::int64_t p);
  bool sameImage(std::int64_t old, std::int64_t p) const;
  std::int64_t find(const Row& row, unsigned matches, std::int32_t partner, std::int64_t p) const;
  std::int64_t findAmong(std::int32_t grain, std::int32_t partner, std::int64_t p) const;
  std::int64_t findFurther(std::int32_t grain, std::int32_t partner, std::int64_t p) const;

  const std::int32_t* slotsOf(std::int32_t oldGrain) const {
    return past_.slots.data() + static_cast<std::int64_t>(oldGrain) * PairListing::slotCount;
  }

  const PairListing& past_;
  const double* pastHistory_;
  PairListing& now_;
  const std::vector<std::int32_t>&order_, &wrapped_;
  const std::int32_t* flat_; ///< old pairs as numbers: entry ^ 1 is where the other grain of an entry stands
  const std::int32_t empty_; ///< what stands in an empty old slot
  const int historySize_;
  const bool single_;
  const bool imaged_, sameCodes_; ///< image codes mean what they meant
};

} // namespace sandglass
