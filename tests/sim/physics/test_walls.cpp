// Wall geometry against brute-force distances and hand-made cases; many grains at one wall.

#include "sim/walls/wall_registry.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;

namespace {

std::shared_ptr<const WallShape> make(const std::string& kind, std::map<std::string, ParameterValue> values) {
  for (const WallKind& k : wallKinds())
    if (k.name == kind) {
      Parameters p;
      for (const ParameterSpec& s : k.parameters)
        if (s.fallback) p.set(s.name, *s.fallback);
      for (auto& [name, value] : values)
        p.set(name, value);
      return k.make(p);
    }
  throw std::runtime_error("no such kind");
}

WallShape::Touches touches(const WallShape& wall, const Vec3& x, double reach) {
  WallShape::Touches t;
  wall.touches(x, reach, t);
  return t;
}

} // namespace

TEST_CASE("a plane pushes along its normal") {
  const auto wall = make("plane", {{"point", Vec3(0, 0, 1)}, {"normal", Vec3(0, 0, 2)}});
  const auto t = touches(*wall, {3, 4, 1.5}, 0.6);
  REQUIRE(t.count == 1);
  CHECK(t.at[0].distance == Approx(0.5));
  CHECK(t.at[0].normal == Vec3(0, 0, 1));
  CHECK(wall->signedDistance({0, 0, 0}) == Approx(-1.0));
}

TEST_CASE("in a corner of a box three faces touch and no edge does") {
  const auto box = make("box", {{"lower", Vec3(0, 0, 0)}, {"upper", Vec3(1, 1, 1)}});
  const auto t = touches(*box, {0.1, 0.1, 0.1}, 0.2);
  CHECK(t.count == 3);
  CHECK(touches(*box, {0.5, 0.5, 0.05}, 0.1).count == 1);
}

TEST_CASE("at the rim of an open box the edge is one contact") {
  const auto box = make(
      "box", {{"lower", Vec3(0, 0, 0)}, {"upper", Vec3(1, 1, 1)}, {"open", std::vector<std::string>{"z+"}}});
  const auto t = touches(*box, {0.05, 0.5, 1.05}, 0.1);
  REQUIRE(t.count == 1);
  CHECK(t.at[0].distance == Approx(std::hypot(0.05, 0.05)));
  CHECK(touches(*box, {0.03, 0.03, 1.03}, 0.1).count ==
        2); // two rims near, their common corner not counted again
}

TEST_CASE("the outlet edge of a flat slot hopper counts once, faces cover it elsewhere") {
  const double half = 0.5 * std::numbers::pi;
  const auto wedge = make(
      "wedge", {{"outlet", 0.025}, {"width", 0.125}, {"half_angle", half}, {"height", 0.3}, {"lip", 0.0045}});
  // Above the floor: the floor alone.
  CHECK(touches(*wedge, {0.03, 0.001, 0}, 0.00112).count == 1);
  // Over the edge from inside the opening: the edge alone, once.
  const auto edge = touches(*wedge, {0.0120, 0.0006, 0}, 0.00112);
  REQUIRE(edge.count == 1);
  CHECK(edge.at[0].distance == Approx(std::hypot(0.0005, 0.0006)));
  CHECK(edge.at[0].normal.x() == Approx(-0.0005 / std::hypot(0.0005, 0.0006)));
  // Beside the lip: the lip alone.
  const auto lip = touches(*wedge, {0.0120, -0.002, 0}, 0.00112);
  REQUIRE(lip.count == 1);
  CHECK(lip.at[0].normal.isApprox(Vec3(-1, 0, 0)));
  // In the corner of floor and bin wall: both faces.
  CHECK(touches(*wedge, {0.0615, 0.001, 0}, 0.00112).count == 2);
  CHECK(wedge->signedDistance({0, 0.1, 5}) > 0);
  CHECK(wedge->signedDistance({0.07, 0.1, 5}) < 0);
}

TEST_CASE("revolved walls: distance and normal agree with a dense sampling of the surface") {
  const double angle = std::numbers::pi / 6;
  const auto hopper = make(
      "cone_hopper",
      {{"base", Vec3(0, 0, 0)}, {"outlet", 0.02}, {"width", 0.1}, {"half_angle", angle}, {"height", 0.15}});
  const TriangleMesh mesh = hopper->mesh({Vec3(-1, -1, -1), Vec3(1, 1, 1)});
  for (const Vec3& x : {Vec3(0.02, 0.01, 0.06), Vec3(-0.01, 0.04, 0.12), Vec3(0.005, -0.002, 0.01)}) {
    const auto t = touches(*hopper, x, 0.2);
    double nearest = 1e9;
    for (int k = 0; k < t.count; ++k)
      nearest = std::min(nearest, t.at[k].distance);
    double sampled = 1e9;
    for (const auto& tri : mesh.triangles)
      for (int a = 0; a <= 40; ++a)
        for (int b = 0; a + b <= 40; ++b)
          sampled = std::min(sampled,
                             (mesh.points[tri[0]] + a / 40.0 * (mesh.points[tri[1]] - mesh.points[tri[0]]) +
                              b / 40.0 * (mesh.points[tri[2]] - mesh.points[tri[0]]) - x)
                                 .norm());
    CHECK(nearest == Approx(sampled).margin(3e-4)); // facets and samples are that coarse
    CHECK(hopper->signedDistance(x) == Approx(nearest));
  }
  CHECK(hopper->signedDistance({0.06, 0, 0.1}) < 0);
}

TEST_CASE("a sphere in a cone's tip is held from both sides") {
  const auto cone =
      make("cone", {{"apex", Vec3(0, 0, 0)}, {"half_angle", std::numbers::pi / 4}, {"height", 1.0}});
  const auto t = touches(*cone, {0.01, 0, 0.3}, 0.25);
  REQUIRE(t.count == 2);
  Vec3 sum = t.at[0].normal + t.at[1].normal;
  CHECK(std::abs(sum.x()) < 1e-12);
  CHECK(sum.z() == Approx(std::sqrt(2.0)));
}

TEST_CASE("contradicting sizes are refused") {
  CHECK_THROWS_WITH(make("wedge", {{"outlet", 0.2}, {"width", 0.1}, {"half_angle", 1.0}, {"height", 0.3}}),
                    Catch::Contains("must be narrower"));
  CHECK_THROWS_WITH(make("wedge", {{"outlet", 0.02}, {"width", 0.1}, {"half_angle", 0.1}, {"height", 0.3}}),
                    Catch::Contains("must end below the height"));
}

TEST_CASE("each of many grains at a wall gets the forces of its own contacts, and the wall their sum") {
  // A row of grains along the edge of a box, far from each other; two of three touch two of its faces at
  // once, so that blocks of 64 contacts end anywhere. Springs alone, from rest: v(1) = dt/2 (a(0) + a(1)).
  using namespace sandglass::testing;
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  t.walls =
      "[[wall]]\nname = \"box\"\nkind = \"box\"\nmaterial = \"wall\"\nlower = [\"0 m\", \"-1 m\", \"0 m\"]\n"
      "upper = [\"1 m\", \"1 m\", \"1 m\"]\n";
  const double mass = 4.0 / 3.0 * std::numbers::pi * 1e-9 * 2500.0, k = 1000.0;
  const auto overlapX = [](int i) { return i % 3 == 0 ? -1e-4 : 1e-6 * (1 + i % 7); };
  const auto overlapZ = [](int i) { return 1e-6 * (1 + i % 11); };
  for (const int threads : {1, 2}) {
    DemSolver solver(t.scene(), {threads});
    std::vector<GrainSeed> seeds;
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 299; ++i) {
      seeds.push_back(grain(i, {1e-3 - overlapX(i), -0.9 + 0.006 * i, 1e-3 - overlapZ(i)}));
      sum -= k * Vec3(std::max(overlapX(i), 0.0), 0.0, overlapZ(i));
    }
    solver.add(seeds);
    solver.advance(0);
    CHECK((solver.walls()[0].force - sum).norm() < 1e-9 * sum.norm());
    solver.advance(1);
    const double dt = solver.stepSize();
    const auto speed = [&](double overlap) {
      const double a = k * std::max(overlap, 0.0) / mass;
      return 0.5 * dt * (a + k * (std::max(overlap, 0.0) - 0.5 * dt * dt * a) / mass);
    };
    for (const GrainSeed& s : solver.present()) {
      const int i = static_cast<int>(s.id);
      // Touched points are rounded to 1e-16 m at 1 mm from a centre, so normals tilt by some 1e-13.
      const double tilt = 1e-12 * speed(1e-5);
      CHECK(s.velocity.x() == Approx(speed(overlapX(i))).epsilon(1e-8).margin(tilt));
      CHECK(std::abs(s.velocity.y()) < tilt);
      CHECK(s.velocity.z() == Approx(speed(overlapZ(i))).epsilon(1e-8));
    }
  }
}
