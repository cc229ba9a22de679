#pragma once
// What a camera preset shows of a frame.

#include "sim/frame/frame.h"
#include "vis/view.h"

#include <Eigen/Geometry>

#include <bitset>
#include <vector>

namespace sandglass::vis {

/// The domain, or what is there (grains, finite walls) when the frame has none.
Eigen::AlignedBox3d domainBox(const Frame& frame);

/// Where the grains of one or more frames are: the occupied cells of a grid of eight by eight by eight over
/// the domain, coarse so that the camera of a moving heap does not tremble; a plain box where there is no
/// domain.
class GrainExtent {
public:
  void add(const Frame& frame); ///< all its grains, clipped ones too
  bool empty() const { return box_.isEmpty(); }
  const Eigen::AlignedBox3d& box() const { return box_; } ///< around the grains, not rounded

  /// Corners of the occupied cells.
  std::vector<Vec3> corners(const Frame& frame) const;

private:
  static constexpr int parts = 8;
  std::bitset<parts * parts * parts> cells_;
  Eigen::AlignedBox3d box_;
};

/// What a picture shall hold: the grains, and the walls that extend no further on any side than five quarters
/// of the grains' extent. Points whose hull that is; the domain when there are no grains.
std::vector<Vec3> fitPoints(const Frame& frame, const GrainExtent& grains);

/// The view's camera with its preset replaced by numbers. draw() does so with the extent of its one frame;
/// with that of many frames it is the camera of their film.
Camera fitCamera(const Frame& frame, const View& view, const GrainExtent& grains);

} // namespace sandglass::vis
