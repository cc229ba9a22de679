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

} // namespace

std::int64_t searchCellAvx2(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                            std::int32_t* count) {
  std::int64_t found = 0;
  for (std::int32_t i = cell.first; i < cell.last; ++i) {
    const std::int64_t before = found;
    const __m256d mine = _mm256_set1_pd(cell.reach[i]);
    for (int s = 0; s < cell.stretchCount; ++s) {
      const Stretch stretch = cell.stretches[s];
      const Quad& shift = cell.shift[stretch.code];
      const __m256d px = _mm256_set1_pd(cell.x[i] - shift.x), py = _mm256_set1_pd(cell.y[i] - shift.y),
                    pz = _mm256_set1_pd(cell.z[i] - shift.z);
      const std::int32_t begin = std::max(stretch.begin, stretch.code > cell.center ? i : i + 1);
      const std::uint32_t codes = static_cast<std::uint32_t>(stretch.code) * 0x01010101u;
      for (std::int32_t j = begin; j < stretch.end; j += 4) {
        const __m256d dx = _mm256_sub_pd(px, _mm256_loadu_pd(cell.x + j)),
                      dy = _mm256_sub_pd(py, _mm256_loadu_pd(cell.y + j)),
                      dz = _mm256_sub_pd(pz, _mm256_loadu_pd(cell.z + j)),
                      reach = _mm256_add_pd(mine, _mm256_loadu_pd(cell.reach + j));
        const __m256d square =
            _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy)), _mm256_mul_pd(dz, dz));
        const unsigned lanes = stretch.end - j >= 4 ? 15u : (1u << (stretch.end - j)) - 1u;
        const unsigned near = lanes & static_cast<unsigned>(_mm256_movemask_pd(
                                          _mm256_cmp_pd(square, _mm256_mul_pd(reach, reach), _CMP_LT_OQ)));
        const __m128i numbers = _mm_add_epi32(_mm_set1_epi32(j), _mm_setr_epi32(0, 1, 2, 3));
        const __m128i shuffle = _mm_loadu_si128(reinterpret_cast<const __m128i*>(toFront[near].data()));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(partner + found), _mm_shuffle_epi8(numbers, shuffle));
        if (code) std::memcpy(code + found, &codes, sizeof codes);
        found += std::popcount(near);
      }
    }
    count[i - cell.first] = static_cast<std::int32_t>(found - before);
  }
  return found;
}

} // namespace sandglass
