#include "analysis/packing.h"
#include "tests/analysis/containers.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {
constexpr double pi = std::numbers::pi;
}

TEST_CASE("slices of a sphere", "[packing]") {
  const double whole = 4.0 / 3.0 * pi * 8;
  CHECK(sphereSlabVolume(2, 5, 0, 10) == Approx(whole));
  CHECK(sphereSlabVolume(2, 5, 5, 10) == Approx(whole / 2));
  CHECK(sphereSlabVolume(2, 5, 6, 9) ==
        Approx(pi / 3 * (3 * 2 - 1))); // cap of height 1: pi h^2 (3 R - h) / 3
  CHECK(sphereSlabVolume(2, 5, 8, 9) == 0);
}

TEST_CASE("packing fractions of lattices", "[packing][lattice]") {
  const double a = 0.004;
  const std::array<bool, 3> periodic{true, true, true};
  // Slabs as thick as a layer, so that each holds one sphere's volume per a^3, wherever its planes cut.
  SECTION("simple cubic: pi / 6") {
    const Frame frame = frameOf(lattice({3, 4, 5}, a, simpleCubic), a * Vec3(3, 4, 5), periodic, a / 2);
    PackingOptions options;
    options.slabHeight = a;
    PackingProfile profile(options);
    profile.add(frame);
    const Curve curve = profile.result();
    CHECK(curve.numbers.at("packing_bulk") == Approx(pi / 6).epsilon(1e-12));
    REQUIRE(curve.series[0].y.size() == 5);
    // Slab volumes are counted, not exact: a fifth of 2^20 points.
    for (std::size_t s = 0; s < 5; ++s)
      CHECK(std::abs(curve.series[0].y[s] - pi / 6) < 5 * curve.series[0].error[s] + 1e-12);
  }
  SECTION("face-centred cubic: pi / (3 sqrt 2), upside down") {
    const Frame frame =
        frameOf(lattice({4, 3, 3}, a, faceCentred), a * Vec3(4, 3, 3), periodic, a / 2 / std::numbers::sqrt2);
    PackingOptions options;
    options.up = -Vec3::UnitX();
    PackingProfile profile(options);
    profile.add(frame);
    CHECK(profile.result().numbers.at("packing_bulk") == Approx(pi / 3 / std::numbers::sqrt2).epsilon(1e-12));
  }
}

TEST_CASE("a bed in a cylinder keeps its volume", "[packing]") {
  const double r = 0.001, radius = 0.02, height = 0.08;
  Frame frame = uniformFrame(4000, Vec3(2 * radius, 2 * radius, height), {false, false, false}, r,
                             {cylinderWall(radius, height)}, 8);
  PackingOptions options;
  options.slabHeight = 0.004;
  PackingProfile profile(options);
  profile.add(frame);
  const Curve curve = profile.result();
  // Sum over slabs of phi times the slab's volume is the grains' volume.
  const auto& s = curve.series[0];
  const double slab = pi * radius * radius * (s.x[1] - s.x[0]);
  double solid = 0;
  for (const double phi : s.y)
    solid += phi * slab;
  CHECK(solid == Approx(4000 * 4.0 / 3.0 * pi * r * r * r).epsilon(1e-3));
  CHECK(s.x.size() == 20);
}
