#pragma once
// Which instructions the particle loop uses. All widths give the same bits in double precision: the same
// element-wise IEEE operations in the same order. The plain width is the oracle of the others.

namespace sandglass {

enum class KernelWidth { plain, avx2, avx512 };

/// The widest that this processor has. The environment variable SANDGLASS_KERNEL (plain, avx2, avx512) picks
/// a narrower one, for tests and comparisons.
KernelWidth bestKernelWidth();

const char* kernelName(KernelWidth width);

} // namespace sandglass
