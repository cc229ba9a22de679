// Walls of triangles: every place counted once, the same answers as the shapes they copy, and files that are
// no meshes refused with a sentence.

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/walls/stl_reader.h"
#include "tests/sim/physics/bench_scenes.h"
#include "tests/sim/physics/wall_harness.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;

std::shared_ptr<const WallShape> meshWall(const TriangleMesh& mesh,
                                          std::map<std::string, ParameterValue> more = {}) {
  std::vector<double> corners;
  for (const auto& t : mesh.triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  more["points"] = mesh.points;
  more["corners"] = corners;
  return makeWall("mesh", more);
}

/// Two triangles on the square [0, 1]^2, folded along the diagonal x + y = 1: the far corner at height
/// `fold`.
TriangleMesh square(double fold = 0) {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, fold}, {0, 1, 0}}, {{0, 1, 3}, {1, 2, 3}}, {}};
}

TriangleMesh boxMesh(const Vec3& lower, const Vec3& upper) {
  TriangleMesh m;
  for (int c = 0; c < 8; ++c)
    m.points.emplace_back(c & 1 ? upper.x() : lower.x(), c & 2 ? upper.y() : lower.y(),
                          c & 4 ? upper.z() : lower.z());
  for (const auto& q : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    m.triangles.push_back({q[0], q[1], q[2]});
    m.triangles.push_back({q[0], q[2], q[3]});
  }
  return m;
}

std::string textStl(const TriangleMesh& m) {
  std::string s = "solid thing\n";
  for (const auto& t : m.triangles) {
    s += "  facet normal 0 0 0\n    outer loop\n";
    for (const int c : t)
      s += fmt::format("      vertex {} {} {}\n", m.points[c].x(), m.points[c].y(), m.points[c].z());
    s += "    endloop\n  endfacet\n";
  }
  return s + "endsolid thing\n";
}

std::string binaryStl(const TriangleMesh& m) {
  std::string s(80, ' ');
  const auto count = static_cast<std::uint32_t>(m.triangles.size());
  s.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& t : m.triangles) {
    s.append(12, '\0');
    for (const int c : t)
      for (int k = 0; k < 3; ++k) {
        const auto v = static_cast<float>(m.points[c][k]);
        s.append(reinterpret_cast<const char*>(&v), 4);
      }
    s.append(2, '\0');
  }
  return s;
}

/// As a scene writes it.
std::string wallText(const TriangleMesh& m, const std::string& more = "") {
  std::string points, corners;
  for (const Vec3& p : m.points)
    points += fmt::format("[\"{} m\", \"{} m\", \"{} m\"], ", p.x(), p.y(), p.z());
  for (const auto& t : m.triangles)
    corners += fmt::format("{}, {}, {}, ", t[0], t[1], t[2]);
  return fmt::format(
      "[[wall]]\nname = \"box\"\nkind = \"mesh\"\nmaterial = \"wall\"\npoints = [{}]\ncorners = [{}]\n{}",
      points, corners, more);
}

} // namespace

TEST_CASE("the seam between two triangles of a plane is felt once, wherever the sphere is") {
  const auto flat = meshWall(square());
  for (int k = 0; k <= 200; ++k) {
    const double s = 0.3 + 0.4 * k / 200; // across the seam at 0.5, and exactly on it
    const auto t = touchesOf(*flat, {s, s, 0.09}, 0.1);
    REQUIRE(t.count == 1);
    CHECK(t.at[0].distance == Approx(0.09).epsilon(1e-14));
    CHECK((t.at[0].normal - Vec3::UnitZ()).norm() < 1e-14);
  }
}

TEST_CASE("a convex fold is one contact, a convex corner is one, a hollow is two") {
  const auto ridge = meshWall(square(-1.0)), hollow = meshWall(square(1.0));
  for (const double off : {-1e-3, -1e-17, 0.0, 1e-17, 1e-3}) {
    const auto t = touchesOf(*ridge, {0.5 + off, 0.5 + off, 0.09}, 0.1);
    CHECK(t.count == 1);
  }
  CHECK(touchesOf(*hollow, {0.49, 0.49, 0.08}, 0.1).count == 2);
  const auto box = meshWall(boxMesh({0, 0, 0}, {1, 1, 1}));
  CHECK(touchesOf(*box, {-0.03, -0.04, -0.05}, 0.1).count == 1); // beyond the corner
  CHECK(touchesOf(*box, {0.5, -0.03, -0.04}, 0.1).count == 1);   // beyond an edge
  CHECK(touchesOf(*box, {0.05, 0.06, 0.07}, 0.1).count == 3);    // in the corner, from inside
  CHECK(touchesOf(*box, {0.5, 0.06, 0.07}, 0.1).count == 2);
  CHECK(touchesOf(*box, {0.5, 0.5, 0.07}, 0.1).count == 1); // over the diagonal of a face
}

TEST_CASE("distances to a mesh agree with brute force, and its side is told right") {
  const TriangleMesh mesh = boxMesh({-1, -2, -3}, {1, 2, 3});
  const auto inside = meshWall(mesh, {{"grains", std::string("inside")}}),
             outside = meshWall(mesh, {{"grains", std::string("outside")}}), both = meshWall(mesh);
  for (int k = 0; k < 300; ++k) {
    RandomStream random(4, RandomPurpose::test, k);
    const Vec3 x(3 * random.uniform() - 1.5, 6 * random.uniform() - 3, 8 * random.uniform() - 4);
    const Vec3 past = x.cwiseAbs() - Vec3(1, 2, 3);
    const double exact =
        past.cwiseMax(0).norm() + std::min(0.0, past.maxCoeff()); // of a box, negative inside
    CHECK(std::abs(outside->signedDistance(x) - exact) < 1e-12);
    CHECK(std::abs(inside->signedDistance(x) + exact) < 1e-12);
    CHECK(std::abs(both->signedDistance(x) - std::abs(exact)) < 1e-12);
    const auto t = touchesOf(*both, x, 10.0);
    double nearest = 10;
    for (int c = 0; c < t.count; ++c)
      nearest = std::min(nearest, t.at[c].distance);
    CHECK(std::abs(nearest - std::abs(exact)) < 1e-12);
  }
}

TEST_CASE("a sphere that rolls over a seam keeps its force and its friction") {
  const auto roll = [](const std::string& wall) {
    SceneText t;
    t.gravity = R"(["1 m/s^2", "1 m/s^2", "-9.81 m/s^2"])";
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.5 })";
    t.tangential = R"({ law = "spring", friction = 0.5, damping_ratio = 0.2 })";
    t.walls = wall + "[[probe]]\nname = \"box\"\nkind = \"wall_force\"\nwall = \"box\"\ninterval = \"1 s\"\n";
    auto solver = std::make_unique<DemSolver>(t.scene(), SolverOptions{1});
    const double sunk = 4.0 / 3.0 * pi * 1e-9 * 2500.0 * 9.81 / 1000.0;
    solver->add({grain(0, {0.495, 0.495, 1e-3 - sunk}, {0.1, 0.1, 0})});
    solver->advance(static_cast<std::int64_t>(0.1 / solver->stepSize()));
    return solver;
  };
  auto mesh = roll(wallText(square()));
  auto plane =
      roll("[[wall]]\nname = \"box\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0\", \"0\", \"0\"]\n"
           "normal = [0, 0, 1]\n");
  const GrainSeed a = mesh->present()[0], b = plane->present()[0];
  CHECK(a.position.x() > 0.502); // it has crossed
  CHECK((a.position - b.position).norm() < 1e-12);
  CHECK((a.velocity - b.velocity).norm() < 1e-9);
  CHECK((a.spin - b.spin).norm() < 1e-6);
  CHECK(mesh->walls()[0].collisions == 1);
  CHECK(plane->walls()[0].collisions == 1);
}

TEST_CASE("a box of triangles holds the same bed as the box") {
  const auto settle = [](const std::string& wall, double seconds) {
    SceneText t;
    t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.5 })";
    t.tangential = R"({ law = "spring", friction = 0.5, damping_ratio = 0.2 })";
    t.stepsPerContact = 25;
    t.walls = wall;
    auto solver = std::make_unique<DemSolver>(t.scene(), SolverOptions{1});
    std::vector<GrainSeed> seeds;
    for (int k = 0; k < 108; ++k) {
      RandomStream random(8, RandomPurpose::test, k);
      seeds.push_back(
          grain(k, {2e-3 + 2.2e-3 * (k % 6), 2e-3 + 2.2e-3 * (k / 6 % 6), 1.5e-3 + 2.2e-3 * (k / 36)},
                0.1 * random.direction()));
    }
    solver->add(seeds);
    solver->advance(static_cast<std::int64_t>(seconds / solver->stepSize()));
    return solver;
  };
  const std::string box =
      "[[wall]]\nname = \"box\"\nkind = \"box\"\nmaterial = \"wall\"\nlower = [\"0\", \"0\", "
      "\"0\"]\nupper = [\"15 mm\", \"15 mm\", \"40 mm\"]\n";
  const std::string mesh = wallText(boxMesh({0, 0, 0}, {0.015, 0.015, 0.04}), "closed = true\n");
  // As long as rounding has not grown: the same paths.
  const auto a = settle(box, 0.01)->present(), b = settle(mesh, 0.01)->present();
  for (std::size_t i = 0; i < a.size(); ++i)
    CHECK((a[i].position - b[i].position).norm() < 1e-9);
  // At rest: the same weight on the walls, the same height within the scatter of packings (a tenth of a
  // grain).
  const auto restA = settle(box, 0.3), restB = settle(mesh, 0.3);
  double heightA = 0, heightB = 0;
  for (const auto& g : restA->present())
    heightA += g.position.z() / 108;
  for (const auto& g : restB->present())
    heightB += g.position.z() / 108;
  CHECK(std::abs(heightA - heightB) < 0.2e-3);
  const double weight = 108 * 4.0 / 3.0 * pi * 1e-9 * 2500.0 * 9.81;
  CHECK(-restA->walls()[0].force.z() == Approx(weight).epsilon(0.02));
  CHECK(-restB->walls()[0].force.z() == Approx(weight).epsilon(0.02));
}

TEST_CASE("a cone in facets throws a sphere back as the cone does, within the angle of a facet") {
  constexpr int around = 96;
  const double angle = pi / 6, radius = 0.1, height = radius / std::tan(angle);
  TriangleMesh cone;
  cone.points.emplace_back(0, 0, 0);
  for (int k = 0; k < around; ++k)
    cone.points.emplace_back(radius * std::cos(2 * pi * k / around), radius * std::sin(2 * pi * k / around),
                             height);
  for (int k = 0; k < around; ++k)
    cone.triangles.push_back({0, 1 + k, 1 + (k + 1) % around});
  for (int k = 0; k < 40; ++k) {
    SceneText t;
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1 })";
    t.walls = wallText(cone);
    DemSolver solver(t.scene(), {1});
    const double phi = 2 * pi * k / 40; // on seams and between them
    const Vec3 radial(std::cos(phi), std::sin(phi), 0);
    const Vec3 n = -std::cos(angle) * radial + std::sin(angle) * Vec3::UnitZ();
    solver.add({grain(0, 0.6 * (radius * radial + height * Vec3::UnitZ()) + 1.3e-3 * n, -0.1 * n)});
    solver.advance(static_cast<std::int64_t>(0.012 / solver.stepSize()));
    const Vec3 out = solver.present()[0].velocity;
    CAPTURE(k, out.transpose());
    CHECK(out.dot(n) == Approx(0.1).epsilon(0.005));
    // A facet's normal is up to half its angle of 3.75 degrees off, and turns the bounce by twice that.
    CHECK((out - out.dot(n) * n).norm() < 0.1 * std::sin(3.75 * pi / 180) * 1.05);
  }
}

TEST_CASE("text and binary STL give the same mesh") {
  const TriangleMesh box = boxMesh({0, 0, 0}, {1, 2, 0.5});
  for (const std::string& bytes : {textStl(box), binaryStl(box)}) {
    const TriangleMesh read = parseStl(bytes, "box.stl");
    REQUIRE(read.points.size() == 8);
    REQUIRE(read.triangles.size() == 12);
    for (std::size_t t = 0; t < 12; ++t)
      for (int c = 0; c < 3; ++c)
        CHECK(read.points[read.triangles[t][c]] == box.points[box.triangles[t][c]]);
  }
  std::string disguised = binaryStl(box);
  std::memcpy(disguised.data(), "solid", 5); // as some programs write
  CHECK(parseStl(disguised, "box.stl").triangles.size() == 12);
}

TEST_CASE("a scene takes the triangles in, so that it needs the file no more") {
  const test::TemporaryFolder folder("mesh");
  std::ofstream(folder.path() / "box.stl", std::ios::binary) << binaryStl(boxMesh({0, 0, 0}, {2, 2, 4}));
  SceneText t;
  t.walls =
      "[[wall]]\nname = \"box\"\nkind = \"mesh\"\nmaterial = \"wall\"\nfile = \"box.stl\"\nscale = \"1 cm\"\n"
      "shift = [\"1 mm\", \"0\", \"0\"]\ngrains = \"inside\"\n";
  const Scene scene = parseScene(t.text(), "scene.toml", {}, folder.path().string());
  const Parameters& p = scene.walls[0].shape.parameters;
  CHECK(!p.has("file"));
  REQUIRE(p.vectors("points").size() == 8);
  CHECK(p.numbers("corners").size() == 36);
  CHECK(parseScene(writeScene(scene), "scene.toml") == scene);
  const auto wall = makeWall("mesh", p.all());
  CHECK((wall->bounds().min() - Vec3(1e-3, 0, 0)).norm() < 1e-15);
  CHECK((wall->bounds().max() - Vec3(21e-3, 20e-3, 40e-3)).norm() < 1e-15);
  t.walls.replace(t.walls.find("box.stl"), 7, "nix.stl");
  CHECK_THROWS_WITH(parseScene(t.text(), "scene.toml", {}, folder.path().string()),
                    Catch::Contains("nix.stl") && Catch::Contains("cannot be opened"));
}

TEST_CASE("bad meshes are refused: file, place, what was found, what is due") {
  const auto says = [](const std::string& bytes, const std::string& sentence) {
    CHECK_THROWS_WITH(parseStl(bytes, "a.stl"), Catch::Contains(sentence));
  };
  says("", "a.stl: byte 0: the file ends");
  says("PK\x03\x04", "a.stl: byte 4: the file ends");
  says(binaryStl(square()).substr(0, 100), "a.stl: byte 80: found 2 triangles in a file of 100 bytes");
  says("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n",
       "a.stl:4: found 'x', but a finite number is due");
  says("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n",
       "a.stl:4: found 'nan', but a finite number is due");
  says("solid a\nfacet normal 0 0 1\nouter loop\n",
       "a.stl:4: found the end of the file, but 'vertex' is due");
  says("solid a\nfacets\n", "a.stl:2: found 'facets', but 'facet' or 'endsolid' is due");
  says("solid a\nendsolid a\n", "no triangle with three different corners");
  says(textStl(square()) + "solid b\n", "keep one solid in a file");
  std::string infinite = binaryStl(square());
  const float inf = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 50 + 12 + 4, &inf, 4);
  says(infinite, "a.stl: byte 150: found inf, but a finite number is due (corner 1 of triangle 2)");
  CHECK_THROWS_WITH(meshWall(square(), {{"closed", true}}), Catch::Contains("not closed: 4 of its 5 edges"));
  CHECK_THROWS_WITH(makeWall("mesh", {}), Catch::Contains("no triangles"));
  CHECK_THROWS_WITH(makeWall("mesh", {{"points", std::vector<Vec3>{Vec3::Zero()}},
                                      {"corners", std::vector<double>{0, 0, 1}}}),
                    Catch::Contains("corner 3 is 1"));
}

TEST_CASE("no garbage crashes the reader of STL: a mesh or a sentence comes back") {
  const std::string whole[] = {textStl(boxMesh({0, 0, 0}, {1, 2, 0.5})),
                               binaryStl(boxMesh({0, 0, 0}, {1, 2, 0.5}))};
  int read = 0, refused = 0;
  for (int k = 0; k < 20000; ++k) {
    RandomStream random(9, RandomPurpose::test, k);
    std::string bytes = whole[k % 2];
    const auto place = [&] {
      return static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes.size()));
    };
    if (k % 3 == 0) bytes.resize(place());
    for (int change = k % 7; change > 0 && !bytes.empty(); --change)
      bytes[place()] = static_cast<char>(256 * random.uniform());
    if (k % 5 == 0) bytes.insert(place(), std::string(3, static_cast<char>(256 * random.uniform())));
    try {
      const TriangleMesh mesh = parseStl(bytes, "fuzz.stl");
      for (const auto& t : mesh.triangles)
        for (const int c : t)
          if (c < 0 || static_cast<std::size_t>(c) >= mesh.points.size()) FAIL("a corner names no point");
      ++read;
    } catch (const InputError& error) {
      if (std::string(error.what()).find("fuzz.stl") != 0) FAIL(error.what());
      ++refused;
    }
  }
  CHECK(read > 1000);
  CHECK(refused > 10000);
}

TEST_CASE(
    "a ball that plugs a funnel of facets is held from all sides, and refused where there are too many") {
  const auto funnel = [](int facets, double smoothAngle) {
    std::string points, corners;
    for (const double z : {0.0, 10.0})
      for (int k = 0; k < facets; ++k) {
        const double angle = 2 * std::numbers::pi * k / facets, r = 1 + 0.9 * z;
        points += fmt::format("[\"{:.15g} mm\", \"{:.15g} mm\", \"{} mm\"],", r * std::cos(angle),
                              r * std::sin(angle), z);
      }
    for (int k = 0; k < facets; ++k) {
      const int next = (k + 1) % facets;
      corners += fmt::format("{},{},{},{},{},{},", k, next, facets + next, k, facets + next, facets + k);
    }
    SceneText t;
    t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.5 })";
    t.walls = fmt::format("[[wall]]\nname = \"funnel\"\nkind = \"mesh\"\nmaterial = \"wall\"\npoints = [{}]\n"
                          "corners = [{}]\nsmooth_angle = \"{} deg\"\n",
                          points, corners, smoothAngle);
    std::string text = t.text();
    text.replace(text.find("[\"2 mm\", \"2 mm\", \"2 mm\"]"), 24, "[\"0\", \"0\", \"50 mm\"]");
    return parseScene(text, "funnel");
  };
  for (const int facets : {6, 8, 13, 24, 48}) { // of 48, every second is told apart from its neighbours
    CAPTURE(facets);
    DemSolver solver(funnel(facets, 10), {1});
    solver.add({grain(0, {0, 0, 5e-3}, Vec3::Zero(), Vec3::Zero(), 3e-3)});
    solver.advance(static_cast<std::int64_t>(0.3 / solver.stepSize()));
    const GrainSeed ball = solver.present()[0];
    const double weight = 4.0 / 3.0 * std::numbers::pi * 27e-9 * 2500 * 9.81;
    CHECK(ball.velocity.norm() < 1e-6);
    CHECK(std::hypot(ball.position.x(), ball.position.y()) < 1e-6);
    CHECK(solver.walls()[0].force.z() == Approx(-weight).epsilon(1e-3));
  }
  DemSolver crowded(funnel(48, 0), {1});
  crowded.add({grain(0, {0, 0, 5e-3}, Vec3::Zero(), Vec3::Zero(), 3e-3)});
  CHECK_THROWS_WITH(crowded.advance(100000),
                    Catch::Contains("grain 0 touches the wall 'funnel' in more than 32 places"));
}
