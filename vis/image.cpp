#include "vis/renderer.h"

#include <algorithm>
#include <cstdlib>

namespace sandglass::vis {

double difference(const Image& a, const Image& b, int perChannel) {
  if (a.width != b.width || a.height != b.height) return 1;
  const std::size_t pixels = a.rgba.size() / 4;
  if (pixels == 0) return 0;
  std::size_t different = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    int largest = 0;
    for (std::size_t k = 0; k < 4; ++k)
      largest = std::max(largest, std::abs(a.rgba[4 * p + k] - b.rgba[4 * p + k]));
    different += largest > perChannel;
  }
  return static_cast<double>(different) / static_cast<double>(pixels);
}

} // namespace sandglass::vis
