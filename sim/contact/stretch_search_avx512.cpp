#include "sim/contact/stretch_search.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace sandglass {

#define SANDGLASS_WIDE gnu::target("arch=x86-64-v4,prefer-vector-width=512")

namespace {

template <bool shifted>
[[SANDGLASS_WIDE]] std::int64_t search(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                                       std::int32_t* count) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const double *x = cell.x, *y = cell.y, *z = cell.z, *reaches = cell.reach; // no store changes them
  const Stretch *const first = cell.stretches, *const last = first + cell.stretchCount;
  std::int32_t* const start = partner;
  for (std::int32_t i = cell.first; i < cell.last; ++i) {
    std::int32_t* const before = partner;
    const __m512d mine = _mm512_set1_pd(reaches[i]);
    __m512d px = _mm512_set1_pd(x[i]), py = _mm512_set1_pd(y[i]), pz = _mm512_set1_pd(z[i]);
    for (const Stretch* stretch = first; stretch != last; ++stretch) {
      const std::int32_t end = stretch->end;
      std::int32_t j = std::max(stretch->begin, i + 1);
      if constexpr (shifted) {
        const int seen = stretch->code;
        const Quad& shift = cell.shift[seen];
        px = _mm512_set1_pd(x[i] - shift.x);
        py = _mm512_set1_pd(y[i] - shift.y);
        pz = _mm512_set1_pd(z[i] - shift.z);
        j = std::max(stretch->begin, seen > cell.center ? i : i + 1);
      }
      while (j < end) {
        const __m512d dx = _mm512_sub_pd(px, _mm512_loadu_pd(x + j)),
                      dy = _mm512_sub_pd(py, _mm512_loadu_pd(y + j)),
                      dz = _mm512_sub_pd(pz, _mm512_loadu_pd(z + j)),
                      reach = _mm512_add_pd(mine, _mm512_loadu_pd(reaches + j));
        const __m512d square =
            _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy)), _mm512_mul_pd(dz, dz));
        const auto lanes = static_cast<__mmask8>(_bzhi_u32(0xff, std::min(end - j, 8)));
        const __mmask8 near = _mm512_mask_cmp_pd_mask(lanes, square, _mm512_mul_pd(reach, reach), _CMP_LT_OQ);
        const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(j), lane);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(partner), _mm256_maskz_compress_epi32(near, numbers));
        if (shifted) {
          const std::uint64_t codes = static_cast<std::uint64_t>(stretch->code) * 0x0101010101010101u;
          std::memcpy(code + (partner - start), &codes, sizeof codes);
        }
        partner += std::popcount(static_cast<unsigned>(near));
        j += 8;
      }
    }
    *count++ = static_cast<std::int32_t>(partner - before);
  }
  if (!shifted && code) std::memset(code, cell.center, static_cast<std::size_t>(partner - start));
  return partner - start;
}

} // namespace

[[SANDGLASS_WIDE]] std::int64_t searchCellAvx512(const CellSearch& cell, std::int32_t* partner,
                                                 std::uint8_t* code, std::int32_t* count) {
  return cell.shifted ? search<true>(cell, partner, code, count) : search<false>(cell, partner, code, count);
}

} // namespace sandglass
