#include "vis/difference_picture.h"

#include <algorithm>
#include <cstdlib>

namespace sandglass::vis {

namespace {

bool differs(const Image& a, const Image& b, std::size_t pixel, int perChannel) {
  for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
    if (std::abs(a.rgba[k] - b.rgba[k]) > perChannel) return true;
  return false;
}

} // namespace

double difference(const Image& a, const Image& b, int perChannel) {
  if (a.width != b.width || a.height != b.height) return 1;
  const std::size_t pixels = a.rgba.size() / 4;
  std::size_t different = 0;
  for (std::size_t p = 0; p < pixels; ++p)
    different += differs(a, b, p, perChannel);
  return pixels == 0 ? 0 : static_cast<double>(different) / static_cast<double>(pixels);
}

Image differencePicture(const Image& image, const Image& reference, int perChannel) {
  if (image.width != reference.width || image.height != reference.height) return image;
  Image result = reference;
  for (std::size_t p = 0; p < result.rgba.size() / 4; ++p) {
    std::uint8_t* pixel = &result.rgba[4 * p];
    if (differs(image, reference, p, perChannel)) {
      pixel[0] = 220;
      pixel[1] = pixel[2] = 0;
    } else {
      for (int k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>(191 + pixel[k] / 4);
    }
    pixel[3] = 255;
  }
  return result;
}

} // namespace sandglass::vis
