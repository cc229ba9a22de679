// Walls that move: exact answers, books that close, bits that do not depend on threads or restarts.

#include "sim/base/random.h"
#include "sim/math/turns.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double mass = 4.0 / 3.0 * pi * 1e-9 * 2500.0; // of a test grain, radius 1 mm

std::string plane(const std::string& motion, const std::string& normal = "[0, 0, 1]") {
  return fmt::format("[[wall]]\nname = \"plate\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", "
                     "\"0 m\", \"0 m\"]\nnormal = {}\nmotion = {}\n",
                     normal, motion);
}

/// A probe makes the solver count collisions and the work of sliding.
std::string probed(const std::string& wall = "plate") {
  return fmt::format(
      "[[probe]]\nname = \"plate\"\nkind = \"wall_force\"\nwall = \"{}\"\ninterval = \"1 s\"\n", wall);
}

} // namespace

TEST_CASE("sine and cosine of turns agree with the library's") {
  for (int k = -4000; k <= 4000; ++k) {
    const double turns = k / 1000.0 + 1e-5;
    const SineCosine sc = sineCosineOfTurns(turns);
    CHECK(std::abs(sc.sine - std::sin(2 * pi * turns)) < 4e-15); // the argument in radians is that coarse
    CHECK(std::abs(sc.cosine - std::cos(2 * pi * turns)) < 4e-15);
  }
  for (int k = -8; k <= 8; ++k) {
    const SineCosine sc = sineCosineOfTurns(0.25 * k);
    CHECK(std::abs(sc.sine) + std::abs(sc.cosine) == 1.0);
  }
}

TEST_CASE("a plate that comes along finds a grain at rest, and throws it off with (1 + e) V") {
  // Nothing but the plate moves, so only its own travel can bring the grain on to the list of those near it.
  for (const double e : {1.0, 0.9}) {
    SceneText t;
    t.normal = fmt::format(R"({{ law = "linear", stiffness = "1000 N/m", restitution = {} }})", e);
    t.stepsPerContact = 400;
    t.walls = plane(R"({ kind = "translate", velocity = ["0", "0", "0.5 m/s"] })") + probed();
    DemSolver solver(t.scene(), {1});
    solver.add({grain(0, {0.01, 0.02, 0.02})});
    const auto steps = static_cast<std::int64_t>(0.05 / solver.stepSize());
    Vec3 impulse = Vec3::Zero();
    for (std::int64_t k = 0; k < steps; ++k) {
      solver.advance(1);
      impulse += solver.stepSize() * solver.walls()[0].force;
    }
    const GrainSeed g = solver.present()[0];
    CHECK(g.velocity.z() == Approx((1.0 + e) * 0.5).epsilon(0.003)); // first order at 400 steps a contact
    CHECK(mass * g.velocity.z() == Approx(-impulse.z()).epsilon(1e-12));
    const FrameWall plate = solver.walls()[0];
    CHECK(plate.collisions == 1);
    CHECK(plate.wearWork == 0.0);
    // The plate's work is V times the momentum that it gave.
    CHECK(plate.work == Approx(0.5 * mass * g.velocity.z()).epsilon(1e-12));
    CHECK(solver.wallWork() == plate.work);
  }
}

TEST_CASE("a grain in a moving box moves as in a box at rest, seen from the box") {
  const auto run = [](bool moving) {
    SceneText t;
    t.tangential = R"({ law = "spring", friction = 0.3, damping_ratio = 0.2 })";
    t.walls = fmt::format(
        "[[wall]]\nname = \"box\"\nkind = \"box\"\nmaterial = \"wall\"\nlower = [\"-1 cm\", "
        "\"-1 cm\", \"-1 cm\"]\nupper = [\"1 cm\", \"1 cm\", \"1 cm\"]\n{}",
        moving ? R"(motion = { kind = "translate", velocity = ["0.1 m/s", "-0.2 m/s", "0.3 m/s"] })" : "");
    auto solver = std::make_unique<DemSolver>(t.scene(), SolverOptions{1});
    const Vec3 frame = moving ? Vec3(0.1, -0.2, 0.3) : Vec3::Zero();
    std::vector<GrainSeed> seeds;
    for (int k = 0; k < 8; ++k) {
      RandomStream random(5, RandomPurpose::test, k);
      seeds.push_back(grain(k, 4e-3 * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1),
                            frame + 0.4 * random.direction(), 100.0 * random.direction()));
    }
    solver->add(seeds);
    return solver;
  };
  auto still = run(false), moving = run(true);
  still->advance(4000);
  moving->advance(4000);
  const double time = still->time();
  REQUIRE(time > 0.015); // a grain at 0.4 m/s meets a side in 0.01 s
  const auto a = still->present(), b = moving->present();
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK((b[i].position - time * Vec3(0.1, -0.2, 0.3) - a[i].position).norm() < 1e-9);
    CHECK((b[i].velocity - Vec3(0.1, -0.2, 0.3) - a[i].velocity).norm() < 1e-6);
    CHECK((b[i].spin - a[i].spin).norm() < 1e-3);
  }
}

TEST_CASE("a sliding plate drags a grain with mu g until the grain rolls on it at 2/7 of its speed") {
  // Slip falls by 7/2 mu g per time: it ends at t = 2 V / (7 mu g), when the centre moves at 2 V / 7.
  constexpr double mu = 0.3, speed = 0.2, g = 9.81;
  SceneText t;
  t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.1 })";
  t.tangential = R"({ law = "spring", friction = 0.3, damping_ratio = 0.5 })";
  t.walls = plane(R"({ kind = "translate", velocity = ["0.2 m/s", "0", "0"] })") + probed();
  DemSolver solver(t.scene(), {1});
  solver.add({grain(0, {0, 0, 1e-3 - mass * g / 1000.0})});
  const double rolls = 2.0 * speed / (7.0 * mu * g);
  solver.advance(static_cast<std::int64_t>(0.5 * rolls / solver.stepSize()));
  // Friction takes as long as the spring needs to reach its limit, some 1 % of this time.
  CHECK(solver.present()[0].velocity.x() == Approx(mu * g * solver.time()).epsilon(0.02));
  const double wear = solver.walls()[0].wearWork;
  solver.advance(static_cast<std::int64_t>(rolls / solver.stepSize()));
  const GrainSeed rolling = solver.present()[0];
  // With the arm a = R - overlap: V = v + a w, and m v a = I w.
  const double arm = 1.0 - mass * g / 1000.0 / 1e-3;
  const double rollingSpeed = speed / (1.0 + 2.5 * arm * arm);
  CHECK(rolling.velocity.x() == Approx(rollingSpeed).epsilon(1e-6));
  CHECK(rolling.spin.y() * 1e-3 * arm == Approx(rollingSpeed - speed).epsilon(1e-6));
  // Work of sliding: mu m g times the way slipped, V t - 7/4 mu g t^2.
  const FrameWall plate = solver.walls()[0];
  CHECK(plate.wearWork == Approx(mu * mass * g * 0.5 * speed * rolls).epsilon(0.01));
  CHECK(wear == Approx(mu * mass * g * speed * rolls * (0.5 - 0.125)).epsilon(0.02));
  // What the plate gave is V times the momentum.
  CHECK(plate.work == Approx(speed * mass * rollingSpeed).epsilon(1e-6));
  CHECK(plate.collisions == 1);
}

TEST_CASE("an oscillating plate throws a grain back by the restitution of their relative velocity") {
  // The collision (34 us) is short beside the period (20 ms): the plate's speed hardly changes in it.
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "100000 N/m", restitution = 0.9 })";
  t.stepsPerContact = 200;
  t.walls = plane(R"({ kind = "oscillate", amplitude = ["0", "0", "1 mm"], frequency = "50 Hz" })");
  DemSolver solver(t.scene(), {1});
  solver.add({grain(0, {0, 0, 4e-3}, {0, 0, -0.5})});
  double before = 0, plate = 0;
  while (solver.present()[0].velocity.z() == -0.5)
    solver.advance(1);
  before = solver.time();
  plate = 2 * pi * 50 * 1e-3 * std::cos(2 * pi * 50 * before);
  CHECK(solver.walls()[0].velocity.z() == Approx(plate).epsilon(1e-9));
  solver.advance(300);
  CHECK(solver.present()[0].velocity.z() == Approx(plate + 0.9 * (0.5 + plate)).epsilon(0.01));
}

TEST_CASE("the books of a shaken, elastic box close: energy gained is the work of the walls") {
  for (
      const char* motion :
      {R"({ kind = "oscillate", amplitude = ["2 mm", "0", "1 mm"], frequency = "60 Hz" })",
       R"({ kind = "rotate", point = ["3 mm", "0", "0"], axis = [1, 2, 3], angular_velocity = "300 rpm" })"}) {
    SceneText t;
    t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1 })";
    t.stepsPerContact = 2000;
    t.walls =
        std::string("[[wall]]\nname = \"box\"\nkind = \"box\"\nmaterial = \"wall\"\nlower = [\"-6 mm\", "
                    "\"-6 mm\", \"-6 mm\"]\nupper = [\"6 mm\", \"6 mm\", \"6 mm\"]\nmotion = ") +
        motion + "\n";
    DemSolver solver(t.scene(), {1});
    std::vector<GrainSeed> seeds;
    for (int k = 0; k < 8; ++k) {
      RandomStream random(6, RandomPurpose::test, k);
      seeds.push_back(
          grain(k, 2e-3 * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1), 0.3 * random.direction()));
    }
    solver.add(seeds);
    const double start = solver.energies().total();
    solver.advance(150000);
    const double gained = solver.energies().total() - start;
    CAPTURE(motion, start, gained, solver.wallWork());
    CHECK(std::abs(gained) > 0.05 * start);
    CHECK(std::abs(gained - solver.wallWork()) < 1e-6 * start);
  }
}

TEST_CASE("a wall turned by a quarter stands where a wall drawn so would stand") {
  SceneText t;
  t.walls =
      "[[wall]]\nname = \"shelf\"\nkind = \"rectangle\"\nmaterial = \"wall\"\ncentre = [\"5 mm\", \"0 m\", "
      "\"0 m\"]\nnormal = [0, 0, 1]\nalong = [1, 0, 0]\nlength = \"10 mm\"\nbreadth = \"4 mm\"\nmotion = { "
      "kind = \"rotate\", point = [\"0 m\", \"0 m\", \"0 m\"], axis = [0, 1, 0], angular_velocity = \"-60 "
      "rpm\", "
      "duration = \"0.25 s\" }\n";
  DemSolver solver(t.scene(), {1});
  solver.advance(static_cast<std::int64_t>(0.26 / solver.stepSize()));
  const FrameWall shelf = solver.walls()[0];
  CHECK(shelf.velocity == Vec3::Zero());
  CHECK(shelf.spin == Vec3::Zero());
  CHECK(shelf.reference == Vec3::Zero());
  CHECK(shelf.shape->bounds().min().isApprox(Vec3(0, -2e-3, 0), 1e-12));
  CHECK((shelf.shape->bounds().max() - Vec3(0, 2e-3, 10e-3)).norm() < 1e-15);
  WallShape::Touches touches;
  shelf.shape->touches({-0.5e-3, 0, 5e-3}, 1e-3, touches);
  REQUIRE(touches.count == 1);
  CHECK((touches.at[0].normal - Vec3(-1, 0, 0)).norm() < 1e-12);
}

TEST_CASE("a gate waits for its stage, slides smoothly, and stays") {
  SceneText t;
  t.walls = plane(
      R"({ kind = "slide", by = ["4 cm", "0", "0"], stage = "run", start = "10 ms", duration = "20 ms" })");
  DemSolver solver(t.scene(), {1});
  const auto to = [&](double time) {
    solver.advance(static_cast<std::int64_t>(std::ceil(time / solver.stepSize())) - solver.step());
    return solver.walls()[0];
  };
  CHECK(to(0.005).translation == Vec3::Zero());
  solver.beginStage("run");
  const double began = solver.time();
  CHECK(to(began + 0.009).translation == Vec3::Zero());
  const FrameWall half = to(began + 0.02);
  CHECK(half.translation.x() == Approx(0.02).epsilon(2e-3));
  CHECK(half.velocity.x() == Approx(1.5 * 0.04 / 0.02).epsilon(1e-3));
  CHECK(to(began + 0.05).translation == Vec3(0.04, 0, 0));
  CHECK(to(began + 0.06).velocity == Vec3::Zero());
}

TEST_CASE("moving walls: the same bits for any number of threads and across save and load") {
  const auto drum = [](int threads) {
    SceneText t;
    t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
    t.tangential = R"({ law = "spring", friction = 0.5, damping_ratio = 0.2 })";
    t.rolling = R"({ law = "elastic_plastic", coefficient = 0.1 })";
    t.stepsPerContact = 25;
    t.walls =
        "[[wall]]\nname = \"drum\"\nkind = \"cylinder\"\nmaterial = \"wall\"\nbase = [\"0\", \"-1 cm\", "
        "\"0\"]\naxis = [0, 1, 0]\nradius = \"2 cm\"\nheight = \"2 cm\"\nends = \"both\"\nmotion = { kind = "
        "\"rotate\", point = [\"0\", \"0\", \"0\"], axis = [0, 1, 0], angular_velocity = \"60 rpm\", stage = "
        "\"run\" }\n"
        "[[wall]]\nname = \"paddle\"\nkind = \"rectangle\"\nmaterial = \"wall\"\ncentre = [\"0\", \"0\", "
        "\"0\"]\n"
        "normal = [0, 0, 1]\nalong = [1, 0, 0]\nlength = \"2 cm\"\nbreadth = \"2 cm\"\nmotion = { kind = "
        "\"rotate\", "
        "point = [\"0\", \"0\", \"0\"], axis = [0, 1, 0], angular_velocity = \"-90 rpm\" }\n" +
        probed("drum");
    auto solver = std::make_unique<DemSolver>(t.scene(), SolverOptions{threads});
    std::vector<GrainSeed> seeds;
    for (int k = 0; k < 400; ++k) {
      RandomStream random(7, RandomPurpose::test, k);
      const Vec3 place(-8.5e-3 + 2.1e-3 * (k % 9), -8.5e-3 + 2.1e-3 * (k / 9 % 8), 2e-3 + 2.1e-3 * (k / 72));
      if (std::hypot(place.x(), place.z()) < 18e-3)
        seeds.push_back(grain(k, place, 0.1 * random.direction()));
    }
    solver->add(seeds);
    return solver;
  };
  const auto bits = [](const DemSolver& solver) {
    std::string all;
    const auto put = [&](const auto& v) { all.append(reinterpret_cast<const char*>(&v), sizeof v); };
    for (const GrainSeed& s : solver.present()) {
      put(s.position);
      put(s.velocity);
      put(s.spin);
    }
    for (const FrameWall& w : solver.walls()) {
      put(w.force);
      put(w.torque);
      put(w.work);
      put(w.power);
      put(w.wearWork);
      put(w.collisions);
      put(w.translation);
    }
    return all;
  };
  const auto finish = [](DemSolver& solver) {
    if (solver.step() < 1000) {
      solver.advance(1000 - solver.step());
      solver.beginStage("run");
    }
    solver.advance(4000 - solver.step());
  };
  auto reference = drum(1);
  finish(*reference);
  const std::string expected = bits(*reference);
  CHECK(reference->walls()[0].collisions > 100);
  CHECK(reference->walls()[0].wearWork > 0.0);
  CHECK(reference->walls()[0].power > 0.0);
  for (int threads : {2, 3}) {
    auto solver = drum(threads);
    finish(*solver);
    CHECK(bits(*solver) == expected);
  }
  for (int at : {1, 999, 2345}) {
    auto first = drum(2);
    if (at > 1000) {
      first->advance(1000);
      first->beginStage("run");
    }
    first->advance(at - first->step());
    auto second = drum(1);
    second->load(first->save());
    finish(*second);
    CHECK(bits(*second) == expected);
  }
}

TEST_CASE("motions that cannot be are refused with a sentence") {
  SceneText t;
  t.walls = plane(
      R"({ kind = "rotate", point = ["0", "0", "0"], axis = [0, 0, 0], angular_velocity = "1 rad/s" })");
  CHECK_THROWS_WITH(t.scene(), Catch::Contains("axis must not be zero"));
  t.walls = plane(R"({ kind = "slide", by = ["1 cm", "0", "0"] })");
  CHECK_THROWS_WITH(t.scene(), Catch::Contains("lacks the key 'duration'"));
  t.walls = plane(R"({ kind = "translate", velocity = ["1 m/s", "0", "0"], stage = "discharge" })");
  CHECK_THROWS_WITH(t.scene(), Catch::Contains("discharge"));
  t.walls = plane(R"({ kind = "translate", velocity = ["1 km/s", "0", "0"] })");
  CHECK_THROWS_WITH(DemSolver(t.scene()), Catch::Contains("could jump over a grain"));
  t.walls = plane(R"({ kind = "oscillate", amplitude = ["1 nm", "0", "0"], frequency = "1e6 Hz" })");
  CHECK_THROWS_WITH(DemSolver(t.scene()),
                    Catch::Contains("the wall 'plate' oscillates 1e+06 times a second") &&
                        Catch::Contains("but 10 are needed"));
  t.walls = plane(R"({ kind = "oscillate", amplitude = ["1 nm", "0", "0"], frequency = "1e3 Hz" })");
  DemSolver paced(t.scene());
  CHECK_NOTHROW(paced.setWallPace("plate", 2));
  CHECK_THROWS_WITH(paced.setWallPace("plate", 100), Catch::Contains("but 10 are needed"));
}
