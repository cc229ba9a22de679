#include "sim/contact/kernel_width.h"

#include <cstdlib>
#include <string>

namespace sandglass {

KernelWidth bestKernelWidth() {
  const char* wish = std::getenv("SANDGLASS_KERNEL");
  const std::string name = wish ? wish : "";
  if (name == "plain") return KernelWidth::plain;
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd");
  return wide && name != "avx2" ? KernelWidth::avx512 : KernelWidth::avx2;
}

const char* kernelName(KernelWidth width) {
  return width == KernelWidth::plain ? "plain" : width == KernelWidth::avx2 ? "avx2" : "avx512";
}

} // namespace sandglass
