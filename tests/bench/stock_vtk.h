#pragma once
// The same grains drawn by VTK's own mappers in the same window: what a straightforward program would do. No
// legend, no smoothing, no walls: they have less to do than ours.

#include "sim/frame/frame.h"
#include "vis/renderer.h"

#include <memory>

namespace sandglass::bench {

enum class StockMapper { spheres, gaussianPoints, glyphs };

class StockVtk {
public:
  explicit StockVtk(StockMapper kind);
  ~StockVtk();
  /// One picture of 1280 x 720 pixels, read back; the camera goes round by `degrees`.
  vis::Image draw(const Frame& frame, double degrees);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sandglass::bench
