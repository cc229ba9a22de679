// Mixed precision: what it resolves, how far it is from double, and what it refuses.

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

const std::string linear = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.8 })",
                  spring = R"({ law = "spring", friction = 0.4, damping_ratio = 0.3 })",
                  floorText =
                      "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0\", "
                      "\"0\", \"0\"]\nnormal = [0, 0, 1]\n";

SceneText text(bool mixed) {
  SceneText t;
  t.normal = linear;
  t.tangential = spring;
  t.stepsPerContact = 50;
  t.accuracy = mixed ? "precision = \"mixed\"\n" : "";
  return t;
}

/// 300 grains of 2 mm fall on a floor, in a periodic box.
SceneText bedText(bool mixed) {
  SceneText t = text(mixed);
  t.gravity = R"(["0.5 m/s^2", "0", "-9.81 m/s^2"])";
  t.lower = R"(["0", "0", "-1 mm"])";
  t.upper = R"(["13 mm", "13 mm", "0.1 m"])";
  t.periodic = R"(["x", "y"])";
  t.walls = floorText;
  return t;
}

std::vector<GrainSeed> layers(int count) {
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < count; ++k) {
    RandomStream random(5, RandomPurpose::test, k);
    const Vec3 place(1e-3 + 2.15e-3 * (k % 6), 1e-3 + 2.15e-3 * (k / 6 % 6), 1.2e-3 + 2.15e-3 * (k / 36));
    seeds.push_back(grain(k, place + 0.05e-3 * random.direction(), 0.3 * random.direction()));
  }
  return seeds;
}

} // namespace

TEST_CASE("mixed precision resolves 1e-6 of a diameter at 10,000 diameters from the origin") {
  // An oblique impact of two grains, at the origin in double and 10,000 diameters away in mixed precision.
  const auto impact = [](bool mixed, const Vec3& at) {
    SceneText t = text(mixed);
    t.lower = R"(["-21 m", "-21 m", "-21 m"])";
    t.upper = R"(["21 m", "21 m", "21 m"])";
    DemSolver solver(t.scene(), {1});
    solver.add(
        {grain(0, at), grain(1, at + Vec3(2.05e-3, 0.4e-3, 0.3e-3), Vec3(-0.2, 0.05, 0), Vec3(0, 30, 50))});
    solver.advance(static_cast<int>(4e-3 / solver.stepSize()));
    auto after = solver.present();
    for (GrainSeed& g : after)
      g.position -= at;
    return after;
  };
  const auto expected = impact(false, Vec3::Zero());
  const Vec3 turned = expected[1].velocity - Vec3(-0.2, 0.05, 0);
  REQUIRE(turned.norm() > 0.1); // they have met
  for (const Vec3& at : {Vec3(20.0, 20.0, 20.0), Vec3(-20.0, 19.3, -17.7)}) {
    const auto found = impact(true, at);
    for (int i : {0, 1}) {
      // Beside mixed precision, doubles at 20 m end at 4e-15 m, 2e-12 of a diameter.
      CHECK((found[i].position - expected[i].position).norm() < 1e-6 * 2e-3);
      CHECK((found[i].velocity - expected[i].velocity).norm() < 1e-6);
    }
  }
}

TEST_CASE("a step of a bed in mixed precision is off by 2e-9 of a diameter in overlap and 1e-7 in the laws") {
  // An overlap off by half a unit each way, 1e-9 of 2 mm rounded up to 3.9 mm along three axes, changes the
  // force by 1000 N/m * 7e-12 m = 7e-9 N; velocities of 0.3 m/s, known to 6e-8, change that of the dashpot
  // (0.03 N s/m or less) by as little. A grain of 1e-5 kg gets 7e-4 m/s^2 from a contact, and has up to six.
  DemSolver exact(bedText(false).scene(), {1});
  exact.add(layers(300));
  exact.advance(4000);
  const auto start = exact.present();
  const auto after = [&](bool mixed) {
    DemSolver solver(bedText(mixed).scene(), {1});
    solver.add(start);
    solver.advance(1);
    return solver.present();
  };
  const auto expected = after(false), found = after(true);
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
    worst = std::max(worst, (found[i].velocity - expected[i].velocity).norm() / exact.stepSize());
  CAPTURE(worst);
  CHECK(worst < 6 * 7e-4);
  CHECK(worst > 0.0);
}

TEST_CASE("a bed in mixed precision comes to rest as in double") {
  // Single grains part ways (chaos); the bed as a whole does not. Heights of two beds that differ in
  // rounding alone, at the end: by some hundredths of a diameter.
  const auto settled = [](bool mixed) {
    DemSolver solver(bedText(mixed).scene(), {1});
    solver.add(layers(300));
    solver.setDrag(5.0); // moves grains beside the kernel
    solver.advance(static_cast<int>(0.4 / solver.stepSize()));
    double height = 0.0;
    for (const GrainSeed& g : solver.present())
      height += g.position.z() / 300.0;
    return std::pair{height, solver.energies().elastic};
  };
  const auto [expectedHeight, expectedElastic] = settled(false);
  const auto [height, elastic] = settled(true);
  CHECK(height == Approx(expectedHeight).margin(0.05 * 2e-3));
  CHECK(elastic == Approx(expectedElastic).epsilon(0.2));
}

TEST_CASE("whatever moves grains beside the kernel, mixed precision sees it") {
  // A few steps only, before chaos: mixed and double stay together to 1e-6 of a diameter.
  const auto moved = [](bool mixed, bool drag, bool gravity) {
    DemSolver solver(bedText(mixed).scene(), {1});
    solver.add(layers(300));
    solver.advance(150);
    if (drag) solver.setDrag(200.0);
    if (gravity) solver.setGravity(Vec3(0, 3000.0, 0));
    solver.advance(60);
    solver.add({grain(1000, Vec3(6e-3, 6e-3, 40e-3), Vec3(0, 0, -1))});
    solver.advance(40);
    return solver.present();
  };
  for (const auto& [drag, gravity] : {std::pair{true, false}, std::pair{false, true}}) {
    const auto expected = moved(false, drag, gravity), found = moved(true, drag, gravity);
    double worst = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
      worst = std::max(worst, (found[i].position - expected[i].position).norm());
    CHECK(worst < 1e-6 * 2e-3);
    CHECK(worst > 0.0);
  }
}

TEST_CASE("mixed precision refuses what it cannot do") {
  const auto refused = [](const SceneText& t, const std::string& sentence) {
    CHECK_THROWS_WITH(DemSolver(t.scene(), {1}), Catch::Contains(sentence));
  };
  SceneText rolling = text(true);
  rolling.rolling = R"({ law = "elastic_plastic", coefficient = 0.1 })";
  refused(rolling, "(the laws are linear, spring, elastic_plastic)");
  SceneText skin = text(true);
  skin.accuracy += "skin = 0.5\n";
  refused(skin, "needs a skin of at most 0.45, not 0.5");
  SceneText far = text(true);
  far.upper = R"(["1 m", "1 m", "4000 m"])";
  refused(far, "reaches 2.1e+03 m from the origin");
  SceneText dust = text(true);
  dust.species =
      "[[species]]\nname = \"bead\"\nmaterial = \"glass\"\nsize = { distribution = \"single\", diameter = "
      "\"0.5 um\" }\n";
  refused(dust, "for grains of 1 um to 1 km");
  SceneText spread = text(true);
  spread.normal = R"({ law = "hertz", restitution = 0.8 })";
  spread.elasticity = "youngs_modulus = \"20 MPa\"\npoisson_ratio = 0.25";
  spread.species +=
      "[[species]]\nname = \"pea\"\nmaterial = \"glass\"\nsize = { distribution = \"single\", diameter = "
      "\"3 mm\" }\n";
  refused(spread, "(diameters from 0.002 m to 0.003 m)");
}
