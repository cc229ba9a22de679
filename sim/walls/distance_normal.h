#pragma once
// A tube whose push is too weak, kept for the sake of a program of 2012 (Rice, M.S. thesis, University of
// Mississippi): the normal is the way to the axis over the distance from the origin, not over the distance
// from the axis, so far from the origin the wall pushes with a fraction of its force.

#include "sim/walls/wall_shape.h"

namespace sandglass {

/// `tube` is an open cylinder as the scene describes it. As in that program a grain is pushed back however
/// deep it has got in, also with its centre beyond the wall: its distance then is negative.
std::shared_ptr<const WallShape> withDistanceNormal(std::shared_ptr<const WallShape> tube, const Vec3& base,
                                                    const Vec3& axis, double radius, double height);

} // namespace sandglass
