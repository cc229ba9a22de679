#pragma once
// The fused loops in mixed precision (mixed_records.h), and what goes with them. All widths give the same
// bits unless arithmetic is fast.

#include "sim/contact/fused/fused_laws.h"

#include <bit>

namespace sandglass {

/// 1.5 * 2^52: the last bits of a sum with it are those of the nearest integer.
constexpr double fixedPointBias = 6755399441055744.0;
/// A number of units as a wrapped 32-bit integer, to the nearest; up to 2^51 of them.
inline std::int32_t fixedPoint(double units) {
  return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(units + fixedPointBias));
}

/// Null where the combination has no loop.
FusedLoop mixedLoopPlain(const FusedLaws& laws);
FusedLoop mixedLoopAvx2(const FusedLaws& laws);
FusedLoop mixedLoopAvx512(const FusedLaws& laws, bool fast);

/// A kernel that adds outputs of single precision and keeps mixed records; the rest is that of double.
Kernel mixedKernelPlain();
Kernel mixedKernelAvx2();
Kernel mixedKernelAvx512();

inline FusedLoop mixedLoop(const FusedLaws& laws, KernelWidth width, bool fast) {
  return width == KernelWidth::avx512 ? mixedLoopAvx512(laws, fast)
         : width == KernelWidth::avx2 ? mixedLoopAvx2(laws)
                                      : mixedLoopPlain(laws);
}
inline Kernel mixedKernel(KernelWidth width) {
  return width == KernelWidth::avx512 ? mixedKernelAvx512()
         : width == KernelWidth::avx2 ? mixedKernelAvx2()
                                      : mixedKernelPlain();
}

} // namespace sandglass
