#include "sim/contact/pair_carry.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>

namespace sandglass {

namespace {

constexpr std::int64_t lane = PairListing::lane, none = -1;

/// Which of the pairs side by side have a number that is not zero.
template <class Real> unsigned withHistory(const Real* numbers, int historySize) {
  constexpr int bytes = 32, atOnce = bytes / sizeof(Real);
  unsigned all = 0;
  for (int c = 0; c < lane; c += atOnce) {
    __m256i any = _mm256_setzero_si256();
    for (int k = 0; k < historySize; ++k)
      any = _mm256_or_si256(any, _mm256_load_si256(reinterpret_cast<const __m256i*>(numbers + k * lane + c)));
    unsigned zeros = 0;
    if constexpr (atOnce == 4)
      zeros = _mm256_movemask_pd(_mm256_castsi256_pd(_mm256_cmpeq_epi64(any, _mm256_setzero_si256())));
    else
      zeros = _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(any, _mm256_setzero_si256())));
    all |= (zeros ^ ((1u << atOnce) - 1)) << c;
  }
  return all;
}

} // namespace

PairCarrier::PairCarrier(const PairKeys& past, PairKeys& now, const RowTable& rows,
                         const std::vector<std::int32_t>& newOf, const std::vector<std::int32_t>& wrapped)
    : past_(past), now_(now), rows_(rows), newOf_(newOf), wrapped_(wrapped), imaged_(!now.shiftOf.empty()),
      sameCodes_(past.codes.reach == now.codes.reach) {}

void PairCarrier::carry(std::int64_t first, std::int64_t last, const Quad* pastHistory, Quad* history,
                        int historySize, bool single) const {
  if (single)
    return carryAs<-1>(first, last, reinterpret_cast<const float*>(pastHistory),
                       reinterpret_cast<float*>(history), historySize);
  const auto* const past = reinterpret_cast<const double*>(pastHistory);
  auto* const now = reinterpret_cast<double*>(history);
  if (historySize == 3)
    carryAs<3>(first, last, past, now, historySize);
  else if (historySize == 6)
    carryAs<6>(first, last, past, now, historySize);
  else
    carryAs<-1>(first, last, past, now, historySize);
}

template <int fixedSize, class Real>
void PairCarrier::carryAs(std::int64_t first, std::int64_t last, const Real* past, Real* now,
                          int historySize) const {
  const int size = fixedSize < 0 ? historySize : fixedSize;
  const std::uint8_t* const pastLive = past_.live.empty() ? nullptr : past_.live.data();
  for (std::int64_t p = first; p < last; p += lane) {
    const Real* const from = past + p * size;
    unsigned some = withHistory(from, size);
    for (int c = 0; pastLive && c < lane; ++c)
      some |= pastLive[p + c] != 0 ? 1u << c : 0u;
    for (; some != 0; some &= some - 1) {
      const int c = std::countr_zero(some);
      const std::int64_t at = find(p + c);
      if (at == none) continue;
      Real* const to = now + at / lane * lane * size + at % lane;
      for (int k = 0; k < size; ++k)
        to[k * lane] = from[k * lane + c];
      if (pastLive) now_.live[at] = pastLive[p + c];
    }
  }
}

/// The new pair, or none.
std::int64_t PairCarrier::find(std::int64_t old) const {
  constexpr std::int32_t atOnce = CellSearch::writeAhead;
  static_assert(atOnce == 8);
  const PairKeys::Pair was = past_.pairs[old];
  if (was.a >= past_.grains) return none; // padding
  const std::int32_t a = newOf_[was.a], b = newOf_[was.b];
  if ((a | b) < 0) return none;
  const std::int32_t row = std::min(a, b), other = std::max(a, b);
  const FoundRows& rows = *rows_.ofGroup[row / PairListing::group];
  const std::int32_t* const partner = rows.partner.data() + rows_.first[row];
  const std::int32_t length = rows_.length[row];
  std::int32_t k = 0;
  if (length > atOnce) {
    k = static_cast<std::int32_t>(std::lower_bound(partner, partner + length, other) - partner);
  } else {
    const __m256i equal = _mm256_cmpeq_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(partner)),
                                             _mm256_set1_epi32(other));
    k = std::countr_zero(static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(equal))) |
                         1u << atOnce);
  }
  if (k >= length || partner[k] != other) return none;
  if (imaged_) {
    int code = codeNow(was, past_.shiftOf[old]);
    if (a > b) code = now_.codes.mirrored(code); // as the row sees it
    const std::uint8_t* const codes = rows.code.data() + rows_.first[row];
    while (codes[k] != code)
      if (++k == length || partner[k] != other) return none;
  }
  return rows.place[rows_.first[row] + k];
}

/// Box crossings of b against a do not change when grains are wrapped: s - n_b + n_a, with the image counters
/// n then and now. -1 if no pair is listed in such an image.
int PairCarrier::codeNow(PairKeys::Pair old, int code) const {
  const std::int32_t more = wrapped_[old.b] - wrapped_[old.a];
  if (more == 0 && sameCodes_) return code;
  const std::int32_t seen = ImageCodes::pack(past_.codes.image[code]) + more;
  const auto& images = now_.codes.image;
  const auto at = std::find_if(images.begin(), images.end(),
                               [&](const auto& image) { return ImageCodes::pack(image) == seen; });
  return at == images.end() ? -1 : static_cast<int>(at - images.begin());
}

} // namespace sandglass
