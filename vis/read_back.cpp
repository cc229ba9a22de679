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

Image halved(const Image& image) {
  Image result{image.width / 2, image.height / 2, {}};
  result.rgba.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height) * 4);
  const auto row = static_cast<std::size_t>(image.width) * 4;
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const std::uint8_t* corner =
          &image.rgba[2 * static_cast<std::size_t>(y) * row + 8 * static_cast<std::size_t>(x)];
      int sum[4] = {};
      for (const std::uint8_t* p : {corner, corner + 4, corner + row, corner + row + 4}) {
        for (int k = 0; k < 3; ++k)
          sum[k] += p[k] * p[3];
        sum[3] += p[3];
      }
      std::uint8_t* out = &result.rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) +
                                        static_cast<std::size_t>(x)) *
                                       4];
      for (int k = 0; k < 3; ++k)
        out[k] = static_cast<std::uint8_t>(sum[3] == 0 ? 0 : (sum[k] + sum[3] / 2) / sum[3]);
      out[3] = static_cast<std::uint8_t>((sum[3] + 2) / 4);
    }
  return result;
}

} // namespace sandglass::vis
