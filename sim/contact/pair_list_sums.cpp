// The last part of building a pair list: what summing over a grain's contacts needs to know.

#include "sim/contact/contact_block.h"
#include "sim/contact/pair_list.h"

#include <algorithm>
#include <bit>

namespace sandglass {

/// Ordered by groups, and within a chunk as pairs are: those with earlier chunks, then those with later ones.
void PairList::findCrossings(Parallel& parallel) {
  const int chunkCount = chunks();
  groupCrossings_.assign(static_cast<std::size_t>(now_.groups()) + 1, 0);
  crossings_.clear();
  if (chunkCount == 1) return;
  const Pair* const pairs = now_.pairs.data();
  std::vector<std::uint32_t> touches(chunkCount); ///< which chunks the crossing rows of a chunk lead to
  parallel.forRange(chunkCount, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c)
      for (std::int64_t p = chunkCrossing_[c].begin; p < chunkCrossing_[c].end; ++p) {
        const std::int64_t j = std::max(pairs[p].a, pairs[p].b);
        std::int64_t d = c + 1;
        while (j >= chunkGrains_[d].end)
          ++d;
        touches[c] |= 1u << d;
      }
  });
  std::vector<std::vector<PairSide>> found(chunkCount);
  parallel.forRange(chunkCount, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) {
      const auto [begin, end] = chunkGrains_[c];
      const auto enter = [&](std::int64_t p, bool second) {
        const std::int32_t grain = second ? pairs[p].b : pairs[p].a;
        if (grain < begin || grain >= end) return;
        found[c].push_back({grain, static_cast<std::int32_t>(p << 1 | (second ? 1 : 0))});
        ++groupCrossings_[grain / group + 1];
      };
      for (std::int64_t d = 0; d < c; ++d)
        for (std::int64_t p = chunkCrossing_[d].begin; touches[d] >> c & 1u && p < chunkCrossing_[d].end; ++p)
          enter(p, pairs[p].b > pairs[p].a);
      for (std::int64_t p = chunkCrossing_[c].begin; p < chunkCrossing_[c].end; ++p)
        enter(p, pairs[p].b < pairs[p].a);
    }
  });
  for (std::size_t g = 1; g < groupCrossings_.size(); ++g)
    groupCrossings_[g] += groupCrossings_[g - 1];
  crossings_.resize(static_cast<std::size_t>(groupCrossings_.back()));
  parallel.forRange(chunkCount, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) {
      const std::int64_t from = chunkGrains_[c].begin / group, to = (chunkGrains_[c].end + group - 1) / group;
      std::vector<std::int32_t> next(groupCrossings_.begin() + from, groupCrossings_.begin() + to);
      for (const PairSide& crossing : found[c])
        crossings_[next[crossing.grain / group - from]++] = crossing;
    }
  });
}

/// From the group that is due to the last grain that pairs evaluated by then have named.
void PairList::findRing() {
  std::int64_t longest = 1; // in groups
  for (const auto& [begin, end] : chunkGrains_) {
    const std::int64_t first = begin / group, last = (end + group - 1) / group;
    std::int64_t met = first, furthest = first;
    for (std::int64_t g = first; g < last; ++g) {
      // A block may reach beyond the rows of its group, and hold several more.
      const std::int64_t evaluated = groupEnd_[g] + ContactBlock::capacity - 1;
      while (met < last && (met <= g || groupEnd_[met - 1] < evaluated))
        furthest = std::max<std::int64_t>(furthest, groupLast_[met++]);
      longest = std::max(longest, furthest - g + 1);
    }
  }
  sumRows_ = static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(longest * group)));
}

} // namespace sandglass
