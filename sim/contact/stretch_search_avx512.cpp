#include "sim/contact/stretch_search.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace sandglass {

[[gnu::target("arch=x86-64-v4,prefer-vector-width=512")]] std::int64_t
searchCellAvx512(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code, std::int32_t* count) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  std::int64_t found = 0;
  for (std::int32_t i = cell.first; i < cell.last; ++i) {
    const std::int64_t before = found;
    const __m512d mine = _mm512_set1_pd(cell.reach[i]);
    for (int s = 0; s < cell.stretchCount; ++s) {
      const Stretch stretch = cell.stretches[s];
      const Quad& shift = cell.shift[stretch.code];
      const __m512d px = _mm512_set1_pd(cell.x[i] - shift.x), py = _mm512_set1_pd(cell.y[i] - shift.y),
                    pz = _mm512_set1_pd(cell.z[i] - shift.z);
      const std::int32_t begin = std::max(stretch.begin, stretch.code > cell.center ? i : i + 1);
      const std::uint64_t codes = static_cast<std::uint64_t>(stretch.code) * 0x0101010101010101u;
      for (std::int32_t j = begin; j < stretch.end; j += 8) {
        const __m512d dx = _mm512_sub_pd(px, _mm512_loadu_pd(cell.x + j)),
                      dy = _mm512_sub_pd(py, _mm512_loadu_pd(cell.y + j)),
                      dz = _mm512_sub_pd(pz, _mm512_loadu_pd(cell.z + j)),
                      reach = _mm512_add_pd(mine, _mm512_loadu_pd(cell.reach + j));
        const __m512d square =
            _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy)), _mm512_mul_pd(dz, dz));
        const __mmask8 lanes = static_cast<__mmask8>(0xffu >> std::max(0, 8 - (stretch.end - j)));
        const __mmask8 near = _mm512_mask_cmp_pd_mask(lanes, square, _mm512_mul_pd(reach, reach), _CMP_LT_OQ);
        const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(j), lane);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(partner + found),
                            _mm256_maskz_compress_epi32(near, numbers));
        if (code) std::memcpy(code + found, &codes, sizeof codes);
        found += std::popcount(static_cast<unsigned>(near));
      }
    }
    count[i - cell.first] = static_cast<std::int32_t>(found - before);
  }
  return found;
}

} // namespace sandglass
