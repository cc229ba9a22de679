// The second half of building a pair list: from pairs to what each grain finds its contacts by, slots and
// places in the ring.

#include "sim/contact/pair_list.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>

namespace sandglass {

namespace {

bool byGrain(const PairListing::Extra& s, const PairListing::Extra& t) {
  return s.grain < t.grain;
}

/// Parts, ordered by grain, one behind the other, and where each group of grains begins.
void gather(const std::vector<std::vector<PairListing::Extra>>& parts, std::int64_t groups,
            std::vector<PairListing::Extra>& all, std::vector<std::int32_t>& groupFirst) {
  all.clear();
  for (const auto& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  groupFirst.assign(static_cast<std::size_t>(groups) + 1, 0);
  for (const PairListing::Extra& e : all)
    ++groupFirst[e.grain / PairListing::group + 1];
  for (std::size_t g = 1; g < groupFirst.size(); ++g)
    groupFirst[g] += groupFirst[g - 1];
}

/// ringEntry() of eight places, of pairs whose first grain an even entry means.
__m256i ringEntries(__m256i places, __m256i entries) {
  const __m256i first = _mm256_andnot_si256(entries, _mm256_set1_epi32(1));
  return _mm256_or_si256(_mm256_slli_epi32(places, 4), _mm256_slli_epi32(first, 3));
}

} // namespace

/// Slots in the order of pairs: what a chunk's grains share with earlier chunks, rows of the chunk, and their
/// pairs with later chunks.
void PairList::link(Parallel& parallel) {
  const std::int64_t n = now_.grains;
  const auto empty = static_cast<std::int32_t>(now_.entries << 1);
  makeRoom(now_.slots, n * slotCount);
  filled_.resize(static_cast<std::size_t>(n));
  const int chunkCount = chunks();
  std::vector<std::vector<Extra>> extras(chunkCount);
  std::vector<std::uint32_t> touches(chunkCount); ///< which chunks the crossing rows of a chunk lead to
  if (chunkCount > 1)
    parallel.forRange(chunkCount, 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t c = first; c < last; ++c)
        for (std::int64_t p = chunkCrossing_[c].begin; p < chunkCrossing_[c].end; ++p) {
          const std::int64_t j = std::max(now_.pairs[p].a, now_.pairs[p].b);
          std::int64_t d = c + 1;
          while (j >= chunkGrains_[d].end)
            ++d;
          touches[c] |= 1u << d;
        }
    });
  parallel.forRange(chunkCount, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) {
      const auto [begin, end] = chunkGrains_[c];
      std::fill(now_.slots.begin() + begin * slotCount, now_.slots.begin() + end * slotCount, empty);
      std::fill(filled_.begin() + begin, filled_.begin() + end, std::uint8_t{0});
      const auto enter = [&, slots = now_.slots.data(), filled = filled_.data()](std::int32_t grain,
                                                                                 std::int64_t entry) {
        if (filled[grain] < slotCount)
          slots[static_cast<std::int64_t>(grain) * slotCount + filled[grain]++] =
              static_cast<std::int32_t>(entry);
        else
          extras[c].push_back({grain, static_cast<std::int32_t>(entry)});
      };
      const Pair* pairs = now_.pairs.data();
      for (std::int64_t d = 0; d < c; ++d) {
        if (!(touches[d] >> c & 1u)) continue;
        for (std::int64_t p = chunkCrossing_[d].begin; p < chunkCrossing_[d].end; ++p) {
          const bool second = pairs[p].b > pairs[p].a;
          const std::int32_t j = second ? pairs[p].b : pairs[p].a;
          if (j >= begin && j < end) enter(j, p << 1 | (second ? 1 : 0));
        }
      }
      for (std::int64_t p = chunkPairs_[c].begin; p < chunkPairs_[c].end && pairs[p].a < n; ++p) {
        enter(pairs[p].a, p << 1);
        enter(pairs[p].b, p << 1 | 1);
      }
      for (std::int64_t p = chunkCrossing_[c].begin; p < chunkCrossing_[c].end; ++p) {
        const bool second = pairs[p].b < pairs[p].a;
        enter(second ? pairs[p].b : pairs[p].a, p << 1 | (second ? 1 : 0));
      }
      std::stable_sort(extras[c].begin(), extras[c].end(), byGrain);
    }
  });
  gather(extras, now_.groups(), now_.extras, now_.groupExtras);
}

/// Length of the ring, and where in it the outputs of each grain stand.
void PairList::findPlaces(Parallel& parallel) {
  const int chunkCount = chunks();
  const std::int64_t n = now_.grains;
  std::int64_t longest = 0; // from the first pair of a group to where the last grain that it names is summed
  for (int c = 0; c < chunkCount; ++c) {
    std::int64_t begin = chunkPairs_[c].begin;
    for (std::int64_t g = chunkGrains_[c].begin / group; g < (chunkGrains_[c].end + group - 1) / group; ++g) {
      longest = std::max(longest, groupEnd_[groupLast_[g]] - begin);
      begin = groupEnd_[g];
    }
  }
  constexpr std::int64_t block = 64; // may be written as a whole before its first pair is needed
  window_ = static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(longest + block)));
  const std::int32_t empty = ringEntry(window_, true);
  makeRoom(places_, n * slotCount);
  std::vector<std::vector<Extra>> lent(chunkCount);
  parallel.forRange(chunkCount, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) {
      const auto [begin, end] = chunkGrains_[c];
      const __m256i begins = _mm256_set1_epi32(static_cast<std::int32_t>(chunkPairs_[c].begin)),
                    masks = _mm256_set1_epi32(static_cast<std::int32_t>(window_ - 1)),
                    none = _mm256_set1_epi32(static_cast<std::int32_t>(now_.entries << 1));
      std::int64_t atLent = 0;
      for (std::int64_t i = begin; i < end; ++i) {
        const std::int32_t* slots = now_.slots.data() + i * slotCount;
        std::int32_t* places = places_.data() + i * slotCount;
        if (i % group == 0) atLent = window_ + 1;
        const __m256i entries = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(slots));
        const __m256i pairsOf = _mm256_srai_epi32(entries, 1);
        _mm256_storeu_si256(
            reinterpret_cast<__m256i*>(places),
            _mm256_blendv_epi8(
                ringEntries(_mm256_and_si256(_mm256_sub_epi32(pairsOf, begins), masks), entries),
                _mm256_set1_epi32(empty), _mm256_cmpeq_epi32(entries, none)));
        const __m256i crossing = _mm256_cmpgt_epi32(begins, pairsOf);
        for (auto lanes = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(crossing)));
             lanes != 0; lanes &= lanes - 1) {
          const int k = std::countr_zero(lanes);
          places[k] = ringEntry(atLent++, !(slots[k] & 1));
          lent[c].push_back({static_cast<std::int32_t>(i), slots[k] >> 1});
        }
      }
    }
  });
  gather(lent, now_.groups(), lent_, groupLent_);
}

} // namespace sandglass
