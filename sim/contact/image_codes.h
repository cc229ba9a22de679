#pragma once
// The periodic images that a partner may stand in, numbered so that a pair keeps its image in one byte. Codes
// run through (x, y, z) in dictionary order; the one of no shift stands in the middle, and turning a pair
// round mirrors its code there.

#include "sim/frame/frame.h"
#include "sim/grains/grain_store.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

struct ImageCodes {
  std::array<int, 3> reach{0, 0, 0}; ///< images to either side along an axis
  std::vector<std::array<int, 3>> image{{0, 0, 0}};
  std::vector<Quad> shift{Quad{}}; ///< [m]; w is 0

  /// Shifts by whole boxes as one number: sums and differences of shifts are those of the numbers (components
  /// below 512).
  static std::int32_t pack(const std::array<int, 3>& boxes) {
    return (boxes[0] * 1024 + boxes[1]) * 1024 + boxes[2];
  }

  ImageCodes() = default;
  /// All images whose grains can be nearer than `cutoff` to a grain of the box. Throws InputError when they
  /// are more than 255.
  ImageCodes(const Domain& domain, double cutoff);

  int center() const { return static_cast<int>(image.size()) / 2; }
  int mirrored(int code) const { return static_cast<int>(image.size()) - 1 - code; }
  bool holds(int x, int y, int z) const {
    return x >= -reach[0] && x <= reach[0] && y >= -reach[1] && y <= reach[1] && z >= -reach[2] &&
           z <= reach[2];
  }
  int of(int x, int y, int z) const {
    return ((x + reach[0]) * (2 * reach[1] + 1) + y + reach[1]) * (2 * reach[2] + 1) + z + reach[2];
  }
};

} // namespace sandglass
