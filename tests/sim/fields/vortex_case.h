#pragma once
// Small scenes of the vortex tank for exact answers: soft beads of one size, walls and fields as a test
// needs.

#include "sim/scene/scene.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace sandglass::testing {

inline constexpr double thesisGravity = 9.8;                     ///< [m/s^2]
inline constexpr double perDiameter = 1.55e-4, perSquare = 0.22; ///< [kg/(m s)], [kg/m^3], drag of the thesis

struct VortexCase {
  double radius = 6e-3, density = 10000, youngsModulus = 2e5, dissipation = 1e-3; ///< SI
  std::string friction = R"({ law = "none" })", normalOptions, wallFriction;      ///< the last as `friction`
  std::string fields, walls, preset;
  double gravity = 0, timeStep = 1e-5;

  static std::string plane(const std::string& name, const Vec3& point, const Vec3& normal) {
    return fmt::format(
        "[[wall]]\nname = \"{}\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"{} m\", \"{} m\", "
        "\"{} m\"]\nnormal = [{}, {}, {}]\n",
        name, point.x(), point.y(), point.z(), normal.x(), normal.y(), normal.z());
  }
  static std::string tank() {
    return "[[wall]]\nname = \"side\"\nkind = \"cylinder\"\nmaterial = \"wall\"\nbase = [\"0\", \"0\", \"-20 "
           "cm\"]\naxis = [0, 0, 1]\nradius = \"6 cm\"\nheight = \"1 m\"\n";
  }

  Scene scene() const {
    const std::string normal =
        fmt::format("{{ law = \"rice\", dissipation_time = \"{} s\"{} }}", dissipation, normalOptions);
    const std::string elastic = fmt::format(
        "density = \"{} kg/m^3\"\nyoungs_modulus = \"{} Pa\"\npoisson_ratio = 0.3\n", density, youngsModulus);
    return parseScene(fmt::format(R"({}
gravity = ["0", "0", "{} m/s^2"]
[domain]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["9 m", "1 m", "2 m"]
[[material]]
name = "bead"
{}
[[material]]
name = "wall"
{}
[[contact]]
between = ["bead", "bead"]
normal = {}
tangential = {}
[[contact]]
between = ["bead", "wall"]
normal = {}
tangential = {}
[[species]]
name = "bead"
material = "bead"
size = {{ distribution = "single", diameter = "{} m" }}
{}
{}
[[fill]]
kind = "list"
grains = [{{ position = ["0", "0", "0"] }}]
[[stage]]
name = "run"
until = {{ duration = "10 s" }}
[accuracy]
time_step = "{} s"
maximum_overlap = 1.5
maximum_travel = 1
)",
                                  preset.empty() ? "" : "preset = \"" + preset + "\"", -gravity, elastic,
                                  elastic, normal, friction, normal,
                                  wallFriction.empty() ? friction : wallFriction, 2 * radius, walls, fields,
                                  timeStep),
                      "case.toml");
  }

  GrainSeed bead(std::int64_t id, const Vec3& position, const Vec3& velocity = Vec3::Zero(),
                 const Vec3& spin = Vec3::Zero()) const {
    GrainSeed seed;
    seed.id = id;
    seed.radius = radius;
    seed.position = position;
    seed.velocity = velocity;
    seed.spin = spin;
    return seed;
  }

  double mass() const { return 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius * density; }
  double inertia() const { return 0.4 * mass() * radius * radius; }
  double modulus() const { return youngsModulus / (2 * (1 - 0.09)); } ///< E* of two alike
};

/// A solver with these grains after `time` [s]; ids are positions in the list.
inline std::vector<GrainSeed> after(const VortexCase& setup, const std::vector<GrainSeed>& seeds,
                                    double time) {
  SolverOptions one;
  one.threads = 1;
  DemSolver solver(setup.scene(), one);
  solver.add(seeds);
  solver.advance(std::llround(time / solver.stepSize()));
  return solver.present();
}

} // namespace sandglass::testing
