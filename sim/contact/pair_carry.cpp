#include "sim/contact/pair_carry.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>

namespace sandglass {

struct PairCarrier::Row {
  std::int32_t grain, wrapped; ///< by old storage index
  bool full;                   ///< there may be more contacts than slots
  __m256i partners;            ///< old storage indices of the grains in the slots
  alignas(32) std::array<std::int32_t, PairListing::slotCount + 1> entries; ///< the slots, and an empty one
};

void PairCarrier::retire(PairListing& listing) {
  listing.pairs.push_back({-1, -1});
  if (!listing.shiftOf.empty()) listing.shiftOf.push_back(0);
  if (!listing.live.empty()) listing.live.push_back(0);
}

PairCarrier::PairCarrier(const PairListing& past, const double* pastHistory, PairListing& now,
                         const std::vector<std::int32_t>& order, const std::vector<std::int32_t>& wrapped,
                         int historySize, bool single)
    : past_(past), pastHistory_(pastHistory), now_(now), order_(order), wrapped_(wrapped),
      flat_(reinterpret_cast<const std::int32_t*>(past.pairs.data())),
      empty_(static_cast<std::int32_t>(past.entries << 1)), historySize_(historySize), single_(single),
      imaged_(!now.shiftOf.empty()), sameCodes_(past.codes.reach == now.codes.reach) {}

void PairCarrier::carry(std::int64_t i, const std::int32_t* partners, std::int64_t count,
                        const std::int64_t* places) {
  static_assert(PairListing::slotCount == 8);
  const std::int32_t grain = order_[i];
  if (grain >= past_.grains) { // it is new
    for (std::int64_t k = 0; k < count; ++k)
      startAnew(places[k]);
    return;
  }
  const __m256i entries = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(slotsOf(grain)));
  Row row;
  row.grain = grain;
  row.wrapped = imaged_ ? wrapped_[grain] : 0;
  row.partners = _mm256_i32gather_epi32(flat_, _mm256_xor_si256(entries, _mm256_set1_epi32(1)), 4);
  _mm256_store_si256(reinterpret_cast<__m256i*>(row.entries.data()), entries);
  row.entries.back() = empty_;
  row.full = row.entries[PairListing::slotCount - 1] != empty_;
  if (single_)
    carryRow<-1, float>(row, partners, count, places);
  else if (historySize_ == 3)
    carryRow<3, double>(row, partners, count, places);
  else if (historySize_ == 6)
    carryRow<6, double>(row, partners, count, places);
  else
    carryRow<-1, double>(row, partners, count, places);
}

template <int fixedSize, class Real>
void PairCarrier::carryRow(const Row& row, const std::int32_t* partners, std::int64_t count,
                           const std::int64_t* places) {
  constexpr std::uint64_t lane = PairListing::lane;
  const std::uint64_t size = fixedSize < 0 ? historySize_ : fixedSize;
  auto* const now = reinterpret_cast<Real*>(now_.history.data());
  const auto* const past = reinterpret_cast<const Real*>(pastHistory_);
  const std::int32_t *const order = order_.data(), *const wrapped = wrapped_.data();
  std::uint8_t* const live = now_.live.empty() ? nullptr : now_.live.data();
  const std::uint8_t* const shiftOf = imaged_ ? now_.shiftOf.data() : nullptr;
  const std::uint8_t* const pastShiftOf = past_.shiftOf.data();
  const bool otherCodes = !sameCodes_;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t p = places[k];
    // Which pairs are new cannot be foretold, so there is no branch on it: they find the empty entry, and the
    // zeros behind the last old history.
    const std::int32_t partner = order[partners[k]];
    const __m256i equal = _mm256_cmpeq_epi32(row.partners, _mm256_set1_epi32(partner));
    const unsigned matches = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)));
    std::int64_t old = row.entries[std::countr_zero(matches | 1u << PairListing::slotCount)] >> 1;
    bool unsure = (matches == 0) & row.full;
    if (shiftOf)
      unsure |= (matches != 0) &
                (otherCodes | (pastShiftOf[old] != shiftOf[p]) | (wrapped[partner] != row.wrapped));
    if (unsure) old = find(row, matches, partner, p);
    const auto at = static_cast<std::uint64_t>(p), was = static_cast<std::uint64_t>(old);
    Real* to = now + at / lane * lane * size + at % lane;
    const Real* from = past + was / lane * lane * size + was % lane;
    for (std::uint64_t q = 0; q < size; ++q)
      to[q * lane] = from[q * lane];
    if (live) live[p] = past_.live[old];
  }
}

void PairCarrier::startAnew(std::int64_t p) {
  constexpr std::int64_t lane = PairListing::lane;
  const auto clear = [&](auto* all) {
    auto* to = all + p / lane * lane * historySize_ + p % lane;
    for (int q = 0; q < historySize_; ++q)
      to[q * lane] = 0;
  };
  single_ ? clear(reinterpret_cast<float*>(now_.history.data())) : clear(now_.history.data());
  if (!now_.live.empty()) now_.live[p] = 0;
}

std::int64_t PairCarrier::find(const Row& row, unsigned matches, std::int32_t partner, std::int64_t p) const {
  for (; matches != 0; matches &= matches - 1) {
    const std::int64_t old = row.entries[std::countr_zero(matches)] >> 1;
    if (sameImage(old, p)) return old;
  }
  return row.full && partner < past_.grains ? findFurther(row.grain, partner, p) : past_.entries;
}

/// Box crossings of b against a do not change when grains are wrapped: s - n_b + n_a, with the image counters
/// n then and now.
bool PairCarrier::sameImage(std::int64_t old, std::int64_t p) const {
  if (!imaged_) return true;
  const PairListing::Pair pair = past_.pairs[old];
  return ImageCodes::pack(past_.codes.image[past_.shiftOf[old]]) ==
         ImageCodes::pack(now_.codes.image[now_.shiftOf[p]]) + wrapped_[pair.a] - wrapped_[pair.b];
}

std::int64_t PairCarrier::findAmong(std::int32_t grain, std::int32_t partner, std::int64_t p) const {
  const auto group = grain / PairListing::group;
  auto extra = past_.extras.begin() + past_.groupExtras[group];
  const auto end = past_.extras.begin() + past_.groupExtras[group + 1];
  extra = std::lower_bound(extra, end, grain,
                           [](const PairListing::Extra& e, std::int32_t g) { return e.grain < g; });
  for (; extra != end && extra->grain == grain; ++extra)
    if (flat_[extra->entry ^ 1] == partner && sameImage(extra->entry >> 1, p)) return extra->entry >> 1;
  return past_.entries;
}

/// The row's grain has more contacts than slots. A large grain can have thousands; its partner is more
/// likely to know the pair in a slot.
std::int64_t PairCarrier::findFurther(std::int32_t grain, std::int32_t partner, std::int64_t p) const {
  const std::int32_t* slots = slotsOf(partner);
  for (int k = 0; k < PairListing::slotCount; ++k)
    if (flat_[slots[k] ^ 1] == grain && sameImage(slots[k] >> 1, p)) return slots[k] >> 1;
  if (slots[PairListing::slotCount - 1] == empty_) return past_.entries;
  // Both overflow, so the pair stands among the extras of both. Later in storage are the coarser grains, with
  // more of them.
  return findAmong(std::min(grain, partner), std::max(grain, partner), p);
}

} // namespace sandglass
