#pragma once
// Periodic lattices of touching unit spheres (nearest distance 1).

#include "tests/analysis/containers.h"

namespace sandglass::analysis::test {

/// A periodic frame of `n` cells along each axis; `cell` are the three edges of an orthogonal cell.
inline Frame crystal(const Vec3& cell, const std::vector<Vec3>& basis, const std::array<int, 3>& n,
                     double radius = 0.5) {
  std::vector<Vec3> points;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        for (const auto& b : basis)
          points.push_back(cell.cwiseProduct(Vec3(i, j, k) + b + Vec3::Constant(0.01)));
  return frameOf(std::move(points), cell.cwiseProduct(Vec3(n[0], n[1], n[2])), {true, true, true}, radius);
}

inline Frame simpleCubicFrame(int n = 4) {
  return crystal(Vec3::Ones(), simpleCubic, {n, n, n});
}
inline Frame faceCentredFrame(int n = 4) {
  return crystal(Vec3::Constant(std::sqrt(2.0)), faceCentred, {n, n, n});
}
inline Frame bodyCentredFrame(int n = 4) {
  return crystal(Vec3::Constant(2 / std::sqrt(3.0)), {Vec3::Zero(), Vec3::Constant(0.5)}, {n, n, n});
}
/// Orthogonal cell of four: 1 x sqrt(3) x sqrt(8/3).
inline Frame hexagonalFrame(int n = 4) {
  return crystal(Vec3(1, std::sqrt(3.0), std::sqrt(8.0 / 3.0)),
                 {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 1.0 / 6, 0.5), Vec3(0, 2.0 / 3, 0.5)},
                 {n, n, n});
}

} // namespace sandglass::analysis::test
