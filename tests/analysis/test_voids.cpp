// Holes of lattices, one sphere in a box, random points, unequal spheres.

#include "analysis/containing_sizes.h"
#include "analysis/registry.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

Results voids(const Frame& frame, const std::map<std::string, std::string>& set = {}) {
  const AnalysisKind& kind = analysisKind("voids");
  Parameters knobs = defaultKnobs(kind);
  for (const auto& [name, value] : set)
    setKnob(knobs, kind, name, value);
  return analyze(kind, knobs, {}, {std::make_shared<Frame>(frame)});
}

const Curve& named(const Results& r, const std::string& name) {
  for (const auto& c : r.curves)
    if (c.name == name) return c;
  throw std::runtime_error("no curve " + name);
}

std::vector<EmptySphere> holesOf(const Frame& frame) {
  RegionOptions options;
  const Region region(frame, options);
  const SurfaceDistance distance(frame, 1, 3);
  return holes(frame, cellsForVoids(frame, {}, 1), distance, region, {}, 1);
}

} // namespace

TEST_CASE("holes of lattices", "[voids]") {
  // In units of the radius: sc sqrt(3) - 1; fcc octahedral sqrt(2) - 1 and twice as many tetrahedral
  // sqrt(3/2) - 1; bcc sqrt(5/3) - 1. One sc hole, one octahedral hole and six bcc holes a grain.
  const double r = 0.5;
  const auto sc = holesOf(simpleCubicFrame());
  REQUIRE(sc.size() == 64);
  CHECK(sc.front().radius == Approx(r * (std::sqrt(3.0) - 1)).epsilon(1e-10));
  const auto bcc = holesOf(bodyCentredFrame());
  REQUIRE(bcc.size() == 6 * 128);
  CHECK(bcc.front().radius == Approx(r * (std::sqrt(5.0 / 3) - 1)).epsilon(1e-10));
  CHECK(bcc.back().radius == Approx(r * (std::sqrt(5.0 / 3) - 1)).epsilon(1e-10));
  const auto fcc = holesOf(faceCentredFrame());
  REQUIRE(fcc.size() == 3 * 256);
  CHECK(fcc[0].radius == Approx(r * (std::sqrt(2.0) - 1)).epsilon(1e-10));
  CHECK(fcc[255].radius == Approx(r * (std::sqrt(2.0) - 1)).epsilon(1e-10));
  CHECK(fcc[256].radius == Approx(r * (std::sqrt(1.5) - 1)).epsilon(1e-10));
  CHECK(fcc.back().radius == Approx(r * (std::sqrt(1.5) - 1)).epsilon(1e-10));
}

TEST_CASE("the gridded histogram finds the lattice's holes within a grid step", "[voids]") {
  const auto [frame, largest] = GENERATE(table<Frame, double>(
      {{simpleCubicFrame(), 0.3660254}, {faceCentredFrame(), 0.2071068}})); // in diameters
  const Results r = voids(frame, {{"v2", "false"}, {"probes", "1000"}, {"spacing", "0.05"}});
  const double found = named(r, "voids_gridded").numbers.at("bulk_largest");
  CHECK(found <= largest + 1e-6);
  CHECK(found > largest - 0.05);
}

TEST_CASE("one sphere in a box: V1 is known", "[voids]") {
  // Side 2, radius 0.5, in the middle. Points farther than t from all surfaces fill ((2 - 2 t)^3 - 4/3 pi
  // (0.5 + t)^3) where walls count (t < 0.25: the ball stays inside the inner box), or 8 - 4/3 pi (0.5 + t)^3
  // in a periodic box.
  const bool walls = GENERATE(true, false);
  Frame frame = frameOf({Vec3(1, 1, 1)}, Vec3::Constant(2), {!walls, !walls, !walls}, 0.5);
  if (walls) frame.walls = {sceneWall("box", {{"lower", Vec3(0, 0, 0)}, {"upper", Vec3(2, 2, 2)}})};
  RegionOptions options;
  const Region region(frame, options);
  const SurfaceDistance distance(frame, 1, 3);
  const VoidPoints points = voidPoints(distance, region, 200000, 0, 1);
  const auto ball = [](double r) { return 4.0 / 3 * std::numbers::pi * r * r * r; };
  CHECK(points.tried == 200000);
  CHECK(static_cast<double>(points.point.size()) / 200000 == Approx(1 - ball(0.5) / 8).margin(0.001));
  for (const double t : {0.05, 0.1, 0.15, 0.2}) {
    const double exact = walls ? (std::pow(2 - 2 * t, 3) - ball(0.5 + t)) / (8 - ball(0.5))
                               : (8 - ball(0.5 + t)) / (8 - ball(0.5));
    const auto beyond =
        std::count_if(points.distance.begin(), points.distance.end(), [&](double x) { return x > t; });
    // 186000 independent points would have a standard error of 0.0012; evenly spread ones have less.
    CHECK(static_cast<double>(beyond) / static_cast<double>(points.point.size()) ==
          Approx(exact).margin(0.004));
  }
}

TEST_CASE("random points: the share of holes above r is exp(-4 pi rho r^3 / 3)", "[voids]") {
  // Points are spheres of next to no radius here: nearest-neighbour distances of a Poisson process, periodic.
  const std::size_t n = 5000;
  const Frame frame = uniformFrame(n, Vec3::Ones(), {true, true, true}, 1e-9, {}, 4);
  const Region region(frame, {});
  const SurfaceDistance distance(frame, 0.05, 0.3);
  const VoidPoints points = voidPoints(distance, region, 50000, 0, 1);
  for (const double r : {0.02, 0.03, 0.04, 0.05}) {
    const double exact = std::exp(-4.0 / 3 * std::numbers::pi * static_cast<double>(n) * r * r * r);
    const auto beyond =
        std::count_if(points.distance.begin(), points.distance.end(), [&](double x) { return x > r; });
    // The field of one sample of n points: its void share scatters by about sqrt(exact / n) at these r.
    CHECK(static_cast<double>(beyond) / 50000 ==
          Approx(exact).margin(5 * std::sqrt(exact / static_cast<double>(n))));
  }
}

TEST_CASE("V2 of a simple cubic lattice against a brute force", "[voids]") {
  // For each point the largest empty sphere that contains it, by trying all centres of a fine grid: both are
  // lower bounds of one number.
  const Frame frame = simpleCubicFrame(3);
  const Region region(frame, {});
  const SurfaceDistance distance(frame, 1, 3);
  VoidPoints points = voidPoints(distance, region, 160, 0, 3);
  const VoronoiCells cells = cellsForVoids(frame, {}, 1);
  const auto found = holes(frame, cells, distance, region, points, 1);
  const auto own = points.distance;
  points.distance = climbedSizes(distance, region, points, 1);
  const auto v2 = containingSizes(frame, cells, distance, region, found, points, 7, 1);
  std::size_t tooSmall = 0;
  double difference = 0;
  for (std::size_t k = 0; k < points.point.size(); ++k) {
    double brute = own[k];
    for (double a = -0.5; a <= 0.5; a += 0.02)
      for (double b = -0.5; b <= 0.5; b += 0.02)
        for (double c = -0.5; c <= 0.5; c += 0.02) {
          const double r = distance(points.point[k] + Vec3(a, b, c));
          if (r > brute && Vec3(a, b, c).norm() <= r) brute = r;
        }
    tooSmall += v2[k] < brute - 0.005;
    difference += (v2[k] - brute) / static_cast<double>(points.point.size());
  }
  CHECK(tooSmall <= 1); // a climb may end on a lower top
  CHECK(difference > 0);
  CHECK(difference < 0.015); // half a grid step: the brute force itself is short by so much
}

TEST_CASE("unequal spheres: maximal spheres by climbing, holes at walls apart", "[voids]") {
  // Caesium chloride with a small middle grain: the largest holes of the cell (1/2, 1/4, 0) have radius
  // sqrt(5)/4 a - R of bcc only for equal grains; here a climb from any void point ends in an empty sphere
  // that no step enlarges. The faces' middles (1/2, 1/2, 0) between four large grains lie sqrt(1/2) - 0.5
  // from them and 0.5 - 0.2 from the small ones above and below.
  Frame frame = crystal(Vec3::Ones(), {Vec3::Zero(), Vec3::Constant(0.5)}, {3, 3, 3});
  for (std::size_t i = 1; i < frame.size(); i += 2)
    frame.scalars[quantity::radius][i] = 0.2;
  const SurfaceDistance distance(frame, 1, 3);
  CHECK_FALSE(distance.equalGrains());
  const EmptySphere s = climb(distance, Region(frame, {}), Vec3(0.45, 0.55, 0.03), 0.1, 1e-5);
  CHECK(s.radius >= std::sqrt(0.5) - 0.5 - 1e-6);
  // A corner of a box without grains near: the largest sphere about it is limited by walls.
  Frame boxed = frameOf({Vec3(1, 1, 1)}, Vec3::Constant(2), {false, false, false}, 0.5);
  boxed.walls = {sceneWall("box", {{"lower", Vec3(0, 0, 0)}, {"upper", Vec3(2, 2, 2)}})};
  const SurfaceDistance inBox(boxed, 1, 3);
  const EmptySphere corner = climb(inBox, Region(boxed, {}), Vec3(0.2, 0.25, 0.2), 0.1, 1e-6);
  // On the diagonal: t = sqrt(3) (1 - t) - 0.5, t = (sqrt(3) - 0.5) / (1 + sqrt(3)).
  CHECK(corner.atWall);
  CHECK(corner.radius == Approx((std::sqrt(3.0) - 0.5) / (1 + std::sqrt(3.0))).margin(1e-3));
}

TEST_CASE("cavities of a lattice: one about each hole, none for a larger probe", "[voids]") {
  const Frame frame = simpleCubicFrame(3);
  const Region region(frame, {});
  const SurfaceDistance distance(frame, 1, 3);
  const DistanceGrid grid = distanceGrid(distance, region, 0.025);
  // The neck between two sc holes is sqrt(1/2) - 1/2 = 0.2071 wide: above it 27 cavities, below it one.
  CHECK(cavities(grid, 0.25, 1).volumes.size() == 27);
  CHECK(cavities(grid, 0.19, 1).volumes.size() == 1);
  CHECK(cavities(grid, 0.37, 1).volumes.empty());
}

TEST_CASE("porosity of a crystal, and the report", "[voids]") {
  const Results r = voids(faceCentredFrame(), {{"probes", "20000"}, {"spacing", "0.1"}});
  CHECK(named(r, "voids_v1").numbers.at("porosity") ==
        Approx(1 - std::numbers::pi / std::sqrt(18)).margin(0.005));
  CHECK(named(r, "voids_v2").numbers.at("sampling_error") < 0.005);
  CHECK(r.balls.front().balls.size() == 100);
  CHECK(r.balls.front().balls.front().radius == Approx(0.5 * (std::sqrt(2.0) - 1)).epsilon(1e-9));
  for (const char* name : {"voids_v1", "voids_v2", "voids_v3"})
    CHECK(named(r, name).definition.substr(0, 2) == std::string("V") + name[7]);
}
