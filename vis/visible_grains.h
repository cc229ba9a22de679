#pragma once
// The grains that a view shows of a frame: the one list behind drawing and picking, so that what is clipped,
// hidden by a selection or not chosen cannot be picked. A clip removes whole grains, those whose centre lies
// behind it: no cut spheres.

#include "sim/frame/frame.h"
#include "vis/history.h"
#include "vis/view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sandglass::vis {

struct VisibleGrains {
  std::vector<std::size_t> index; ///< into the frame's arrays; repeated by periodic images
  std::vector<std::int64_t> id;
  std::vector<Vec3> position;      ///< [m]
  std::vector<double> radius;      ///< [m] of a sphere; of other shapes that of the sphere around them
  std::vector<std::uint8_t> pale;  ///< 1: not chosen by a selection that highlights; empty without one
  std::vector<GrainShape> shapes;  ///< the frame's, as large as they are drawn
  std::vector<std::int32_t> shape; ///< of each grain, -1: a sphere; empty: all are spheres
  std::vector<Eigen::Quaterniond> orientation; ///< of each grain; empty when `shape` is

  std::size_t size() const { return index.size(); }
  bool isSphere(std::size_t k) const { return shape.empty() || shape[k] < 0; }
};

/// Frames without radii (imported points) get half the mean spacing of their box. Throws InputError when the
/// view's selection cannot be evaluated on this frame.
VisibleGrains visibleGrains(const Frame& frame, const View& view, const History* history = nullptr);

/// Radius of each grain of the frame: its own, that of its shape's surrounding sphere, or half the spacing.
std::vector<double> drawnRadii(const Frame& frame);

/// At most `count` of them (0: all), evenly spread over the list.
std::vector<std::size_t> evenSubset(std::size_t size, int count);

} // namespace sandglass::vis
