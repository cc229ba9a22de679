// A bed that turns with the fluid, against the surface of a turning liquid.

#include "sim/run/run.h"
#include "tests/validate/vortex/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::validate {

namespace {

constexpr double tank = 0.04, gravity = 9.8; ///< [m], [m/s^2], of the sample
constexpr int rings = 9;

struct Surface {
  double rotation = 0, curvature = 0; ///< [rad/s], [1/m]
};

/// Rotation from the angular momentum; curvature from a fit through the mean height of the highest twelfth of
/// the grains (three at least) in each of nine rings of equal width.
Surface surfaceOf(const Frame& frame) {
  const auto& velocity = frame.vector(quantity::velocity);
  double momentum = 0, inertia = 0;
  std::vector<std::pair<double, double>> ring[rings]; // height, distance from the axis
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    const Vec3 &x = frame.position[i], &v = velocity[i];
    momentum += x.x() * v.y() - x.y() * v.x();
    inertia += x.head<2>().squaredNorm();
    const double rho = x.head<2>().norm();
    ring[std::clamp(static_cast<int>(rho / (tank - 2e-3) * rings), 0, rings - 1)].emplace_back(x.z(), rho);
  }
  double n = 0, s = 0, z = 0, ss = 0, sz = 0;
  for (auto& grains : ring) {
    if (grains.size() < 3) continue;
    std::sort(grains.rbegin(), grains.rend());
    const std::size_t top = std::max<std::size_t>(3, grains.size() / 12);
    double height = 0, distance = 0;
    for (std::size_t k = 0; k < top; ++k)
      height += grains[k].first / static_cast<double>(top);
    for (const auto& g : grains)
      distance += g.second / static_cast<double>(grains.size());
    const double square = distance * distance;
    n += 1, s += square, z += height, ss += square * square, sz += square * height;
  }
  return {momentum / inertia, (n * sz - s * z) / (n * ss - s * s)};
}

} // namespace

std::string judgeParaboloid(Report& report) {
  const Scene scene = readScene(SANDGLASS_SOURCE_DIR "/sample_runs/vortex_paraboloid/scene.toml");
  std::vector<Surface> surfaces; // of the time after the shaking
  Run run(scene, {});
  run.onSavedFrame = [&](const FramePtr& frame) {
    if (frame->stage == "rest") surfaces.push_back(surfaceOf(*frame));
  };
  run.execute();
  double rotation = 0, curvature = 0, square = 0;
  const auto count = static_cast<double>(surfaces.size());
  for (const Surface& s : surfaces) {
    rotation += s.rotation / count;
    curvature += s.curvature / count;
    square += s.curvature * s.curvature / count;
  }
  report.near("paraboloid", "curvature of the surface [1/m]", curvature,
              2 * std::sqrt(std::max(0.0, square - curvature * curvature)),
              rotation * rotation / (2 * gravity), 0.10,
              "surface of a liquid at the bed's measured rotation");
  return fmt::format(
      "{} smooth beads in a shaken tank, then {} frames at rest; the bed turns at {:.4g} rad/s.",
      run.summary().grains, surfaces.size(), rotation);
}

} // namespace sandglass::validate
