#include "sim/contact/stretch_search.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace sandglass {

namespace {

/// For each set of four lanes: the byte shuffle that moves its 32-bit numbers to the front.
constexpr auto toFront = [] {
  std::array<std::array<std::uint8_t, 16>, 16> table{};
  for (unsigned set = 0; set < 16; ++set) {
    unsigned at = 0;
    for (unsigned lane = 0; lane < 4; ++lane)
      if (set >> lane & 1)
        for (unsigned byte = 0; byte < 4; ++byte)
          table[set][at++] = static_cast<std::uint8_t>(4 * lane + byte);
  }
  return table;
}();

template <bool shifted>
std::int64_t search(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code, std::int32_t* count) {
  const double *x = cell.x, *y = cell.y, *z = cell.z, *reaches = cell.reach; // no store changes them
  const Stretch *const first = cell.stretches, *const last = first + cell.stretchCount;
  std::int32_t* const start = partner;
  for (std::int32_t i = cell.first; i < cell.last; ++i) {
    std::int32_t* const before = partner;
    const __m256d mine = _mm256_set1_pd(reaches[i]);
    __m256d px = _mm256_set1_pd(x[i]), py = _mm256_set1_pd(y[i]), pz = _mm256_set1_pd(z[i]);
    for (const Stretch* stretch = first; stretch != last; ++stretch) {
      const std::int32_t end = stretch->end;
      std::int32_t j = std::max(stretch->begin, i + 1);
      if constexpr (shifted) {
        const int seen = stretch->code;
        const Quad& shift = cell.shift[seen];
        px = _mm256_set1_pd(x[i] - shift.x);
        py = _mm256_set1_pd(y[i] - shift.y);
        pz = _mm256_set1_pd(z[i] - shift.z);
        j = std::max(stretch->begin, seen > cell.center ? i : i + 1);
      }
      while (j < end) {
        const __m256d dx = _mm256_sub_pd(px, _mm256_loadu_pd(x + j)),
                      dy = _mm256_sub_pd(py, _mm256_loadu_pd(y + j)),
                      dz = _mm256_sub_pd(pz, _mm256_loadu_pd(z + j)),
                      reach = _mm256_add_pd(mine, _mm256_loadu_pd(reaches + j));
        const __m256d square =
            _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy)), _mm256_mul_pd(dz, dz));
        const __m256d less = _mm256_cmp_pd(square, _mm256_mul_pd(reach, reach), _CMP_LT_OQ);
        const unsigned near =
            _bzhi_u32(static_cast<unsigned>(_mm256_movemask_pd(less)), std::min(end - j, 4));
        const __m128i numbers = _mm_add_epi32(_mm_set1_epi32(j), _mm_setr_epi32(0, 1, 2, 3));
        const __m128i shuffle = _mm_loadu_si128(reinterpret_cast<const __m128i*>(toFront[near].data()));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(partner), _mm_shuffle_epi8(numbers, shuffle));
        if (shifted) {
          const std::uint32_t codes = static_cast<std::uint32_t>(stretch->code) * 0x01010101u;
          std::memcpy(code + (partner - start), &codes, sizeof codes);
        }
        partner += std::popcount(near);
        j += 4;
      }
    }
    *count++ = static_cast<std::int32_t>(partner - before);
  }
  if (!shifted && code) std::memset(code, cell.center, static_cast<std::size_t>(partner - start));
  return partner - start;
}

} // namespace

std::int64_t searchCellAvx2(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                            std::int32_t* count) {
  return cell.shifted ? search<true>(cell, partner, code, count) : search<false>(cell, partner, code, count);
}

} // namespace sandglass
