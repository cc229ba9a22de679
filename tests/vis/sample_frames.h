#pragma once
// Frames that the tests of this folder draw.

#include "sim/base/random.h"
#include "sim/frame/frame.h"

#include <cmath>

namespace sandglass::test {

/// A vertical wedge of two slanted planes, a stand-in for a slot hopper.
class Wedge : public WallShape {
public:
  Wedge(double width, double height, double outlet, double depth)
      : width_(width), height_(height), outlet_(outlet), depth_(depth) {}
  void touches(const Vec3&, double, Touches&) const override {}
  double signedDistance(const Vec3&) const override { return 1; }
  Eigen::AlignedBox3d bounds() const override {
    return {Vec3(-width_ / 2, -depth_ / 2, 0), Vec3(width_ / 2, depth_ / 2, height_)};
  }
  TriangleMesh mesh(const Eigen::AlignedBox3d&) const override {
    TriangleMesh m;
    const double shoulder = (width_ - outlet_) / 2; // 45 degrees
    for (const double side : {-1.0, 1.0}) {
      const int first = static_cast<int>(m.points.size());
      for (const double y : {-depth_ / 2, depth_ / 2})
        for (const Vec3& p :
             {Vec3(outlet_ / 2, y, 0), Vec3(width_ / 2, y, shoulder), Vec3(width_ / 2, y, height_)})
          m.points.emplace_back(side * p.x(), p.y(), p.z());
      for (const auto& t :
           {std::array{0, 1, 4}, std::array{0, 4, 3}, std::array{1, 2, 5}, std::array{1, 5, 4}})
        m.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      for (const auto& e : {std::array{0, 1}, std::array{1, 2}, std::array{3, 4}, std::array{4, 5},
                            std::array{0, 3}, std::array{1, 4}, std::array{2, 5}})
        m.edges.push_back({first + e[0], first + e[1]});
    }
    return m;
  }

private:
  double width_, height_, outlet_, depth_;
};

/// Grains of 2 mm diameter on a jittered lattice above a 90 degree wedge; slow above, fast at the outlet.
inline Frame hopper(double spacing = 2.1e-3, double depth = 6e-3) {
  Frame f;
  f.time = 0.125;
  const double width = 0.08, height = 0.1, outlet = 0.02;
  f.domain.lower = Vec3(-width / 2, -depth / 2, -0.02);
  f.domain.upper = Vec3(width / 2, depth / 2, height);
  f.domain.periodic = {false, true, false};
  auto& radius = f.scalars[quantity::radius];
  auto& species = f.scalars[quantity::species];
  auto& velocity = f.vectors[quantity::velocity];
  f.speciesNames = {"glass", "steel"};
  RandomStream random(7, RandomPurpose::test, 0);
  for (double z = -0.018; z < 0.08; z += spacing)
    for (double y = -depth / 2 + spacing / 2; y < depth / 2; y += spacing)
      for (double x = -width / 2 + spacing / 2; x < width / 2; x += spacing) {
        const double half = z < 0 ? outlet / 2 - 2e-3 : std::min(width / 2, outlet / 2 + z) - 1e-3;
        if (std::abs(x) > half) continue;
        const double jitter = 1e-4;
        f.position.emplace_back(x + random.uniform(-jitter, jitter), y, z + random.uniform(-jitter, jitter));
        f.id.push_back(static_cast<std::int64_t>(f.id.size()));
        radius.push_back(1e-3 * random.uniform(0.9, 1.0));
        species.push_back(random.uniform() < 0.3 ? 1 : 0);
        velocity.emplace_back(0, 0, -0.6 * std::exp(-std::hypot(x, std::max(z, 0.0)) / 0.02));
      }
  f.walls.push_back({"wedge", std::make_shared<Wedge>(width, height, outlet, depth)});
  return f;
}

/// Grains on a cube lattice in a box without walls.
inline Frame cube(int side, double spacing = 1e-2, double radius = 4.5e-3) {
  Frame f;
  f.domain.upper = Vec3::Constant(side * spacing);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) {
        f.position.push_back(spacing * Vec3(i + 0.5, j + 0.5, k + 0.5));
        f.id.push_back(static_cast<std::int64_t>(f.id.size()));
        f.scalars[quantity::radius].push_back(radius);
        f.vectors[quantity::velocity].emplace_back(i, j, k);
      }
  return f;
}

} // namespace sandglass::test
