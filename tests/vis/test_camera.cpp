// Presets hold the box, mouse moves keep what they promise.

#include "tests/vis/pixels.h"
#include "vis/camera.h"
#include "vis/fit.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::vis;

namespace {

/// Where a point lands, in shares of width and height from the top left.
std::array<double, 2> projected(const Camera& camera, const Vec3& p, double aspect) {
  const CameraAxes axes = axesOf(camera);
  const Vec3 d = p - camera.position;
  const double full = heightAtTarget(camera), depth = (camera.target - camera.position).norm();
  const double high = camera.orthographic ? full : full * d.dot(axes.forward) / depth;
  return {0.5 + d.dot(axes.right) / (high * aspect), 0.5 - d.dot(axes.up) / high};
}

} // namespace

TEST_CASE("every preset fits the box into the free part and touches its border") {
  const Eigen::AlignedBox3d box(Vec3(-1, 2, 3), Vec3(2, 4, 8));
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
  const Frameable area{0.05, 0.85, 0.1, 0.9};
  for (const auto& preset : cameraPresets())
    for (const bool orthographic : {false, true}) {
      INFO(preset << (orthographic ? ", orthographic" : ""));
      Camera camera;
      camera.preset = preset;
      camera.orthographic = orthographic;
      camera = resolve(camera, corners, -1, 16.0 / 9, area);
      CHECK(camera.preset.empty());
      double left = 1, right = 0, top = 1, bottom = 0;
      for (const Vec3& corner : corners) {
        const auto [x, y] = projected(camera, corner, 16.0 / 9);
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
      CHECK(left >= area.left - 1e-6);
      CHECK(right <= area.right + 1e-6);
      CHECK(top >= area.top - 1e-6);
      CHECK(bottom <= area.bottom + 1e-6);
      const bool full = bottom - top > 0.8 - 1e-6 || right - left > 0.8 - 1e-6;
      CHECK(full);
    }
}

TEST_CASE("a periodic slice is looked at along its thin direction") {
  const std::vector<Vec3> points{Vec3::Zero(), Vec3::Ones()};
  for (int thin = 0; thin < 3; ++thin) {
    Eigen::AlignedBox3d box(Vec3::Zero(), Vec3::Ones());
    box.max()[thin] = 0.1;
    std::array<bool, 3> periodic{};
    periodic[static_cast<std::size_t>(thin)] = true;
    REQUIRE(thinDirection(box, periodic) == thin);
    CHECK(thinDirection(box, {false, false, false}) == -1);
    const Camera seen = resolve(Camera{}, points, thin, 1.5, {});
    CHECK(std::abs(axesOf(seen).forward[thin]) == Approx(1));
    CHECK(seen.up == (thin == 2 ? Vec3::UnitY() : Vec3::UnitZ()));
    const Camera solid = resolve(Camera{}, points, -1, 1.5, {});
    CHECK(std::abs(axesOf(solid).forward[thin]) < 0.95);
  }
  CHECK(thinDirection({Vec3::Zero(), Vec3(1, 1, 0.3)}, {false, false, true}) == -1);
}

TEST_CASE("a picture is fitted to grains and near walls, not to the empty domain") {
  Frame frame;
  frame.domain.upper = Vec3(8, 8, 8);
  frame.position = {Vec3(0.5, 0.5, 0.5), Vec3(2.5, 0.5, 0.5)};
  frame.scalars[quantity::radius] = {0.4, 0.4};
  GrainExtent grains;
  CHECK(fitPoints(frame, grains).size() == 8); // no grains yet: the domain
  grains.add(frame);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : fitPoints(frame, grains))
    box.extend(p);
  CHECK(box.isApprox({Vec3(0, 0, 0), Vec3(3, 1, 1)})); // cells of side 1: one, a gap, one
  CHECK(fitPoints(frame, grains).size() == 16);
  frame.position[0].z() = 3.5; // a second frame
  grains.add(frame);
  box.setEmpty();
  for (const Vec3& p : fitPoints(frame, grains))
    box.extend(p);
  CHECK(box.isApprox({Vec3(0, 0, 0), Vec3(3, 1, 4)}));
}

TEST_CASE("mouse moves") {
  Camera camera;
  camera.preset.clear();
  camera.position = Vec3(0, -2, 0);
  const Camera turned = orbit(camera, 90, 0);
  CHECK((turned.position - Vec3(2, 0, 0)).norm() < 1e-12);
  const Camera raised = orbit(camera, 0, 30);
  CHECK((raised.position - Vec3(0, -std::sqrt(3.0), 1)).norm() < 1e-12);
  CHECK(orbit(camera, 0, 500).position.z() < 2); // stops short of the pole
  CHECK((orbit(orbit(camera, 33, 0), -33, 0).position - camera.position).norm() < 1e-12);
  CHECK((zoom(camera, 2).position - camera.target).norm() == Approx(1));
  CHECK(zoom(camera, 2).orthographicHeight == Approx(0.5));
  const Camera moved = pan(camera, 0.5, 0.25);
  CHECK((moved.target - heightAtTarget(camera) * Vec3(0.5, 0, 0.25)).norm() < 1e-12);
  CHECK((moved.position - moved.target - camera.position + camera.target).norm() < 1e-12);
}
