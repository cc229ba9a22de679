#pragma once
// The vector type of the whole program. Right-handed axes, SI units.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sandglass {

using Vec3 = Eigen::Vector3d;

} // namespace sandglass
