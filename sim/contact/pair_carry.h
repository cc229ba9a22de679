#pragma once
// Carries histories from one listing to the next. Most pairs near each other do not touch, and have nothing
// to carry: so old pairs are gone through, and those that have something look for themselves in the new row
// of the one of their grains that comes first now.

#include "sim/contact/pair_listing.h"
#include "sim/contact/pair_search.h"

#include <cstdint>
#include <vector>

namespace sandglass {

/// Where the rows of all grains are found.
struct RowTable {
  std::vector<const FoundRows*> ofGroup;   ///< of the grains of a group
  std::vector<std::int32_t> first, length; ///< of each grain
};

class PairCarrier {
public:
  /// `newOf` gives the new storage index of each old grain, or -1, and `wrapped` by how many boxes (packed,
  /// by old index) its image counters have grown since then (empty without periodic directions). Histories
  /// are floats if they are `single`.
  PairCarrier(const PairKeys& past, PairKeys& now, const RowTable& rows,
              const std::vector<std::int32_t>& newOf, const std::vector<std::int32_t>& wrapped);

  /// Old pairs first .. last - 1, multiples of the lane: hands on histories and live flags. All new ones are
  /// zeros.
  void carry(std::int64_t first, std::int64_t last, const Quad* pastHistory, Quad* history, int historySize,
             bool single) const;

private:
  template <int fixedSize, class Real>
  void carryAs(std::int64_t first, std::int64_t last, const Real* past, Real* now, int historySize) const;
  std::int64_t find(std::int64_t old) const;
  int codeNow(PairKeys::Pair old, int code) const;

  const PairKeys& past_;
  PairKeys& now_;
  const RowTable& rows_;
  const std::vector<std::int32_t>&newOf_, &wrapped_;
  const bool imaged_, sameCodes_; ///< image codes mean what they meant
};

} // namespace sandglass
