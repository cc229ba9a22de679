#pragma once
// Looking at single pixels.

#include "vis/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sandglass::test {

inline std::array<int, 3> at(const vis::Image& image, int x, int y) {
  const std::uint8_t* p =
      &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x))];
  return {p[0], p[1], p[2]};
}

inline int distance(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Grains alone on white: no walls, no writing.
inline vis::View bareView(int width = 640, int height = 360) {
  vis::View view;
  view.width = width;
  view.height = height;
  view.walls = view.axes = view.legend = view.timeStamp = view.scaleBar = false;
  return view;
}

/// Looks along +y from the front, without perspective, `high` metres of the x-z plane.
inline vis::View flatView(double high, int width = 640, int height = 360) {
  vis::View view = bareView(width, height);
  view.camera.preset.clear();
  view.camera.orthographic = true;
  view.camera.orthographicHeight = high;
  view.camera.position = Vec3(0, -10 * high, 0);
  return view;
}

} // namespace sandglass::test
