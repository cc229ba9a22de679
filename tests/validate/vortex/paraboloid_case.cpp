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
  double rotation = 0, curvature = 0;              ///< [rad/s], [1/m]
  double distance[rings] = {}, height[rings] = {}; ///< [m] means of each ring; 0 where it holds too few
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
  Surface surface;
  double n = 0, s = 0, z = 0, ss = 0, sz = 0;
  for (int k = 0; k < rings; ++k) {
    auto& grains = ring[k];
    if (grains.size() < 3) continue;
    std::sort(grains.rbegin(), grains.rend());
    const std::size_t top = std::max<std::size_t>(3, grains.size() / 12);
    double height = 0, distance = 0;
    for (std::size_t j = 0; j < top; ++j)
      height += grains[j].first / static_cast<double>(top);
    for (const auto& g : grains)
      distance += g.second / static_cast<double>(grains.size());
    const double square = distance * distance;
    surface.distance[k] = distance;
    surface.height[k] = height;
    n += 1, s += square, z += height, ss += square * square, sz += square * height;
  }
  surface.rotation = momentum / inertia;
  surface.curvature = (n * sz - s * z) / (n * ss - s * s);
  return surface;
}

/// Greatest difference, anywhere, of the slope over four neighbouring rings (four diameters of the grains)
/// from that of a liquid, 2 c x.
double steepest(const std::vector<Surface>& surfaces, double curvature) {
  constexpr int span = 4;
  double x[rings] = {}, z[rings] = {}, worst = 0;
  for (const Surface& s : surfaces)
    for (int k = 0; k < rings; ++k) {
      x[k] += s.distance[k] / static_cast<double>(surfaces.size());
      z[k] += s.height[k] / static_cast<double>(surfaces.size());
    }
  for (int first = 0; first + span <= rings; ++first) {
    double mx = 0, mz = 0, xx = 0, xz = 0;
    for (int k = first; k < first + span; ++k)
      mx += x[k] / span, mz += z[k] / span;
    for (int k = first; k < first + span; ++k)
      xx += (x[k] - mx) * (x[k] - mx), xz += (x[k] - mx) * (z[k] - mz);
    worst = std::max(worst, std::abs(xz / xx - 2 * curvature * mx));
  }
  return worst;
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
  report.between("paraboloid", "slope over four rings of nine, furthest from that of a liquid",
                 steepest(surfaces, rotation * rotation / (2 * gravity)), 0, 0, 0.1,
                 "surface of a liquid; smooth beads stand at 6 degrees at most");
  return fmt::format(
      "{} smooth beads in a shaken tank, then {} frames at rest; the bed turns at {:.4g} rad/s.",
      run.summary().grains, surfaces.size(), rotation);
}

} // namespace sandglass::validate
