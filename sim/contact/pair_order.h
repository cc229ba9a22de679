#pragma once
// Where the pairs of a group of grains stand: those that touch when they are listed first, then those a
// little apart, and so on, so that whole registers of pairs can be passed over as long as none of them
// touches. In a flowing bed more than half of all listed pairs do not.

#include "sim/contact/pair_search.h"
#include "sim/grains/grain_store.h"

#include <cstdint>
#include <vector>

namespace sandglass {

class PairOrder {
public:
  struct Rows { ///< of the grains first .. last - 1, as PairSearch found them
    std::int64_t first, last;
    const std::int32_t *length, *partner;
    const std::uint8_t* code;  ///< null without periodic directions
    std::int64_t crossingFrom; ///< partners from here on go to the section of crossing pairs
  };

  /// Finds `places` for all pairs, in the order of the rows. `inside` and `crossing` are the first free
  /// places of the two sections, and are moved on. `partner` must be readable `readAhead` places further.
  void place(const Rows& rows, const GrainColumns& columns, const GrainStore& grains, const Quad* shifts,
             std::int64_t& inside, std::int64_t& crossing, std::int32_t* places);

  static constexpr int readAhead = 4;

private:
  static constexpr int deepClasses = 28, gapClasses = 36, classes = deepClasses + gapClasses;
  std::int64_t measure(const Rows& rows, const GrainColumns& columns, const GrainStore& grains,
                       const Quad* shifts);
  void classify(const Rows& rows, std::int64_t count);

  std::vector<std::int32_t> owner_;       ///< of each pair: the grain of its row
  AlignedVector<Quad> squares_;           ///< of the components of its distance
  AlignedVector<double> touching_, most_; ///< distances at which it touches and is listed [m]
  AlignedVector<std::int32_t> class_;     ///< of each pair; crossing ones: + classes
};

} // namespace sandglass
