#pragma once
// Small scenes for exact-answer tests of the contact core, as TOML text that the scene reader checks as
// usual.

#include "sim/scene/scene.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

#include <string>

namespace sandglass::testing {

/// A scene of unit-ish grains: diameter 2 mm, density 2500 kg/m^3, walls of material "wall".
struct SceneText {
  std::string gravity = R"(["0", "0", "0"])";
  std::string periodic = "[]";
  std::string lower = R"(["-1 m", "-1 m", "-1 m"])", upper = R"(["1 m", "1 m", "1 m"])";
  std::string normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 0.9 })";
  std::string wallNormal; ///< as `normal` when empty
  std::string tangential = R"({ law = "none" })";
  std::string rolling = R"({ law = "none" })";
  std::string elasticity; ///< extra lines for both materials
  std::string walls, species = R"([[species]]
name = "bead"
material = "glass"
size = { distribution = "single", diameter = "2 mm" }
)";
  std::string firstDiameter; ///< for the placeholder grain, where the species has a size spread
  double density = 2500;     ///< [kg/m^3]
  double timeStep = 0;       ///< [s]; 0: from stepsPerContact
  double stepsPerContact = 50;
  double maximumOverlap = 0.5;
  std::string accuracy; ///< further lines

  std::string text() const {
    return fmt::format(R"(
title = "test"
gravity = {}
[domain]
lower = {}
upper = {}
periodic = {}
[[material]]
name = "glass"
density = "{} kg/m^3"
{}
[[material]]
name = "wall"
{}
[[contact]]
between = ["glass", "glass"]
normal = {}
tangential = {}
rolling = {}
[[contact]]
between = ["glass", "wall"]
normal = {}
tangential = {}
rolling = {}
{}
{}
[[fill]]
kind = "list"
grains = [{{ position = ["2 mm", "2 mm", "2 mm"], species = "bead"{} }}]
[[stage]]
name = "run"
until = {{ duration = "1 s" }}
[accuracy]
steps_per_contact = {}
maximum_overlap = {}
{}
{})",
                       gravity, lower, upper, periodic, density, elasticity, elasticity, normal, tangential,
                       rolling, wallNormal.empty() ? normal : wallNormal, tangential, rolling, species, walls,
                       firstDiameter, stepsPerContact, maximumOverlap,
                       timeStep > 0 ? fmt::format("time_step = \"{:.17g} s\"", timeStep) : "", accuracy);
  }
  Scene scene() const { return parseScene(text(), "test"); }
};

inline GrainSeed grain(std::int64_t id, const Vec3& position, const Vec3& velocity = Vec3::Zero(),
                       const Vec3& spin = Vec3::Zero(), double radius = 1e-3) {
  GrainSeed g;
  g.id = id;
  g.radius = radius;
  g.position = position;
  g.velocity = velocity;
  g.spin = spin;
  return g;
}

} // namespace sandglass::testing
