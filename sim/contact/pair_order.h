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

  /// Finds a place for every pair, in the order of the rows. `inside` and `crossing` are the first free
  /// places of the two sections, and are moved on.
  const std::int64_t* place(const Rows& rows, const GrainColumns& columns, const GrainStore& grains,
                            const Quad* shifts, std::int64_t& inside, std::int64_t& crossing);

private:
  static constexpr int deepClasses = 28, gapClasses = 36, classes = deepClasses + gapClasses;
  std::vector<std::int64_t> places_;
  std::vector<std::uint8_t> class_; ///< of each pair; crossing ones: + classes
};

} // namespace sandglass
