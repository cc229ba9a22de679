#pragma once
// Numbers next to zero. A spin or a spring that decays without end arrives at denormal numbers (below
// 2e-308), with which processors are up to a hundred times as slow. While one of these lives, its thread, and
// the workers of a Parallel that it starts, take them for zero.

#include <immintrin.h>

namespace sandglass {

class TinyNumbersAsZero {
public:
  TinyNumbersAsZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | flushResults | zeroOperands); }
  ~TinyNumbersAsZero() { _mm_setcsr(before_); }
  TinyNumbersAsZero(const TinyNumbersAsZero&) = delete;
  TinyNumbersAsZero& operator=(const TinyNumbersAsZero&) = delete;

private:
  static constexpr unsigned flushResults = 0x8000, zeroOperands = 0x0040;
  unsigned before_;
};

} // namespace sandglass
