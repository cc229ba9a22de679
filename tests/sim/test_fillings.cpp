#include "sim/base/error.h"
#include "sim/grains/seeding.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

using namespace sandglass;

namespace {

/// A box of 2 cm with two species, periodic as asked; `rest` brings the filling.
Scene boxScene(const std::string& periodic, const std::string& rest,
               const std::string& upper = R"(["2 cm", "2 cm", "2 cm"])") {
  return parseScene(R"(
[domain]
lower = ["0", "0", "0"]
upper = )" + upper +
                        "\nperiodic = " + periodic +
                        R"(
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[contact]]
between = ["glass", "glass"]
normal = { law = "linear", collision_time = "1 ms", restitution = 0.9 }
[[species]]
name = "bead"
material = "glass"
size = { distribution = "single", diameter = "2 mm" }
[[species]]
name = "mixed"
material = "glass"
size = { distribution = "uniform", smallest = "0.8 mm", largest = "1.6 mm" }
[[stage]]
name = "run"
until = { duration = "1 s" }
)" + rest,
                    "box.toml", {}, SANDGLASS_SOURCE_DIR "/tests/sim/broken_scenes");
}

/// Deepest overlap of any two spheres over all images within one period [m]; negative: the smallest gap.
double deepestOverlap(const Scene& scene, const std::vector<GrainSeed>& grains) {
  const Vec3 length = scene.domain.upper - scene.domain.lower;
  double deepest = -1;
  const auto images = [&](int k) { return scene.domain.periodic[static_cast<std::size_t>(k)] ? 1 : 0; };
  for (std::size_t i = 0; i < grains.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j)
      for (int x = -images(0); x <= images(0); ++x)
        for (int y = -images(1); y <= images(1); ++y)
          for (int z = -images(2); z <= images(2); ++z) {
            if (i == j && x == 0 && y == 0 && z == 0) continue;
            const Vec3 apart = grains[i].position - grains[j].position + Vec3(x, y, z).cwiseProduct(length);
            deepest = std::max(deepest, grains[i].radius + grains[j].radius - apart.norm());
          }
  return deepest;
}

} // namespace

TEST_CASE("random fillings have no overlap, periodic images and walls included", "[filling]") {
  const std::string fill = R"(
[[fill]]
kind = "random"
number = 600
mixture = [{ species = "bead", fraction = 0.2 }, { species = "mixed", fraction = 0.8 }]
)";
  for (const char* periodic : {"[]", R"(["z"])", R"(["x", "y", "z"])"}) {
    INFO(periodic);
    const Scene scene = boxScene(periodic, fill);
    const auto grains = placeGrains(scene, "run", 100, {});
    REQUIRE(grains.size() == 600);
    CHECK(deepestOverlap(scene, grains) <= 0);
    for (std::size_t i = 0; i < grains.size(); ++i) {
      CHECK(grains[i].id == 100 + static_cast<std::int64_t>(i));
      for (int k = 0; k < 3; ++k) { // whole inside, except across periodic sides
        const double margin = scene.domain.periodic[static_cast<std::size_t>(k)] ? 0 : grains[i].radius;
        CHECK(grains[i].position[k] >= margin);
        CHECK(grains[i].position[k] <= 0.02 - margin);
      }
    }
  }
}

TEST_CASE("random fillings work in a domain 2.5 diameters deep", "[filling]") {
  const Scene scene = boxScene(R"(["z"])", R"(
[[fill]]
kind = "random"
solid_fraction = 0.3
species = "bead"
)",
                               R"(["4 cm", "4 cm", "5 mm"])");
  const auto grains = placeGrains(scene, "run", 0, {});
  // 0.3 of 8 cm^3 in spheres of pi/6 (2 mm)^3.
  CHECK(grains.size() == 573);
  CHECK(deepestOverlap(scene, grains) <= 0);
}

TEST_CASE("fillings keep clear of walls and of the grains already there", "[filling]") {
  const Scene scene = boxScene("[]", R"(
[[wall]]
name = "cone"
kind = "cone"
material = "glass"
apex = ["1 cm", "1 cm", "0"]
half_angle = "30 deg"
height = "2 cm"
[[fill]]
kind = "random"
number = 150
species = "mixed"
)");
  const std::vector<GrainSeed> present{
      {.id = 0, .species = 0, .radius = 4e-3, .position = Vec3(0.01, 0.01, 0.012)}};
  auto grains = placeGrains(scene, "run", 1, present);
  for (const auto& g : grains) {
    const Vec3 p = g.position - Vec3(0.01, 0.01, 0);
    const double distance =
        p.z() * 0.5 - std::hypot(p.x(), p.y()) * std::sqrt(0.75); // to a cone of 30 degrees
    CHECK(distance >= g.radius * (1 - 1e-12));
  }
  grains.push_back(present.front());
  CHECK(deepestOverlap(scene, grains) <= 0);
}

TEST_CASE("a filling of the interior lies inside a closed box, corners of the domain left out", "[filling]") {
  const Scene scene = boxScene("[]", R"(
[[wall]]
name = "box"
kind = "box"
material = "glass"
lower = ["0.5 cm", "0.5 cm", "0.5 cm"]
upper = ["1.5 cm", "1.5 cm", "1.5 cm"]
[[fill]]
kind = "random"
number = 20
species = "bead"
)");
  const auto grains = placeGrains(scene, "run", 1, {});
  REQUIRE(grains.size() == 20);
  for (const GrainSeed& g : grains)
    for (int k = 0; k < 3; ++k) {
      CHECK(g.position[k] - g.radius >= 0.005);
      CHECK(g.position[k] + g.radius <= 0.015);
    }
}

TEST_CASE("fillings depend on the seed alone", "[filling]") {
  const std::string fill = R"(
[[fill]]
kind = "random"
number = 200
species = "mixed"
velocity = ["0", "0", "-1 m/s"]
velocity_spread = ["0.1 m/s", "0", "0"]
spin_spread = "2 rad/s"
)";
  Scene scene = boxScene("[]", fill);
  const auto first = placeGrains(scene, "run", 0, {}), again = placeGrains(scene, "run", 0, {});
  scene.seed = 2;
  const auto other = placeGrains(scene, "run", 0, {});
  double fastest = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].position == again[i].position);
    CHECK(first[i].position != other[i].position);
    CHECK(first[i].velocity.z() == -1);
    CHECK(std::abs(first[i].velocity.x()) <= 0.1);
    fastest = std::max(fastest, std::abs(first[i].velocity.x()));
    CHECK(first[i].spin.cwiseAbs().maxCoeff() <= 2);
  }
  CHECK(fastest > 0.09); // missed by 200 draws with probability 0.9^200 = 7e-10
}

TEST_CASE("a filling that cannot fit says how far it came", "[filling]") {
  // 0.37 of the space where centres may be; the solid fraction of the box as a whole allows the attempt.
  const Scene scene = boxScene("[]", R"(
[[fill]]
kind = "random"
number = 690
species = "bead"
)");
  CHECK_THROWS_WITH(placeGrains(scene, "run", 0, {}),
                    Catch::StartsWith("box.toml: fill.1 found room for ") &&
                        Catch::Contains(" of 690 grains, a solid fraction of 0."));
}

TEST_CASE("shares of a mixture are exact", "[filling]") {
  const auto counts = [](const std::string& by) {
    const Scene scene = boxScene("[]", R"(
[[fill]]
kind = "random"
number = 300
mixture = [{ species = "bead", fraction = 0.5 }, { species = "mixed", fraction = 0.5 }]
by = ")" + by + "\"\n");
    std::array<int, 2> count{};
    for (const auto& g : placeGrains(scene, "run", 0, {}))
      ++count[static_cast<std::size_t>(g.species)];
    return count;
  };
  CHECK(counts("number") == std::array<int, 2>{150, 150});
  // Mean cubes 8 and (1.6^4 - 0.8^4)/(4 * 0.8) = 1.92 mm^3: numbers as 1/8 : 1/1.92, 58.06 and 241.94 of 300.
  CHECK(counts("mass") == std::array<int, 2>{58, 242});
}

TEST_CASE("a filling by mass brings that mass", "[filling]") {
  const Scene scene = boxScene("[]", R"(
[[fill]]
kind = "random"
mass = "3 g"
species = "mixed"
)");
  double mass = 0, squares = 0;
  const auto grains = placeGrains(scene, "run", 0, {});
  for (const auto& g : grains) {
    const double m = 2500 * 4 * std::numbers::pi / 3 * std::pow(g.radius, 3);
    mass += m;
    squares += m * m;
  }
  // The number is 3 g over the mean mass; the sum strays by the spread of single masses: five deviations.
  const double n = static_cast<double>(grains.size()), deviation = std::sqrt(squares - mass * mass / n);
  CHECK(std::abs(mass - 3e-3) < 5 * deviation);
  CHECK(expectedGrains(scene) == static_cast<std::int64_t>(grains.size()));
}

TEST_CASE("lattices have the right numbers and neighbours", "[filling]") {
  struct Case {
    const char *structure, *upper;
    std::size_t count;
    int neighbours;
  };
  // Boxes of whole cells, periodic: fcc cell sqrt(2) s with 4, hcp cell s, sqrt(3) s, sqrt(8/3) s with 4; s =
  // 2 mm.
  const Case cases[] = {
      {"sc", R"(["10 mm", "10 mm", "10 mm"])", 125, 6},
      {"fcc", R"(["8.485281374238571 mm", "8.485281374238571 mm", "8.485281374238571 mm"])", 108, 12},
      {"hcp", R"(["8 mm", "10.392304845413264 mm", "9.797958971132712 mm"])", 4 * 3 * 3 * 4, 12},
  };
  for (const auto& c : cases) {
    INFO(c.structure);
    const Scene scene = boxScene(R"(["x", "y", "z"])",
                                 R"(
[[fill]]
kind = "lattice"
spacing = "2 mm"
lower = ["0", "0", "0"]
upper = )" + std::string(c.upper) + "\nspecies = \"bead\"\nstructure = \"" +
                                     c.structure + "\"\n",
                                 c.upper);
    const auto grains = placeGrains(scene, "run", 0, {});
    CHECK(grains.size() == c.count);
    CHECK(std::abs(deepestOverlap(scene, grains)) < 1e-12); // neighbours just touch
    const Vec3 length = scene.domain.upper;
    for (const auto& a : grains) {
      int neighbours = 0;
      for (const auto& b : grains) {
        Vec3 apart =
            a.position - b.position; // more than two spacings deep: the nearest image is the only one
        for (int k = 0; k < 3; ++k)
          apart[k] -= length[k] * std::round(apart[k] / length[k]);
        if (apart.norm() > 1e-6 && apart.norm() < 2.0001e-3) ++neighbours;
      }
      REQUIRE(neighbours == c.neighbours);
    }
  }
}

TEST_CASE("a lattice that is too tight is refused", "[filling]") {
  CHECK_THROWS_WITH(boxScene("[]", R"(
[[fill]]
kind = "lattice"
structure = "sc"
spacing = "1.9 mm"
lower = ["2 mm", "2 mm", "2 mm"]
upper = ["1 cm", "1 cm", "1 cm"]
species = "bead"
)"),
                    Catch::Contains("box.toml:24: fill.1 makes grains overlap"));
}

TEST_CASE("rain brings grains at its rate, and late ones when there is room", "[filling]") {
  const Scene scene = boxScene("[]", R"(
[[fill]]
kind = "rain"
lower = ["0", "0", "1 cm"]
upper = ["2 cm", "2 cm", "2 cm"]
rate = "100 1/s"
number = 50
mixture = [{ species = "bead", fraction = 0.5 }, { species = "mixed", fraction = 0.5 }]
)");
  const auto yes = [](const Vec3&, double) { return true; };
  const auto no = [](const Vec3&, double) { return false; };
  const auto rain = makeRain(scene, "run");
  REQUIRE(rain);
  CHECK(rain->due(0, 0, yes).empty());
  const auto first = rain->due(0.105, 0, yes);
  CHECK(first.size() == 10);
  CHECK(deepestOverlap(scene, first) <= 0);
  CHECK(rain->due(0.2, 10, no).empty()); // no room: none
  const auto state = rain->state();
  const auto late = rain->due(0.25, 10, yes);
  CHECK(late.size() == 15); // those of before and those of now
  CHECK_FALSE(rain->finished());
  const auto rest = rain->due(100, 25, yes);
  CHECK(rest.size() == 25);
  CHECK(rain->finished());

  // From a saved state the same grains come again.
  const auto copy = makeRain(scene, "run");
  copy->setState(state);
  const auto again = copy->due(0.25, 10, yes);
  REQUIRE(again.size() == late.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    CHECK(again[i].position == late[i].position);
    CHECK(again[i].radius == late[i].radius);
  }
  CHECK(makeRain(boxScene("[]", "[[fill]]\nkind = \"random\"\nnumber = 1\nspecies = \"bead\"\n"), "run") ==
        nullptr);
}

TEST_CASE("size ranges give the moments of a species", "[filling]") {
  const Scene scene = boxScene("[]", "[[fill]]\nkind = \"random\"\nnumber = 1\nspecies = \"bead\"\n");
  const SizeRange range = sizeRange(scene, scene.speciesNamed("mixed"));
  CHECK(range.smallest == 0.8e-3);
  CHECK(range.largest == 1.6e-3);
  CHECK(range.meanDiameter == Approx(1.2e-3));
  CHECK(range.meanMass == Approx(2500 * std::numbers::pi / 6 * 1.92e-9));
}

TEST_CASE("wide flat domains take no undue memory", "[filling]") {
  // 100 m by 100 m by 5 mm: a billion cells of one diameter would take 4 GB.
  const Scene scene =
      boxScene(R"(["x", "y"])", "[[fill]]\nkind = \"random\"\nnumber = 1000\nspecies = \"bead\"\n",
               R"(["100 m", "100 m", "5 mm"])");
  CHECK(deepestOverlap(scene, placeGrains(scene, "run", 0, {})) <= 0);
}

TEST_CASE("listed grains may stick into walls that they can leave, not into a gap too narrow", "[filling]") {
  struct Plane {
    Vec3 point, normal;
  };
  const auto place = [](const std::vector<Plane>& planes, const Vec3& at) {
    std::string parts = fmt::format("[[fill]]\nkind = \"list\"\ngrains = [{{ species = \"bead\", position = "
                                    "[\"{} m\", \"{} m\", \"{} m\"] }}]\n",
                                    at.x(), at.y(), at.z());
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const auto& [p, n] = planes[i];
      parts +=
          fmt::format("[[wall]]\nname = \"{}\"\nkind = \"plane\"\nmaterial = \"glass\"\npoint = [\"{} m\", "
                      "\"{} m\", \"{} m\"]\nnormal = [{}, {}, {}]\n",
                      i, p.x(), p.y(), p.z(), n.x(), n.y(), n.z());
    }
    return placeGrains(boxScene("[]", parts), "run", 0, {}).size();
  };
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), zero(0, 0, 0), middle(0.01, 0.01, 0.01);
  const auto narrow = Catch::Contains("too narrow for; move it, make it smaller or widen the space");
  // Grains of 2 mm, 0.1 mm deep in a floor, and in a corner of two walls and of three.
  const double deep = 0.9e-3;
  CHECK(place({{zero, z}}, {0.01, 0.01, deep}) == 1);
  CHECK(place({{zero, z}, {zero, x}}, {deep, 0.01, deep}) == 1);
  CHECK(place({{zero, z}, {zero, x}, {zero, y}}, {deep, deep, deep}) == 1);
  for (const double degrees : {1.0, 6.0, 30.0}) { // half the angle of a wedge
    const double s = std::sin(degrees * std::numbers::pi / 180), c = std::sqrt(1 - s * s);
    const Vec3 foot = middle - deep / s * z;
    CHECK(place({{foot, c * x + s * z}, {foot, -c * x + s * z}}, middle) == 1);
  }
  // Slots of 1.9 mm and of 1.992 mm; the grain 0.05 mm off the middle.
  CHECK_THROWS_WITH(place({{middle - 0.9e-3 * x, x}, {middle + 1e-3 * x, -x}}, middle), narrow);
  CHECK(place({{middle - 0.942e-3 * x, x}, {middle + 1.05e-3 * x, -x}}, middle) == 1);
  // A prism of three sides 0.9 mm from its axis.
  const Vec3 left(-0.5, std::sqrt(0.75), 0), right(-0.5, -std::sqrt(0.75), 0);
  CHECK_THROWS_WITH(
      place({{middle - deep * x, x}, {middle - deep * left, left}, {middle - deep * right, right}}, middle),
      narrow);
}

TEST_CASE("listed grains come from a CSV file with any units", "[filling]") {
  const Scene scene = boxScene("[]", "[[fill]]\nkind = \"list\"\ncsv = \"sound.csv\"\n");
  const auto grains = placeGrains(scene, "run", 5, {});
  REQUIRE(grains.size() == 2);
  CHECK(grains[0].id == 5);
  CHECK(grains[0].position == Vec3(0.01, 0.011, 0.012));
  CHECK(grains[0].velocity == Vec3(0.01, 0, -0.02));
  CHECK(grains[0].spin.y() == Approx(2 * std::numbers::pi).epsilon(1e-14));
  CHECK(grains[0].radius == 1e-3); // an empty diameter: that of its species
  CHECK(grains[1].radius == 0.75e-3);
  CHECK(grains[1].species == 1);
  // The resolved scene holds the grains itself.
  CHECK(writeScene(scene).find("sound.csv") == std::string::npos);
  CHECK(parseScene(writeScene(scene), "box.toml") == scene);
}
