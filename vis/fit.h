#pragma once
// What a camera preset shows of a frame.

#include "sim/frame/frame.h"
#include "vis/view.h"

#include <Eigen/Geometry>

namespace sandglass::vis {

/// The domain, or what is there (grains, finite walls) when the frame has none.
Eigen::AlignedBox3d domainBox(const Frame& frame);

/// The box around all grains, clipped ones too; empty without grains.
Eigen::AlignedBox3d grainBox(const Frame& frame);

/// What a picture shall hold when its grains fill `grains`: those, the walls around them as far as they add
/// less than half, whole periodic extents, rounded outwards to eighths of the domain, so that a film of
/// moving grains does not tremble. The domain when `grains` is empty.
Eigen::AlignedBox3d fitBox(const Frame& frame, const Eigen::AlignedBox3d& grains);

/// The view's camera with its preset replaced by numbers. What draw() does with grainBox(frame); with the
/// box of many frames it is the camera of their film.
Camera fitCamera(const Frame& frame, const View& view, const Eigen::AlignedBox3d& grains);

} // namespace sandglass::vis
