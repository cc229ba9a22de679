// A wedge instead of the whole circle: what happens at its faces is what happens elsewhere, turned.

#include "sim/base/random.h"
#include "sim/math/sector.h"
#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <numbers>
#include <set>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

constexpr double pi = std::numbers::pi;

struct WedgeText {
  int sectors = 12; ///< 1: the whole circle
  std::string gravity = R"(["0", "0", "0"])";
  std::string normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.8 })";
  std::string tangential = R"({ law = "spring", friction = 0.4 })", wallTangential = tangential;
  std::string rolling = R"({ law = "elastic_plastic", coefficient = 0.05 })";
  std::string walls;
  std::string fill =
      "kind = \"list\"\ngrains = [{ position = [\"9 mm\", \"1 mm\", \"0\"], species = \"bead\" }]";
  double stepsPerContact = 50;

  Scene scene() const {
    return parseScene(
        fmt::format(R"(
gravity = {}
[domain]
lower = ["-0.1 m", "-0.1 m", "-0.1 m"]
upper = ["0.1 m", "0.1 m", "0.1 m"]
{}
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[material]]
name = "wall"
[[contact]]
between = ["glass", "glass"]
normal = {}
tangential = {}
rolling = {}
[[contact]]
between = ["glass", "wall"]
normal = {}
tangential = {}
[[species]]
name = "bead"
material = "glass"
size = {{ distribution = "single", diameter = "2 mm" }}
{}
[[fill]]
{}
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
[accuracy]
steps_per_contact = {}
maximum_overlap = 0.5
)",
                    gravity, sectors > 1 ? fmt::format("[wedge]\nangle = \"{} deg\"", 360.0 / sectors) : "",
                    normal, tangential, rolling, normal, wallTangential, walls, fill, stepsPerContact),
        "test");
  }
};

const char* const closedTube = R"(
[[wall]]
name = "tube"
kind = "cylinder"
material = "wall"
base = ["0", "0", "-12 mm"]
radius = "18 mm"
height = "24 mm"
ends = "both"
)";

Vec3 turnedBy(double angle, const Vec3& v) {
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()) * v;
}

/// Grains spread in the sector of a closed tube, none near another, its images or the walls.
std::vector<GrainSeed> gas(const Sector& sector, int count, double speed) {
  std::vector<GrainSeed> seeds;
  for (std::uint64_t k = 0; static_cast<int>(seeds.size()) < count; ++k) {
    RandomStream random(11, RandomPurpose::test, k);
    const double rho = 17e-3 * std::sqrt(random.uniform()), z = -11e-3 + 22e-3 * random.uniform(),
                 phi = 2 * pi / sector.count() * random.uniform();
    const Vec3 x(rho * std::cos(phi), rho * std::sin(phi), z);
    if (rho > 16.9e-3 || sector.numberOf(x) != 0) continue;
    bool clear = true;
    for (int turn = 0; turn < sector.count(); ++turn) {
      if (turn > 0) clear = clear && (sector.turned(x, turn) - x).norm() > 2.02e-3;
      for (const GrainSeed& s : seeds)
        clear = clear && (sector.turned(x, turn) - s.position).norm() > 2.02e-3;
    }
    if (clear)
      seeds.push_back(grain(static_cast<std::int64_t>(seeds.size()), x, speed * random.direction(),
                            100.0 * random.direction()));
  }
  return seeds;
}

double axialAngularMomentum(const DemSolver& solver) {
  double sum = 0.0;
  for (const GrainSeed& s : solver.present()) {
    const double m = 4.0 / 3.0 * pi * std::pow(s.radius, 3) * 2500.0;
    sum += m * s.position.cross(s.velocity).z() + 0.4 * m * s.radius * s.radius * s.spin.z();
  }
  return sum;
}

std::string bits(const DemSolver& solver) {
  std::string all;
  for (const GrainSeed& s : solver.present())
    for (const Vec3& v : {s.position, s.velocity, s.spin})
      all.append(reinterpret_cast<const char*>(v.data()), sizeof(double) * 3);
  return all;
}

} // namespace

TEST_CASE("sectors: turns, numbers and images agree with brute force") {
  for (const int n : {2, 3, 4, 7, 12}) {
    const Sector sector(n, 2);
    CHECK(sector.coreRadius() == Approx(1.0 / std::sin(pi / n)).epsilon(1e-14));
    for (int i = 0; i < 200; ++i) {
      RandomStream random(5, RandomPurpose::test, i);
      const Vec3 x = 3.0 * random.uniform() * random.direction();
      double azimuth = std::atan2(x.y(), x.x());
      if (azimuth < 0) azimuth += 2 * pi;
      const int k = sector.numberOf(x);
      CHECK(k == static_cast<int>(azimuth / (2 * pi / n)));
      const Vec3 home = sector.turned(x, -k);
      CHECK((home - turnedBy(-2 * pi / n * k, x)).norm() < 1e-15 * (1 + n));
      // Images nearer than the reach, by the distance from points of the sector spread over its faces.
      const double reach = random.uniform();
      std::set<int> found;
      sector.eachImage(home, reach, [&](int turn) { CHECK(found.insert(turn).second); });
      for (int turn = 1; turn < n; ++turn) {
        const Vec3 image = sector.turned(home, turn);
        double nearest = 1e9;
        for (const double face : {0.0, 2 * pi / n}) {
          const Vec3 along(std::cos(face), std::sin(face), 0);
          const double s = std::max(0.0, image.dot(along));
          nearest = std::min(nearest, (Vec3(image.x(), image.y(), 0) - s * along).norm());
        }
        CHECK((nearest < reach) <= found.contains(turn));
        CHECK(sector.distance(home, turn) == Approx(nearest).epsilon(1e-12).margin(1e-15));
      }
    }
  }
}

TEST_CASE("V14: a grain that crosses a face keeps its radial, azimuthal and axial motion") {
  // Free flight: a straight line in the whole circle. After each face it is that line turned by the angle.
  WedgeText t;
  DemSolver solver(t.scene());
  const Vec3 x(60e-3, 3e-3, 1e-3), v(-0.31, 0.42, 0.07), w(3, -40, 12);
  solver.add({grain(0, x, v, w)});
  int sectorsSeen = 0, last = 0;
  while (solver.time() < 0.15) {
    solver.advance(50);
    const Vec3 there = x + solver.time() * v;
    const GrainSeed now = solver.present().at(0);
    // Which turn the solver is at: between lists a grain may stand a little beyond a face.
    int turn = -1;
    for (int k = 0; k < 12; ++k)
      if ((turnedBy(-k * pi / 6, there) - now.position).norm() < 1e-12) turn = k;
    REQUIRE(turn >= 0);
    CHECK((turnedBy(-turn * pi / 6, v) - now.velocity).norm() < 1e-12);
    CHECK((turnedBy(-turn * pi / 6, w) - now.spin).norm() < 1e-11);
    sectorsSeen += turn != last;
    last = turn;
  }
  CHECK(sectorsSeen == 2); // it ends at azimuth 78 degrees
}

TEST_CASE("V14: a collision across a face is the same collision elsewhere, turned") {
  // Friction, rolling and spin. Beside the oblique approach both move round the axis together, so that the
  // pair crosses the face while it is in contact, each grain at another time, and histories change lists.
  for (const char* law : {R"({ law = "spring", friction = 0.4 })",
                          R"({ law = "walton", stiffness_ratio = 0.8, friction = 0.4 })"})
    for (const double common : {0.0, 1.0, -1.3}) {
      WedgeText t;
      t.tangential = law;
      t.wallTangential = R"({ law = "none" })";
      t.normal = R"({ law = "walton_braun", stiffness = "1000 N/m", unloading_stiffness = "1600 N/m" })";
      t.stepsPerContact = 1500;
      const auto run = [&](int sectors, double azimuth, bool other, const std::vector<GrainSeed>& like) {
        t.sectors = sectors;
        DemSolver solver(t.scene());
        const Sector sector(std::max(1, sectors), 2);
        const auto place = [&](std::int64_t id, double away, double speed, double side) {
          const Vec3 x = turnedBy(azimuth, Vec3(8e-3 + side, away, 0.2e-3 * side / 1e-3));
          const Vec3 v = turnedBy(azimuth, Vec3(0.05 * speed, speed + common, 0.3 * speed));
          const Vec3 w = turnedBy(azimuth, Vec3(20 * speed, -30, 50 * id));
          const int k = sector.numberOf(x);
          return grain(id, sector.turned(x, -k), sector.turned(v, -k), sector.turned(w, -k));
        };
        solver.add({place(other ? 1 : 0, -1.0e-3, 0.4, 0.0), place(other ? 0 : 1, 1.0e-3, -0.4, 0.3e-3)});
        solver.advance(4000);
        std::vector<GrainSeed> grains = solver.present();
        for (GrainSeed& s : grains) // as seen from azimuth 0, in the image nearest to the other run's grain
          if (const Vec3 there = like.empty() ? s.position : like[s.id].position; !like.empty()) {
            const GrainSeed home = s;
            double nearest = 1;
            for (int k = 0; k < sector.count(); ++k) {
              const auto back = [&](const Vec3& v) { return turnedBy(-azimuth, sector.turned(v, k)); };
              if ((back(home.position) - there).norm() >= nearest) continue;
              s = grain(s.id, back(home.position), back(home.velocity), back(home.spin));
              nearest = (s.position - there).norm();
            }
          } else {
            s = grain(s.id, turnedBy(-azimuth, s.position), turnedBy(-azimuth, s.velocity),
                      turnedBy(-azimuth, s.spin));
          }
        CHECK(solver.time() > 0.4e-3); // the contact lasts 0.2 ms
        if (common != 0.0) CHECK(solver.rebuilds() > 4);
        return grains;
      };
      for (const bool other : {false, true}) {
        const auto plain = run(1, 0.2, other, {});
        CHECK((plain[0].velocity - plain[1].velocity).norm() < 0.7); // they did collide
        // 30 degrees, then half a circle; azimuths: across face 0, across the other face, and inside.
        for (const auto& [sectors, azimuth] : {std::pair{12, 0.0},
                                               {12, pi / 6},
                                               {12, pi / 12},
                                               {12, 0.01},
                                               {12, pi / 6 - 0.01},
                                               {2, 0.0},
                                               {2, pi}}) {
          INFO(law << " sectors " << sectors << " azimuth " << azimuth << " common " << common);
          const auto turned = run(sectors, azimuth, other, plain);
          for (int g = 0; g < 2; ++g) {
            CHECK((turned[g].position - plain[g].position).norm() < 1e-12 * 8e-3);
            CHECK((turned[g].velocity - plain[g].velocity).norm() < 1e-12 * 2);
            CHECK((turned[g].spin - plain[g].spin).norm() < 1e-12 * 400);
          }
        }
      }
    }
}

TEST_CASE("V14: a wedge is the whole circle that holds its images") {
  // Rain into a cone with friction: 6 sectors against all 6 images at once, through some 100 collisions.
  WedgeText t;
  t.sectors = 6;
  t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  t.walls = R"(
[[wall]]
name = "cone"
kind = "frustum"
material = "wall"
base = ["0", "0", "-12 mm"]
lower_radius = "8 mm"
upper_radius = "18 mm"
height = "24 mm"
ends = "bottom"
)";
  const Sector sector(6, 2);
  std::vector<GrainSeed> inside, all;
  for (GrainSeed s : gas(sector, 60, 0.3)) {
    if (std::hypot(s.position.x(), s.position.y()) > 6e-3 + 10.0 / 24.0 * (s.position.z() + 12e-3)) continue;
    s.id = static_cast<std::int64_t>(inside.size());
    inside.push_back(s);
  }
  REQUIRE(inside.size() > 20);
  for (const GrainSeed& s : inside)
    for (int k = 0; k < 6; ++k)
      all.push_back(grain(6 * s.id + k, sector.turned(s.position, k), sector.turned(s.velocity, k),
                          sector.turned(s.spin, k)));
  DemSolver wedge(t.scene());
  t.sectors = 1;
  DemSolver whole(t.scene());
  wedge.add(inside);
  whole.add(all);
  const double before = wedge.energies().total();
  wedge.advance(1500);
  whole.advance(1500);
  CHECK(wedge.energies().total() < 0.97 * before); // they have collided
  CHECK(6 * wedge.energies().total() == Approx(whole.energies().total()).epsilon(1e-10));
  CHECK(6 * wedge.energies().elastic == Approx(whole.energies().elastic).epsilon(1e-8));
  double worst = 0;
  const auto grains = wedge.present(), others = whole.present();
  for (const GrainSeed& s : grains) {
    double nearest = 1;
    for (int k = 0; k < 6; ++k)
      nearest =
          std::min(nearest, (sector.turned(s.position, k) - others[6 * s.id].position).norm() +
                                1e-3 * (sector.turned(s.velocity, k) - others[6 * s.id].velocity).norm());
    worst = std::max(worst, nearest);
  }
  CHECK(worst < 1e-10);
  // The wall feels a sixth of the load along the axis.
  CHECK(6 * wedge.walls()[0].force.z() == Approx(whole.walls()[0].force.z()).epsilon(1e-6));
}

TEST_CASE("a grain meets its own images near the axis, and all that is kept stays in balance") {
  // Straight at the axis of a half circle: an elastic bounce off its own image when rho is one radius.
  WedgeText t;
  t.sectors = 2;
  t.tangential = R"({ law = "none" })";
  t.rolling = R"({ law = "none" })";
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  t.wallTangential = R"({ law = "none" })";
  t.stepsPerContact = 200;
  const double m = 4.0 / 3.0 * pi * 1e-9 * 2500.0;
  for (const int sectors : {2, 3, 12}) {
    t.sectors = sectors;
    DemSolver solver(t.scene());
    const double azimuth = pi / sectors, core = 1e-3 / std::sin(pi / sectors);
    solver.add({grain(0, turnedBy(azimuth, Vec3(core + 0.2e-3, 0, 0)), turnedBy(azimuth, Vec3(-0.1, 0, 0)))});
    double deepest = 0;
    while (solver.time() < 6e-3) {
      solver.advance(1);
      const auto e = solver.energies();
      deepest = std::max(deepest, e.elastic);
      CHECK(e.total() == Approx(0.5 * m * 0.01).epsilon(2e-3));
    }
    CHECK(deepest > 0.4 * m * 0.01); // at the turn all energy is in its contacts
    const GrainSeed s = solver.present()[0];
    CHECK((s.velocity - turnedBy(azimuth, Vec3(0.1, 0, 0))).norm() < 2e-5);
  }
}

TEST_CASE("a gas in a wedge keeps its energy and its angular momentum about the axis") {
  WedgeText t;
  t.sectors = 5;
  t.walls = closedTube;
  t.wallTangential = R"({ law = "none" })";
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  {
    // With friction and rolling between grains and a smooth wall: angular momentum to round-off.
    DemSolver solver(t.scene());
    solver.add(gas(Sector(5, 2), 60, 0.5));
    const double before = axialAngularMomentum(solver), energy = solver.energies().total();
    double scale = 0;
    for (const GrainSeed& s : solver.present())
      scale += 4.0 / 3.0 * pi * 1e-9 * 2500.0 * s.position.norm() * s.velocity.norm();
    solver.advance(20000);
    CHECK(std::abs(axialAngularMomentum(solver) - before) < 1e-12 * scale);
    CHECK(solver.energies().total() < 0.9 * energy); // collisions there were
  }
  {
    t.tangential = R"({ law = "none" })";
    t.rolling = R"({ law = "none" })";
    DemSolver solver(t.scene());
    solver.add(gas(Sector(5, 2), 60, 0.5));
    const double energy = solver.energies().total();
    solver.advance(20000);
    CHECK(solver.energies().total() == Approx(energy).epsilon(2e-3)); // as without a wedge: O(step^2)
  }
}

TEST_CASE("a wedge gives the same bits for any number of threads, and across save and load") {
  WedgeText t;
  t.sectors = 5;
  t.walls = closedTube;
  t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  const auto start = [&](int threads) {
    auto solver = std::make_unique<DemSolver>(t.scene(), SolverOptions{threads});
    solver->add(gas(Sector(5, 2), 180, 0.5));
    return solver;
  };
  auto straight = start(1);
  straight->advance(6000);
  REQUIRE(straight->rebuilds() > 20);
  const std::string expected = bits(*straight);
  for (const int threads : {2, 3, 7}) {
    auto solver = start(threads);
    for (int k = 0; k < 6; ++k) {
      solver->advance(1000);
      solver->frame(); // looking changes nothing
    }
    CHECK(bits(*solver) == expected);
  }
  for (const int at : {1, 1777, 5000}) {
    auto first = start(2);
    first->advance(at);
    const Solver::State state = first->save();
    DemSolver second(t.scene(), {3});
    second.load(state);
    second.advance(6000 - at);
    CHECK(bits(second) == expected);
    CHECK(second.energies().total() == straight->energies().total());
  }
}

TEST_CASE("fillings of a wedge keep clear of its images") {
  WedgeText t;
  t.walls = closedTube;
  for (const int sectors : {2, 4, 12}) {
    t.sectors = sectors;
    t.fill = R"(
kind = "random"
species = "bead"
region = "cylinder"
base = ["0", "0", "-12 mm"]
radius = "18 mm"
height = "24 mm"
axis = [0, 0, 1]
solid_fraction = 0.2)";
    const Scene scene = t.scene();
    const Sector sector = scene.sector();
    const auto grains = placeGrains(scene, "run", 0, {});
    // A fifth of the open part of the sector, in which centres stay a core from the axis.
    const double volume = pi * 18e-3 * 18e-3 * 24e-3 / sectors, one = 4.0 / 3.0 * pi * 1e-9;
    CHECK(grains.size() * one == Approx(0.2 * volume).epsilon(0.03));
    for (std::size_t i = 0; i < grains.size(); ++i) {
      CHECK(sector.numberOf(grains[i].position) == 0);
      for (std::size_t j = 0; j <= i; ++j)
        for (int turn = i == j ? 1 : 0; turn < sectors; ++turn)
          CHECK((grains[i].position - sector.turned(grains[j].position, turn)).norm() >= 2e-3 * (1 - 1e-12));
    }
  }
}

TEST_CASE("V14: a quarter of a conical hopper discharges a quarter as fast as the whole") {
  // Outlet of 8 diameters: the hole that images keep open about the axis (1.4 radii) is 3 % of its area, and
  // grains beside it flow faster for it; in this scene the rates agree within 1 % in long runs.
  WedgeText t;
  t.gravity = R"(["0", "0", "-9.81 m/s^2"])";
  t.normal = R"({ law = "linear", collision_time = "1 ms", restitution = 0.7 })";
  t.rolling = R"({ law = "none" })";
  t.stepsPerContact = 15;
  t.walls = R"(
[[wall]]
name = "hopper"
kind = "cone_hopper"
material = "wall"
base = ["0", "0", "0"]
outlet = "16 mm"
width = "34 mm"
half_angle = "60 deg"
height = "90 mm"
[[wall]]
name = "gate"
kind = "disc"
material = "wall"
centre = ["0", "0", "0"]
normal = [0, 0, 1]
radius = "9 mm"
[[outlet]]
name = "below"
point = ["0", "0", "-5 mm"]
normal = [0, 0, -1]
)";
  t.fill = R"(
kind = "random"
species = "bead"
region = "cylinder"
base = ["0", "0", "8 mm"]
axis = [0, 0, 1]
radius = "17 mm"
height = "80 mm"
solid_fraction = 0.22)";
  // Mass that leaves in spans of 20 ms of steady flow (a multiple of the steps between two looks at the
  // outlet), and the standard error of its mean from their scatter.
  const auto rate = [&](int sectors, int seeds, double& error) {
    t.sectors = sectors;
    constexpr int spans = 10, settling = 2250, opening = 1500, span = 300;
    double sum = 0, squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      Scene scene = t.scene();
      scene.seed = static_cast<std::uint64_t>(seed);
      DemSolver solver(scene);
      REQUIRE(span * solver.stepSize() == Approx(0.02));
      solver.add(placeGrains(scene, "run", 0, {}));
      solver.setDrag(10.0);
      solver.advance(settling);
      solver.setDrag(0.0);
      solver.removeWall("gate");
      solver.advance(opening);
      for (int k = 0; k < spans; ++k) {
        const double before = solver.flow().massDischarged;
        solver.advance(span);
        const double mass = sectors * (solver.flow().massDischarged - before);
        sum += mass;
        squares += mass * mass;
      }
      REQUIRE(solver.grains() > 200);
    }
    const int count = spans * seeds;
    error = std::sqrt((squares / count - sum * sum / (count * count)) / (count - 1));
    return sum / count;
  };
  double errorWhole = 0, errorWedge = 0;
  const double whole = rate(1, 1, errorWhole), wedge = rate(4, 4, errorWedge);
  const double error = std::hypot(errorWhole, errorWedge);
  INFO(whole << " +- " << errorWhole << ", " << wedge << " +- " << errorWedge);
  CHECK(error < 0.03 * whole);
  CHECK(std::abs(wedge - whole) < 3 * error + 0.01 * whole); // 99.7 % of such pairs of runs
}
