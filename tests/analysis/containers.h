#pragma once
// Containers with exact distances, and point sets, for the tests of this folder.

#include "sim/base/random.h"
#include "sim/frame/frame.h"
#include "sim/walls/wall_registry.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace sandglass::analysis::test {

/// A wall that is nothing but a signed distance.
class DistanceWall : public WallShape {
public:
  explicit DistanceWall(std::function<double(const Vec3&)> distance) : distance_(std::move(distance)) {}
  void touches(const Vec3&, double, Touches& out) const override { out.count = 0; }
  double signedDistance(const Vec3& x) const override { return distance_(x); }
  Eigen::AlignedBox3d bounds() const override {
    const double infinity = std::numeric_limits<double>::infinity();
    return {Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  }
  TriangleMesh mesh(const Eigen::AlignedBox3d&) const override { return {}; }

private:
  std::function<double(const Vec3&)> distance_;
};

inline FrameWall wall(const char* name, std::function<double(const Vec3&)> distance) {
  FrameWall w;
  w.name = name;
  w.shape = std::make_shared<DistanceWall>(std::move(distance));
  return w;
}

/// Box from the origin to `size`, one wall.
inline FrameWall boxWall(const Vec3& size) {
  return wall("box", [size](const Vec3& x) { return std::min(x.minCoeff(), (size - x).minCoeff()); });
}

/// Upright cylinder about the z axis through (r, r), from z = 0 to `height`.
inline FrameWall cylinderWall(double r, double height) {
  return wall("cylinder", [=](const Vec3& x) {
    return std::min({r - std::hypot(x.x() - r, x.y() - r), x.z(), height - x.z()});
  });
}

/// Upright cone about the z axis through (r, r): tip at z = 0, radius r at z = `height`, lid there.
inline FrameWall coneWall(double r, double height) {
  const double slant = std::hypot(r, height);
  return wall("cone", [=](const Vec3& x) {
    const double inward = (r * x.z() - height * std::hypot(x.x() - r, x.y() - r)) / slant;
    return std::min(inward, height - x.z());
  });
}

/// A wall as a scene makes it.
inline FrameWall sceneWall(const std::string& kind, const std::map<std::string, ParameterValue>& values) {
  for (const auto& known : wallKinds())
    if (known.name == kind) {
      Parameters parameters;
      for (const auto& spec : known.parameters)
        if (spec.fallback) parameters.set(spec.name, *spec.fallback);
      for (const auto& [name, value] : values)
        parameters.set(name, value);
      FrameWall w;
      w.name = kind;
      w.shape = known.make(parameters);
      return w;
    }
  throw std::runtime_error("no wall kind " + kind);
}

inline Frame frameOf(std::vector<Vec3> points, const Vec3& size, std::array<bool, 3> periodic,
                     double radius) {
  Frame frame;
  frame.domain.upper = size;
  frame.domain.periodic = periodic;
  frame.scalars[quantity::radius] = std::vector<double>(points.size(), radius);
  for (std::size_t i = 0; i < points.size(); ++i)
    frame.id.push_back(static_cast<std::int64_t>(i));
  frame.position = std::move(points);
  return frame;
}

/// Uniform centres that keep `radius` from all walls, by rejection.
inline Frame uniformFrame(std::size_t count, const Vec3& size, std::array<bool, 3> periodic, double radius,
                          std::vector<FrameWall> walls, std::uint64_t seed) {
  RandomStream random(seed, RandomPurpose::test, 0);
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 x(random.uniform(0, size.x()), random.uniform(0, size.y()), random.uniform(0, size.z()));
    bool inside = true;
    for (const auto& w : walls)
      inside = inside && w.shape->signedDistance(x) >= radius;
    if (inside) points.push_back(x);
  }
  Frame frame = frameOf(std::move(points), size, periodic, radius);
  frame.walls = std::move(walls);
  return frame;
}

/// Cubic cells of edge `a` with the given basis (shares of a), n[k] along each axis, shifted off the borders.
inline std::vector<Vec3> lattice(const std::array<int, 3>& n, double a, const std::vector<Vec3>& basis) {
  std::vector<Vec3> points;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        for (const auto& b : basis)
          points.push_back(a * (Vec3(i, j, k) + b + Vec3::Constant(0.2)));
  return points;
}

inline const std::vector<Vec3> simpleCubic{Vec3::Zero()};
inline const std::vector<Vec3> faceCentred{Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5),
                                           Vec3(0, 0.5, 0.5)};

} // namespace sandglass::analysis::test
