#include "sim/solvers/dem/step_rule.h"

#include "sim/base/error.h"
#include "sim/contact/solver_wall.h"
#include "sim/fields/field_stack.h"
#include "sim/grains/seeding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass {

namespace {

/// Smallest grain of a material: radius and mass; infinite for a wall's material.
struct Smallest {
  double radius = std::numeric_limits<double>::infinity();
  double mass = std::numeric_limits<double>::infinity();
};

Smallest smallestGrain(const Scene& scene, const Material& material) {
  Smallest s;
  for (const Species& species : scene.species) {
    if (species.material != material.name) continue;
    const double r = 0.5 * sizeRange(scene, species).smallest;
    if (r >= s.radius) continue;
    s.radius = r;
    s.mass = 4.0 / 3.0 * std::numbers::pi * r * r * r * material.density;
  }
  return s;
}

double harmonic(double a, double b) {
  return std::isinf(a) ? b : std::isinf(b) || a == 0 ? a : a * b / (a + b);
}

/// Too large or too small for a double, or for what their law multiplies.
[[noreturn]] void refuseTime(const Scene& scene, const std::string& pair, double mass, double time) {
  throw InputError(
      fmt::format("{}: a collision of {} takes {:.3g} s for their smallest grains (reduced mass {:.3g} kg), "
                  "from which no time step follows; check the diameters, the density, and the stiffness, "
                  "collision_time or youngs_modulus",
                  scene.file, pair, time, mass));
}

} // namespace

double impactSpeed(const Scene& scene) {
  double fastest = 0.0;
  for (const FillSpec& fill : scene.fills) {
    const Parameters& p = fill.how.parameters;
    if (p.has("velocity")) fastest = std::max(fastest, p.vector("velocity").norm());
    if (p.has("velocities")) // a list of grains
      for (const Vec3& v : p.vectors("velocities"))
        fastest = std::max(fastest, v.norm());
  }
  const Vec3 g = scene.gravity;
  double height = 0.0;
  if (g.norm() > 0.0)
    for (int k = 0; k < 3; ++k)
      if (!scene.domain.periodic[k])
        height += std::abs(g[k]) / g.norm() * (scene.domain.upper[k] - scene.domain.lower[k]);
  if (!std::isfinite(height)) height = 1.0;
  return std::max(
      {std::sqrt(2.0 * g.norm() * height), 2.0 * fastest, fastestWall(scene), fastestFlow(scene), 1e-3});
}

StepChoice chooseStep(const Scene& scene, const LawStack& laws) {
  StepChoice choice;
  choice.shortestContact = std::numeric_limits<double>::infinity();
  const double speed = impactSpeed(scene);
  std::string pair;
  double reducedMass = 0;
  for (std::size_t a = 0; a < scene.materials.size(); ++a)
    for (std::size_t b = a; b < scene.materials.size(); ++b) {
      const int type = laws.typeOf(static_cast<int>(a), static_cast<int>(b));
      if (!laws.context().types[type].used) continue;
      const Smallest s = smallestGrain(scene, scene.materials[a]),
                     t = smallestGrain(scene, scene.materials[b]);
      const double mass = harmonic(s.mass, t.mass), radius = harmonic(s.radius, t.radius);
      if (std::isinf(radius)) continue; // two materials of walls
      for (const auto& entry : laws.entries()) {
        const double tc = entry.law->collisionTime(type, mass, radius, speed);
        if (!pair.empty() && tc >= choice.shortestContact) continue;
        pair = scene.materials[a].name + " on " + scene.materials[b].name;
        choice.shortestContact = tc;
        reducedMass = mass;
        if (!(tc > 0)) refuseTime(scene, pair, reducedMass, tc);
      }
    }
  if (pair.empty())
    throw InputError("no two materials of the scene can touch, so no time step follows; add a [[contact]]");
  if (!std::isnormal(choice.shortestContact)) refuseTime(scene, pair, reducedMass, choice.shortestContact);
  choice.stableLimit = choice.shortestContact / 5.0;
  if (scene.accuracy.timeStep) {
    choice.step = *scene.accuracy.timeStep;
    choice.rule = fmt::format(
        "given by time_step, whatever level and steps_per_contact say: {:.1f} steps in the shortest "
        "collision ({}, {:.3g} s); "
        "stable below a fifth of it",
        choice.shortestContact / choice.step, pair, choice.shortestContact);
  } else {
    choice.step = choice.shortestContact / scene.accuracy.stepsPerContact;
    choice.rule = fmt::format("the shortest collision ({}, {:.3g} s) divided by steps_per_contact = {:g}; "
                              "stable below a fifth of it",
                              pair, choice.shortestContact, scene.accuracy.stepsPerContact);
  }
  return choice;
}

} // namespace sandglass
