// A wind on a grid: linear fields come out as they are, a sampled vortex is the vortex, and what is wrong
// with a file or a domain is said.
#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/fields/field.h"
#include "sim/fields/field_registry.h"
#include "sim/fields/flow_file.h"
#include "tests/sim/fields/vortex_case.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <functional>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

using Flow = std::function<Vec3(const Vec3&)>;

FrameField sampled(const std::array<int, 3>& points, const Vec3& origin, const Vec3& spacing,
                   const Flow& flow) {
  FrameField grid;
  grid.points = points;
  grid.origin = origin;
  grid.spacing = spacing;
  auto& values = grid.vectors["velocity"];
  for (int z = 0; z < points[2]; ++z)
    for (int y = 0; y < points[1]; ++y)
      for (int x = 0; x < points[0]; ++x)
        values.push_back(flow(origin + spacing.cwiseProduct(Vec3(x, y, z))));
  return grid;
}

Parameters parametersOf(const FrameField& grid) {
  Parameters p;
  p.set("points", std::vector<double>(grid.points.begin(), grid.points.end()));
  p.set("origin", grid.origin);
  p.set("spacing", grid.spacing);
  p.set("velocities", grid.vectors.at("velocity"));
  return p;
}

Vec3 flowAt(const Field& field, const Vec3& place) {
  FieldBlock b{};
  b.size = 1;
  b.x[0] = place.x();
  b.y[0] = place.y();
  b.z[0] = place.z();
  field.apply(b, 1.0);
  return {b.flowX[0], b.flowY[0], b.flowZ[0]};
}

std::string tableOf(const FrameField& grid, const std::string& rest) {
  std::string velocities;
  for (const Vec3& v : grid.vectors.at("velocity"))
    velocities += fmt::format("[\"{} m/s\", \"{} m/s\", \"{} m/s\"],", v.x(), v.y(), v.z());
  return fmt::format("[[field]]\nname = \"flow\"\nkind = \"gridded_wind\"\npoints = [{}, {}, {}]\n"
                     "origin = [\"{} m\", \"{} m\", \"{} m\"]\nspacing = [\"{} m\", \"{} m\", \"{} "
                     "m\"]\nvelocities = [{}]\n{}\n",
                     grid.points[0], grid.points[1], grid.points[2], grid.origin.x(), grid.origin.y(),
                     grid.origin.z(), grid.spacing.x(), grid.spacing.y(), grid.spacing.z(), velocities, rest);
}

const std::string drag = "[[field]]\nname = \"stir\"\nkind = \"drag\"\nlaw = \"both\"\nlinear_coefficient = "
                         "\"0.1 kg/(m*s)\"\nquadratic_coefficient = \"50 kg/m^3\"\n";

template <class Act> std::string refusal(Act&& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("a velocity that grows linearly comes out of a grid to round-off", "[fields]") {
  Eigen::Matrix3d slope;
  slope << 3, -1, 0.5, 2, 0.25, -7, 0, 1, 4;
  const Vec3 atOrigin(0.3, -2, 1);
  const auto linear = [&](const Vec3& x) { return Vec3(atOrigin + slope * x); };
  const Vec3 origin(-0.1, 0.02, -0.3), spacing(0.013, 0.05, 0.007);
  const auto field =
      findField("gridded_wind")->make(parametersOf(sampled({11, 4, 30}, origin, spacing, linear)));
  for (int k = 0; k < 200; ++k) {
    RandomStream random(5, RandomPurpose::test, k);
    const Vec3 x = origin + spacing.cwiseProduct(
                                Vec3(10 * random.uniform(), 3 * random.uniform(), 29 * random.uniform()));
    REQUIRE((flowAt(*field, x) - linear(x)).norm() < 1e-14 * 10);
  }
  // Corners, and the last point itself.
  CHECK((flowAt(*field, origin) - linear(origin)).norm() < 1e-14);
  const Vec3 last = origin + spacing.cwiseProduct(Vec3(10, 3, 29));
  CHECK((flowAt(*field, last) - linear(last)).norm() < 1e-14 * 10);
}

TEST_CASE("beyond its grid a wind is that of the edge, or nothing; one point alone is everywhere",
          "[fields]") {
  const auto grid = sampled({3, 2, 1}, Vec3::Zero(), Vec3(0.1, 0.1, 1),
                            [](const Vec3& x) { return Vec3(1 + 10 * x.x(), 2, 0); });
  Parameters p = parametersOf(grid);
  p.set("outside", std::string("edge"));
  CHECK(flowAt(*findField("gridded_wind")->make(p), Vec3(7, -3, 0)) == Vec3(3, 2, 0));
  CHECK(flowAt(*findField("gridded_wind")->make(p), Vec3(0.1, 0.05, 55)) == Vec3(2, 2, 0));
  p.set("outside", std::string("still"));
  CHECK(flowAt(*findField("gridded_wind")->make(p), Vec3(0.21, 0.05, 0)) == Vec3::Zero());
  CHECK(flowAt(*findField("gridded_wind")->make(p), Vec3(0.2, 0.1, 55)) == Vec3(3, 2, 0));
}

// Solid-body rotation is linear in space, so its samples hold all of it.
TEST_CASE("a grain in a sampled vortex goes as in the vortex", "[fields]") {
  const double rate = 40;
  VortexCase analytic, gridded;
  analytic.fields =
      fmt::format("[[field]]\nname = \"flow\"\nkind = \"solid_body_vortex\"\nangular_velocity = "
                  "\"{} rad/s\"\n{}",
                  rate, drag);
  gridded.fields = tableOf(sampled({5, 5, 2}, Vec3(-0.2, -0.2, -1), Vec3(0.1, 0.1, 2),
                                   [&](const Vec3& x) { return Vec3(-rate * x.y(), rate * x.x(), 0); }),
                           "outside = \"edge\"") +
                   drag;
  const std::vector<GrainSeed> start{analytic.bead(0, Vec3(0.03, 0.01, 0.1))};
  const GrainSeed a = after(analytic, start, 0.05)[0], b = after(gridded, start, 0.05)[0];
  CHECK(a.velocity.norm() > 0.05); // it is carried along
  CHECK((a.position - b.position).norm() < 1e-14);
  CHECK((a.velocity - b.velocity).norm() < 1e-12 * a.velocity.norm());
}

TEST_CASE("a wind's file becomes points and velocities of the scene, and its faults are told", "[fields]") {
  FrameField grid = sampled({3, 3, 2}, Vec3(-1, -1, 0), Vec3(1, 1, 4), [](const Vec3& x) { return x; });
  registerFlowReader(".grid", [&](const std::filesystem::path&) { return grid; });
  Parameters p;
  p.set("file", std::string("a.grid"));
  p.set("scale", 0.1);
  p.set("shift", Vec3(0, 0, -0.2));
  p.set("velocity_scale", 2.0);
  const Parameters made = flowFromFile(p, "/here");
  CHECK_FALSE(made.has("file"));
  CHECK(made.vector("origin") == Vec3(-0.1, -0.1, -0.2));
  CHECK(made.vector("spacing") == Vec3(0.1, 0.1, 0.4));
  CHECK(made.vectors("velocities")[8] == Vec3(2, 2, 0));

  const auto told = [&] { return refusal([&] { flowFromFile(p, "/here"); }); };
  grid.vectors["vorticity"] = grid.vectors["velocity"];
  CHECK(told() ==
        "/here/a.grid: it holds the vectors 'velocity', 'vorticity'; say which with the key 'array'");
  p.set("array", std::string("wind"));
  CHECK(told() ==
        "/here/a.grid: it holds no vectors 'wind' at its points; there are 'velocity', 'vorticity'");
  p.set("array", std::string("velocity"));
  CHECK(told().empty());
  grid.vectors["velocity"][7].y() = std::nan("");
  CHECK(told() ==
        "/here/a.grid: the velocity at the point 1 2 0 of the grid is (0, nan, 0), but finite numbers are "
        "due; fill such places");
  grid.spacing.y() = 0;
  CHECK(told() ==
        "/here/a.grid: along y it has 3 points with a spacing of 0 from -1 on, but numbers are due, the "
        "spacing above 0");
  grid.vectors.clear();
  CHECK(told() ==
        "/here/a.grid: it holds no vectors at its points, but a wind is one; give it an array of three "
        "components at the points");
  p.set("file", std::string("a.dat"));
  CHECK_THAT(told(), Catch::StartsWith("/here/a.dat: a wind on a grid is read from ") &&
                         Catch::EndsWith("; convert the file"));
  p.set("points", std::vector<double>{1, 1, 1});
  CHECK(told() == "it has both 'file' and 'points'; give one of them");
}

TEST_CASE("a domain that reaches beyond a wind's grid is refused until the scene says what blows there",
          "[fields]") {
  const auto grid =
      sampled({2, 2, 2}, Vec3(-1, -1, -1), Vec3(2, 2, 3), [](const Vec3&) { return Vec3(1, 0, 0); });
  VortexCase setup; // its domain reaches to x = 9 m
  setup.fields = tableOf(grid, "");
  CHECK_THAT(refusal([&] { setup.scene(); }),
             Catch::Contains(
                 "field.flow has a grid from -1 m to 1 m along x, and the domain reaches from -1 m to 9 m; "
                 "say what blows beyond the grid with outside = \"edge\" (the velocity of its nearest "
                 "point) or \"still\""));
  setup.fields = tableOf(grid, "outside = \"still\"");
  CHECK_NOTHROW(setup.scene());
  // The scene that a run keeps gives the same wind.
  const Scene scene = setup.scene();
  CHECK(parseScene(writeScene(scene), "kept.toml").fields == scene.fields);
}
