#include "analysis/region.h"
#include "sim/base/error.h"
#include "tests/analysis/containers.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {
constexpr double pi = std::numbers::pi;

Frame empty(const Vec3& size, std::array<bool, 3> periodic, std::vector<FrameWall> walls) {
  Frame frame = frameOf({}, size, periodic, 1);
  frame.walls = std::move(walls);
  return frame;
}

RegionOptions clearance(double radius) {
  RegionOptions options;
  options.clearance = radius;
  return options;
}

/// Volumes within five standard errors, and those small.
void checkVolume(const Volume& volume, double expected) {
  CHECK(std::abs(volume.value - expected) < 5 * volume.error + 1e-12 * expected);
  CHECK(volume.error < 1e-3 * expected);
}
} // namespace

TEST_CASE("volumes open to centres", "[region]") {
  SECTION("box: each side less a diameter") {
    const Region region(empty(Vec3(1, 2, 3), {false, false, false}, {boxWall(Vec3(1, 2, 3))}),
                        clearance(0.1));
    checkVolume(region.volume(), 0.8 * 1.8 * 2.8);
  }
  SECTION("cylinder") {
    const Region region(empty(Vec3(1, 1, 2), {false, false, false}, {cylinderWall(0.5, 2)}), clearance(0.1));
    checkVolume(region.volume(), pi * 0.16 * 1.8);
  }
  SECTION("cone: a similar cone, its tip raised") {
    const double r = 0.5, h = 1.2, a = 0.05;
    const Region region(empty(Vec3(1, 1, h), {false, false, false}, {coneWall(r, h)}), clearance(a));
    const double tip = a * std::hypot(r, h) / r, left = h - a - tip;
    checkVolume(region.volume(), pi / 3 * std::pow(r * left / h, 2) * left);
  }
  SECTION("a periodic direction is whole") {
    const Region region(empty(Vec3(1, 2, 3), {true, true, true}, {}), clearance(0.1));
    CHECK(region.volume().value == Approx(6).epsilon(1e-12));
    CHECK(region.contains(Vec3(-0.01, 5, 100)));
    CHECK(region.depthInside(Vec3(0, 0, 0), 7) == 7);
  }
}

TEST_CASE("slab volumes sum to the whole", "[region]") {
  const Region region(empty(Vec3(1, 1, 1.2), {false, false, false}, {coneWall(0.5, 1.2)}), clearance(0));
  const auto slabs = region.slabVolumes(Vec3::UnitZ(), 0, 0.3, 4);
  const double whole = pi / 3 * 0.25 * 1.2;
  double below = 0;
  for (int s = 0; s < 4; ++s) {
    const double share = std::pow((s + 1) / 4.0, 3);
    CHECK(std::abs(slabs[s].value - whole * (share - below)) < 5 * slabs[s].error);
    below = share;
  }
}

TEST_CASE("the ball of the depth lies inside", "[region]") {
  const Frame frame =
      uniformFrame(200, Vec3(1, 1, 1.2), {false, false, false}, 0.05, {coneWall(0.5, 1.2)}, 4);
  RegionOptions options = clearance(0.05);
  options.upper.x() = 0.8;
  const Region region(frame, options);
  RandomStream random(1, RandomPurpose::test, 3);
  for (const auto& x : frame.position) {
    const double depth = region.depthInside(x, 0.3);
    CHECK(depth <= 0.3);
    if (depth <= 0) continue;
    for (int k = 0; k < 20; ++k)
      CHECK(region.contains(x + 0.999999 * depth * random.direction()));
  }
}

TEST_CASE("the free surface of a stepped bed", "[region][surface]") {
  // Simple cubic, spacing 1, 12 x 12 columns: 6 layers where x < 6, 9 elsewhere; one grain in flight above.
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      for (int k = 0; k < (i < 6 ? 6 : 9); ++k)
        points.push_back(Vec3(i + 0.5, j + 0.5, k + 0.5));
  points.push_back(Vec3(3, 3, 15));
  const Frame frame = frameOf(points, Vec3(12, 12, 20), {true, true, false}, 0.5);
  RegionOptions options = clearance(0.5);
  options.up = Vec3::UnitZ();
  options.diameter = 1;
  options.surfaceMargin = 2;
  const Region region(frame, options);
  CHECK(region.surface()->heightAt(Vec3(3, 3, 0)) == 5.5);
  CHECK(region.surface()->heightAt(Vec3(9, 3, 0)) == 8.5);
  CHECK(region.surface()->highest() == 8.5);
  CHECK(region.contains(Vec3(3, 3, 3.4)));
  CHECK_FALSE(region.contains(Vec3(3, 3, 3.6)));
  CHECK(region.contains(Vec3(9, 3, 6.4)));
  // Level distance counts: 1 from the step the lower side's surface is in reach.
  CHECK(region.surface()->lowestNear(Vec3(7, 3, 0), 2) == 5.5);
  CHECK(region.surface()->lowestNear(Vec3(11, 3, 0), 2) == 5.5); // round the periodic border
  CHECK(region.surface()->lowestNear(Vec3(9, 3, 0), 1) == 8.5);
  // No walls: from 0 to 3.5 over one half and to 6.5 over the other.
  checkVolume(region.volume(), 72 * 3.5 + 72 * 6.5);
}

TEST_CASE("up may be any axis", "[region][surface]") {
  std::vector<Vec3> points;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 4; ++k)
        points.push_back(Vec3(i + 0.5, -k - 0.5, j + 0.5));
  Frame frame = frameOf(points, Vec3(6, 0, 6), {true, false, true}, 0.5);
  frame.domain.lower.y() = -10;
  RegionOptions options = clearance(0.5);
  options.up = -Vec3::UnitY(); // the bed hangs from y = 0 downwards
  options.diameter = 1;
  options.surfaceMargin = 1;
  const Region region(frame, options);
  CHECK(region.surface()->highest() == 3.5);
  CHECK(region.contains(Vec3(3, -2.4, 3)));
  CHECK_FALSE(region.contains(Vec3(3, -2.6, 3)));
  checkVolume(region.volume(), 36 * 2.5);
}

TEST_CASE("nothing below an opened gate counts", "[region]") {
  class Gate : public DistanceWall {
  public:
    Gate() : DistanceWall([](const Vec3& x) { return x.z() - 1; }) {}
    Eigen::AlignedBox3d bounds() const override { return {Vec3(0, 0, 1), Vec3(1, 1, 1)}; }
  };
  FrameWall gate;
  gate.name = "gate";
  gate.shape = std::make_shared<Gate>();
  gate.active = false;
  Frame frame = empty(Vec3(1, 1, 3), {true, true, false}, {gate});
  RegionOptions options = clearance(0.25);
  options.up = Vec3::UnitZ();
  options.freeSurface = false;
  CHECK(Region(frame, options).volume().value == Approx(1.75));
  options.closeGates = false;
  CHECK(Region(frame, options).volume().value == Approx(3));
}

TEST_CASE("grains all in flight have no surface and no region", "[region][surface]") {
  for (const double sign : {1.0, -1.0}) {
    Frame frame = frameOf({Vec3(1, 1, 1), Vec3(5, 5, 5)}, Vec3(9, 9, 9), {true, true, false}, 0.5);
    RegionOptions options = clearance(0.5);
    options.up = sign * Vec3::UnitZ();
    options.diameter = 1;
    CHECK(Region(frame, options).volume().value == 0);
  }
}

TEST_CASE("a region without bounds is refused", "[region]") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(Region(empty(Vec3(1, 1, infinity), {true, true, false}, {}), clearance(0.1)),
                    Catch::Contains("no finite bounds"));
}
