#include "vis/read_back.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>

namespace sandglass::vis {

Image readBack(vtkRenderWindow* window) {
  Image image;
  image.width = window->GetSize()[0];
  image.height = window->GetSize()[1];
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetRGBACharPixelData(0, 0, image.width - 1, image.height - 1, 0, pixels);
  const std::size_t row = static_cast<std::size_t>(image.width) * 4;
  image.rgba.resize(row * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    std::memcpy(&image.rgba[row * static_cast<std::size_t>(y)],
                pixels->GetPointer(0) + row * static_cast<std::size_t>(image.height - 1 - y), row);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    image.rgba[i] = 255;
  return image;
}

Image withoutGround(const Image& onBlack, const Image& onWhite) {
  Image image = onBlack;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    int lightest = 0;
    for (int k = 0; k < 3; ++k)
      lightest = std::max(lightest, onWhite.rgba[i + k] - onBlack.rgba[i + k]);
    const int opacity = 255 - lightest;
    image.rgba[i + 3] = static_cast<std::uint8_t>(opacity);
    for (int k = 0; k < 3; ++k)
      image.rgba[i + k] =
          opacity == 0 ? 0 : static_cast<std::uint8_t>(std::min(255, onBlack.rgba[i + k] * 255 / opacity));
  }
  return image;
}

Image reduced(const Image& image, int times) {
  if (times == 1) return image;
  Image result{image.width / times, image.height / times, {}};
  result.rgba.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height) * 4);
  const auto row = static_cast<std::size_t>(image.width) * 4;
  const auto n = static_cast<std::size_t>(times);
  std::uint8_t* out = result.rgba.data();
  for (std::size_t y = 0; y < static_cast<std::size_t>(result.height); ++y)
    for (std::size_t x = 0; x < static_cast<std::size_t>(result.width); ++x, out += 4) {
      int sum[4] = {};
      for (std::size_t dy = 0; dy < n; ++dy)
        for (std::size_t dx = 0; dx < n; ++dx) {
          const std::uint8_t* p = &image.rgba[(n * y + dy) * row + 4 * (n * x + dx)];
          for (int k = 0; k < 3; ++k)
            sum[k] += p[k] * p[3];
          sum[3] += p[3];
        }
      for (int k = 0; k < 3; ++k)
        out[k] = static_cast<std::uint8_t>(sum[3] == 0 ? 0 : (sum[k] + sum[3] / 2) / sum[3]);
      out[3] = static_cast<std::uint8_t>((sum[3] + times * times / 2) / (times * times));
    }
  return result;
}

Image beside(const Image& left, const Image& right) {
  Image result{left.width + right.width, std::min(left.height, right.height), {}};
  result.rgba.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height) * 4);
  const auto copy = [&](const Image& image, int offset) {
    for (int y = 0; y < result.height; ++y)
      std::memcpy(&result.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) +
                                    static_cast<std::size_t>(offset))],
                  &image.rgba[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width)],
                  4 * static_cast<std::size_t>(image.width));
  };
  copy(left, 0);
  copy(right, left.width);
  for (int y = 0; y < result.height; ++y) {
    std::uint8_t* pixel =
        &result.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) +
                          static_cast<std::size_t>(left.width))];
    std::fill(pixel, pixel + 3, std::uint8_t{128});
    pixel[3] = 255;
  }
  return result;
}

} // namespace sandglass::vis
