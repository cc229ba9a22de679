// Frozen grains: as heavy as a wall, at rest or in the motion that their filling gave them.

#include "sim/base/random.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double mass = 4.0 / 3.0 * pi * 1e-9 * 2500.0; ///< of a grain of 1 mm radius [kg]

/// Species 0 moves, species 1 is frozen; both are of the same glass.
SceneText frozenScene() {
  SceneText t;
  t.species += R"([[species]]
name = "rock"
material = "glass"
frozen = true
size = { distribution = "single", diameter = "2 mm" }
)";
  return t;
}

GrainSeed rock(std::int64_t id, const Vec3& position, const Vec3& velocity = Vec3::Zero(),
               const Vec3& spin = Vec3::Zero()) {
  GrainSeed g = grain(id, position, velocity, spin);
  g.species = 1;
  return g;
}

/// A rough floor of frozen grains, 2.2 mm apart with some scatter, and a loose block of grains above.
std::vector<GrainSeed> bedOverRocks(const Vec3& floorVelocity) {
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 100; ++k) {
    RandomStream random(4, RandomPurpose::test, k);
    const Vec3 place(2.2e-3 * (k % 10) + 1e-3, 2.2e-3 * (k / 10) + 1e-3, 0);
    seeds.push_back(rock(k, place + 0.1e-3 * random.direction(), floorVelocity));
  }
  for (int k = 100; k < 600; ++k) {
    RandomStream random(5, RandomPurpose::test, k);
    const Vec3 place(2.2e-3 * (k % 10) + 1e-3, 2.2e-3 * (k / 10 % 10) + 1e-3, 2.3e-3 * (k / 100) + 0.3e-3);
    seeds.push_back(grain(k, place + 0.05e-3 * random.direction(), 0.2 * random.direction()));
  }
  return seeds;
}

SceneText roughFloor() {
  SceneText t = frozenScene();
  t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  t.lower = R"(["0", "0", "-10 mm"])";
  t.upper = R"(["22 mm", "22 mm", "60 mm"])";
  t.periodic = R"(["x", "y"])";
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.4 })";
  t.tangential = R"({ law = "spring", friction = 0.5, stiffness_ratio = 0.3 })";
  t.rolling = R"({ law = "elastic_plastic", coefficient = 0.05 })";
  return t;
}

std::vector<GrainSeed> frozenOf(const DemSolver& solver) {
  std::vector<GrainSeed> all;
  for (const GrainSeed& s : solver.present())
    if (s.species == 1) all.push_back(s);
  return all;
}

} // namespace

TEST_CASE("a grain bounces off a frozen one as off a wall") {
  // Reduced mass of one free grain: it leaves with e times its speed, after pi / (w sqrt(1 - z^2)),
  // w = sqrt(k/m), z = -ln e / sqrt(pi^2 + ln^2 e); the frozen one keeps all its bits.
  SceneText t = frozenScene();
  t.stepsPerContact = 400;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.7 })";
  DemSolver solver(t.scene());
  const Vec3 there(0.3e-3, 0, 0);
  solver.add({rock(0, there), grain(1, Vec3(2.4e-3, 0, 0), Vec3(-0.2, 0, 0))});
  const double z = -std::log(0.7) / std::hypot(pi, std::log(0.7));
  const double duration = pi / std::sqrt(1000.0 / mass * (1 - z * z));
  double touching = 0;
  while (solver.time() < 2e-3) {
    solver.advance(1);
    const auto grains = solver.present();
    touching += grains[1].position.x() - grains[0].position.x() < 2e-3 ? solver.stepSize() : 0.0;
    CHECK(grains[0].position == there);
    CHECK(grains[0].velocity == Vec3::Zero());
  }
  CHECK(solver.present()[1].velocity.x() == Approx(0.7 * 0.2).epsilon(1e-3));
  CHECK(touching == Approx(duration).epsilon(2e-2)); // longer than the contact of the law: overlap ends last
  CHECK(solver.freeGrains() == 1);
  CHECK(solver.energies().translational == Approx(0.5 * mass * 0.14 * 0.14).epsilon(2e-3));
}

TEST_CASE("a bed comes to rest on a rough floor of frozen grains, which carries its weight") {
  DemSolver solver(roughFloor().scene());
  solver.add(bedOverRocks(Vec3::Zero()));
  const auto floor = frozenOf(solver);
  double energy = solver.energies().total();
  solver.setDrag(5.0);
  for (int k = 0; k < 40; ++k) {
    solver.advance(1000);
    const double now = solver.energies().total();
    CHECK(now < energy + 1e-6 * mass); // nothing gives it energy
    energy = now;
  }
  solver.setGravity(Vec3(0, 0, -9.81)); // as before; it must not kick the floor either
  solver.advance(1);
  // On average each could climb a thousandth of a diameter at most.
  CHECK(solver.energies().translational < 500 * 1e-3 * mass * 9.81 * 2e-3);
  CHECK(solver.wallWork() == 0.0);
  const auto after = frozenOf(solver);
  REQUIRE(after.size() == 100);
  for (std::size_t i = 0; i < floor.size(); ++i) {
    CHECK(after[i].position == floor[i].position);
    CHECK(after[i].velocity == Vec3::Zero());
    CHECK(after[i].spin == Vec3::Zero());
  }
}

TEST_CASE("frames tell what a frozen floor carries, and its grains' mass") {
  Scene scene = roughFloor().scene();
  scene.output.quantities = {"force", "mass", "species"};
  DemSolver solver(scene);
  solver.add(bedOverRocks(Vec3::Zero()));
  solver.setDrag(30.0);
  solver.advance(25000);
  const FramePtr frame = solver.frame();
  Vec3 carried = Vec3::Zero();
  const auto& species = frame->scalar("species");
  for (std::size_t i = 0; i < frame->size(); ++i) {
    CHECK(frame->scalar("mass")[i] == Approx(mass));
    if (species[i] == 1) carried += frame->vector("force")[i];
  }
  CHECK(carried.z() == Approx(-500 * mass * 9.81).epsilon(1e-2)); // the bed still trembles a little
  CHECK(solver.flow().massEntered == Approx(600 * mass));
}

TEST_CASE("a rough plate drawn along does the work that the bed gains") {
  // No friction, no dissipation: what is added to kinetic, potential and elastic energy is the plate's work,
  // up to the square of the step.
  SceneText t = roughFloor();
  t.tangential = R"({ law = "none" })";
  t.rolling = R"({ law = "none" })";
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  double error[2] = {};
  for (const int fine : {0, 1}) {
    t.stepsPerContact = fine ? 120 : 60;
    DemSolver solver(t.scene());
    const Vec3 speed(0.4, -0.1, 0.02);
    solver.add(bedOverRocks(speed));
    solver.advance(0);
    const auto start = frozenOf(solver);
    const double before = solver.energies().total();
    while (solver.time() < 20e-3)
      solver.advance(100);
    const double gained = solver.energies().total() - before, work = solver.wallWork();
    CHECK(work > 0.1 * before);
    error[fine] = std::abs(gained - work) / work;
    const auto end = frozenOf(solver);
    for (std::size_t i = 0; i < start.size(); ++i) {
      CHECK(end[i].velocity == speed);
      CHECK(end[i].position.z() - start[i].position.z() == Approx(speed.z() * solver.time()).epsilon(1e-9));
    }
  }
  CHECK(error[0] < 4e-3);
  CHECK(error[1] < 1e-3);
}

TEST_CASE("frozen grains in motion: the same bits for any number of threads, across save and load") {
  const auto start = [&](int threads) {
    auto solver = std::make_unique<DemSolver>(roughFloor().scene(), SolverOptions{threads});
    auto seeds = bedOverRocks(Vec3(0.3, 0, 0));
    for (GrainSeed& s : seeds)
      if (s.species == 1) s.spin = Vec3(0, 20, 0);
    solver->add(seeds);
    return solver;
  };
  const auto bits = [](const DemSolver& solver) {
    std::string all;
    for (const GrainSeed& s : solver.present())
      for (const Vec3& v : {s.position, s.velocity, s.spin})
        all.append(reinterpret_cast<const char*>(v.data()), sizeof(double) * 3);
    return all;
  };
  auto straight = start(1);
  straight->advance(3000);
  REQUIRE(straight->rebuilds() > 10);
  for (const int threads : {2, 3, 7}) {
    auto solver = start(threads);
    solver->advance(3000);
    CHECK(bits(*solver) == bits(*straight));
    CHECK(solver->wallWork() == straight->wallWork());
  }
  auto first = start(2);
  first->advance(1234);
  DemSolver second(roughFloor().scene(), {1});
  second.load(first->save());
  second.advance(3000 - 1234);
  CHECK(bits(second) == bits(*straight));
  CHECK(second.wallWork() == straight->wallWork());
  CHECK(second.energies().total() == straight->energies().total());
}

TEST_CASE("no contact is missed in a bed that flows without walls, and lists outlast the flow") {
  // Without friction a contact holds k overlap^2 / 2, so the energy of all contacts in the list can be
  // compared with that of all pairs that are near enough: one that was missed lacks in the first. A floor
  // that is drawn along shears the bed, on the way it passes the periodic box many times.
  const double speed = GENERATE(0.0, 0.5, 3.0);
  const int threads = GENERATE(1, 2);
  SceneText t = roughFloor();
  t.rolling = t.tangential = R"({ law = "none" })";
  DemSolver solver(t.scene(), {threads});
  solver.add(bedOverRocks(Vec3(speed, 0, 0)));
  const double box = 22e-3, k = 1000;
  double missed = 0, most = 0;
  for (int look = 0; look < 150; ++look) {
    solver.advance(31);
    const auto grains = solver.present();
    double all = 0;
    for (std::size_t i = 0; i < grains.size(); ++i)
      for (std::size_t j = i + 1; j < grains.size(); ++j) {
        if (grains[i].species == 1 && grains[j].species == 1) continue; // drawn along together
        Vec3 apart = grains[i].position - grains[j].position;
        for (int a = 0; a < 2; ++a)
          apart[a] -= box * std::round(apart[a] / box);
        const double overlap = 2e-3 - apart.norm();
        if (overlap > 0) all += 0.5 * k * overlap * overlap;
      }
    missed = std::max(missed, std::abs(all - solver.energies().elastic) / all);
    most = std::max(most, all);
  }
  CAPTURE(speed, threads, most, solver.rebuilds());
  CHECK(most > 0);
  CHECK(missed < 1e-9);
}

TEST_CASE("a loose block that flies as a whole is listed once") {
  SceneText t;
  t.lower = R"(["0", "0", "0"])";
  t.upper = R"(["40 mm", "40 mm", "40 mm"])";
  t.periodic = R"(["x", "y", "z"])";
  DemSolver solver(t.scene());
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 1000; ++k)
    seeds.push_back(grain(k, 4e-3 * Vec3(k % 10, k / 10 % 10, k / 100), Vec3(1, 2, -3)));
  solver.add(seeds);
  solver.advance(1);
  const auto listed = solver.rebuilds();
  solver.advance(2000);
  CHECK(solver.time() * 3 > 10 * 2e-3); // it has gone ten diameters
  CHECK(solver.rebuilds() == listed);
}
