#pragma once
// A field that the tests of this folder slice.

#include "sim/frame/frame.h"

namespace sandglass::test {

/// x and z from -1 to 1 m, `side` points each way, `depth` points along y: a solid-body rotation about y,
/// 1 rad/s, and a ramp along x.
inline FrameField swirl(int side, int depth) {
  FrameField field;
  field.name = "swirl";
  field.points = {side, depth, side};
  const double step = 2.0 / (side - 1);
  field.spacing = Vec3::Constant(step);
  field.origin = Vec3(-1, -step * (depth - 1) / 2, -1);
  field.units = {{"ramp", "m"}, {"velocity", "m/s"}};
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < depth; ++j)
      for (int i = 0; i < side; ++i) {
        const double x = -1 + step * i, z = -1 + step * k;
        field.scalars["ramp"].push_back(x);
        field.vectors["velocity"].emplace_back(z, 0, -x);
      }
  return field;
}

} // namespace sandglass::test
