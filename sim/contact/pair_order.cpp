#include "sim/contact/pair_order.h"

#include <immintrin.h>

#include <array>

namespace sandglass {

/// Squares of pairs, one behind the other; returns how many pairs there are.
std::int64_t PairOrder::measure(const Rows& rows, const GrainColumns& columns, const GrainStore& grains,
                                const Quad* shifts) {
  const std::int64_t total = spreadRows(rows.length, rows.first, rows.last - rows.first, owner_);
  const auto room = static_cast<std::size_t>(total + readAhead);
  if (class_.size() < room) {
    squares_.resize(room);
    touching_.resize(room);
    most_.resize(room);
    class_.resize(room);
  }
  const Quad* const listed = grains.listed.data(); // denser than records
  const double *const radii = columns.radius, *const reaches = columns.reach;
  const std::int32_t *const owner = owner_.data(), *const partner = rows.partner;
  Quad* const square = squares_.data();
  double *const touching = touching_.data(), *const most = most_.data();
  const std::uint8_t* const code = rows.code;
  for (std::int64_t k = 0; k < total; ++k) {
    const std::int32_t i = owner[k], j = partner[k];
    __m256d apart = _mm256_sub_pd(_mm256_load_pd(&listed[j].x), _mm256_load_pd(&listed[i].x));
    if (code) apart = _mm256_add_pd(apart, _mm256_load_pd(&shifts[code[k]].x));
    _mm256_store_pd(&square[k].x, _mm256_mul_pd(apart, apart));
    touching[k] = radii[i] + radii[j];
    most[k] = reaches[i] + reaches[j];
  }
  return total;
}

/// The class of each pair, four at a time: a class is a fourth of a power of two by which the gap or the
/// overlap is below the largest gap. Differences of squares stand for both, since they are small beside the
/// radii.
void PairOrder::classify(const Rows& rows, std::int64_t count) {
  constexpr int bitsOfStep = 21; // a float has 23 behind its exponent
  const auto bits = [](__m256d numbers) { return _mm_castps_si128(_mm256_cvtpd_ps(numbers)); };
  const __m128i beforeCrossing = _mm_set1_epi32(static_cast<std::int32_t>(rows.crossingFrom - 1));
  for (std::int64_t k = 0; k < count; k += 4) {
    const double* square = &squares_[k].x;
    const __m256d a = _mm256_load_pd(square), b = _mm256_load_pd(square + 4), c = _mm256_load_pd(square + 8),
                  d = _mm256_load_pd(square + 12);
    const __m256d xzLow = _mm256_unpacklo_pd(a, b), yLow = _mm256_unpackhi_pd(a, b),
                  xzHigh = _mm256_unpacklo_pd(c, d), yHigh = _mm256_unpackhi_pd(c, d);
    const __m256d x = _mm256_permute2f128_pd(xzLow, xzHigh, 0x20),
                  z = _mm256_permute2f128_pd(xzLow, xzHigh, 0x31),
                  y = _mm256_permute2f128_pd(yLow, yHigh, 0x20);
    const __m256d radii = _mm256_load_pd(&touching_[k]), most = _mm256_load_pd(&most_[k]);
    const __m256d touching = _mm256_mul_pd(radii, radii);
    const __m256d apart = _mm256_sub_pd(_mm256_add_pd(_mm256_add_pd(x, y), z), touching);
    const __m256d widest = _mm256_sub_pd(_mm256_mul_pd(most, most), touching);
    const __m256d length = _mm256_andnot_pd(_mm256_set1_pd(-0.0), apart);
    const __m128i below = _mm_max_epi32(_mm_srai_epi32(_mm_sub_epi32(bits(widest), bits(length)), bitsOfStep),
                                        _mm_setzero_si128());
    const __m256 gaps = _mm256_castpd_ps(_mm256_cmp_pd(apart, _mm256_setzero_pd(), _CMP_GT_OQ));
    const __m128 isGap =
        _mm_shuffle_ps(_mm256_castps256_ps128(gaps), _mm256_extractf128_ps(gaps, 1), _MM_SHUFFLE(2, 0, 2, 0));
    const __m128i deep = _mm_min_epi32(below, _mm_set1_epi32(deepClasses - 1)),
                  gap = _mm_sub_epi32(_mm_set1_epi32(classes - 1),
                                      _mm_min_epi32(below, _mm_set1_epi32(gapClasses - 1)));
    const __m128i inside =
        _mm_castps_si128(_mm_blendv_ps(_mm_castsi128_ps(deep), _mm_castsi128_ps(gap), isGap));
    const __m128i partners = _mm_loadu_si128(reinterpret_cast<const __m128i*>(rows.partner + k));
    const __m128i crossing =
        _mm_and_si128(_mm_cmpgt_epi32(partners, beforeCrossing), _mm_set1_epi32(classes));
    _mm_store_si128(reinterpret_cast<__m128i*>(&class_[k]), _mm_add_epi32(inside, crossing));
  }
}

void PairOrder::place(const Rows& rows, const GrainColumns& columns, const GrainStore& grains,
                      const Quad* shifts, std::int64_t& inside, std::int64_t& crossing,
                      std::int32_t* places) {
  const std::int64_t total = measure(rows, columns, grains, shifts);
  classify(rows, total);
  std::array<std::int32_t, 2 * classes> at{};
  const std::int32_t* const kind = class_.data();
  for (std::int64_t k = 0; k < total; ++k)
    ++at[kind[k]];
  const auto lay = [&](int first, std::int64_t& next) { // from numbers of pairs to first places
    auto free = static_cast<std::int32_t>(next);
    for (int c = first; c < first + classes; ++c) {
      const std::int32_t count = at[c];
      at[c] = free;
      free += count;
    }
    next = free;
  };
  lay(0, inside);
  lay(classes, crossing);
  for (std::int64_t k = 0; k < total; ++k)
    places[k] = at[kind[k]]++;
}

} // namespace sandglass
