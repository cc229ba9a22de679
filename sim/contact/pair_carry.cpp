#include "sim/contact/pair_carry.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace sandglass {

PairCarrier::PairCarrier(PairListing& past, PairListing& now, const std::vector<std::int32_t>& order,
                         const std::vector<std::int32_t>& wrapped, int historySize)
    : past_(past), now_(now), order_(order), wrapped_(wrapped),
      flat_(reinterpret_cast<const std::int32_t*>(past.pairs.data())), historySize_(historySize) {}

void PairCarrier::openRow(std::int64_t i) {
  grain_ = order_[i] < past_.grains ? order_[i] : -1;
  if (grain_ < 0) return;
  const std::int32_t* slots = past_.slots.data() + static_cast<std::int64_t>(grain_) * PairListing::slotCount;
  for (int k = 0; k < PairListing::slotCount; ++k)
    partners_[k] = flat_[slots[k] ^ 1];
}

void PairCarrier::carry(std::int32_t j, std::int64_t p) {
  constexpr std::int64_t lane = PairListing::lane;
  const std::int64_t old = grain_ < 0 ? -1 : find(order_[j], p);
  double* to = now_.history.data() + p / lane * lane * historySize_ + p % lane;
  if (old < 0) {
    for (int k = 0; k < historySize_; ++k)
      to[k * lane] = 0.0;
    if (!now_.live.empty()) now_.live[p] = 0;
    return;
  }
  const double* from = past_.history.data() + old / lane * lane * historySize_ + old % lane;
  for (int k = 0; k < historySize_; ++k)
    to[k * lane] = from[k * lane];
  if (!now_.live.empty()) now_.live[p] = past_.live[old];
}

bool PairCarrier::sameImage(std::int64_t old, std::int64_t p) const {
  if (now_.shiftOf.empty()) return true;
  // Box crossings of b against a do not change when grains are wrapped: s - n_b + n_a, with the image
  // counters n then and now.
  std::int32_t wanted = pack(now_.codes.image[now_.shiftOf[p]]);
  if (!wrapped_.empty()) {
    const PairListing::Pair pair = past_.pairs[old];
    wanted += wrapped_[pair.a] - wrapped_[pair.b];
  }
  return pack(past_.codes.image[past_.shiftOf[old]]) == wanted;
}

std::int64_t PairCarrier::find(std::int32_t partner, std::int64_t p) const {
  const std::int32_t* slots = past_.slots.data() + static_cast<std::int64_t>(grain_) * PairListing::slotCount;
  unsigned matches = 0;
  for (int k = 0; k < PairListing::slotCount; ++k)
    matches |= static_cast<unsigned>(partners_[k] == partner) << k;
  for (; matches != 0; matches &= matches - 1) {
    const std::int64_t old = slots[std::countr_zero(matches)] >> 1;
    if (sameImage(old, p)) return old;
  }
  const bool full = slots[PairListing::slotCount - 1] != past_.entries << 1;
  return full && partner < past_.grains ? findFurther(partner, p) : -1;
}

std::int64_t PairCarrier::findAmong(std::int32_t grain, std::int32_t partner, std::int64_t p) const {
  const auto group = grain / PairListing::group;
  auto extra = past_.extras.begin() + past_.groupExtras[group];
  const auto end = past_.extras.begin() + past_.groupExtras[group + 1];
  extra = std::lower_bound(extra, end, grain,
                           [](const PairListing::Extra& e, std::int32_t g) { return e.grain < g; });
  for (; extra != end && extra->grain == grain; ++extra)
    if (flat_[extra->entry ^ 1] == partner && sameImage(extra->entry >> 1, p)) return extra->entry >> 1;
  return -1;
}

/// The row's grain has more contacts than slots. A large grain can have thousands; its partner is more
/// likely to know the pair in a slot.
std::int64_t PairCarrier::findFurther(std::int32_t partner, std::int64_t p) const {
  const std::int32_t* slots =
      past_.slots.data() + static_cast<std::int64_t>(partner) * PairListing::slotCount;
  for (int k = 0; k < PairListing::slotCount; ++k)
    if (flat_[slots[k] ^ 1] == grain_ && sameImage(slots[k] >> 1, p)) return slots[k] >> 1;
  if (slots[PairListing::slotCount - 1] == past_.entries << 1) return -1;
  // Both overflow. The pair stands among the extras of both, so the shorter list will do; sizes are not known
  // beforehand, and the later grain in storage is the coarser one.
  return findAmong(std::min(grain_, partner), std::max(grain_, partner), p);
}

} // namespace sandglass
