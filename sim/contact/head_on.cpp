#include "sim/contact/head_on.h"

#include "sim/grains/seeding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass {

namespace {

constexpr const char* clamp = "clamp_attraction";

Scene withClampTurned(Scene scene) {
  for (ContactSpec& c : scene.contacts)
    if (c.normal.parameters.has(clamp)) c.normal.parameters.set(clamp, !c.normal.parameters.boolean(clamp));
  return scene;
}

/// Mean radius of the grains of a material; infinite for a wall's.
double meanRadius(const Scene& scene, const std::string& material) {
  double sum = 0.0;
  int count = 0;
  for (const Species& s : scene.species)
    if (s.material == material) {
      sum += 0.5 * sizeRange(scene, s).meanDiameter;
      ++count;
    }
  return count == 0 ? std::numeric_limits<double>::infinity() : sum / count;
}

} // namespace

double headOnRestitution(const LawStack& laws, int type, double mass, double radius, double speed,
                         double step, double phase) {
  double time = std::numeric_limits<double>::infinity();
  for (const auto& entry : laws.entries())
    if (entry.role == LawRole::normal)
      time = std::min(time, entry.law->collisionTime(type, mass, radius, speed));
  ContactBlock b{};
  b.size = 1;
  b.oneType = false;
  b.type[0] = type;
  b.nx[0] = 1.0;
  b.dt = step > 0.0 ? step : time / 2000;
  b.radiusA[0] = b.radiusB[0] = 2.0 * radius;
  b.inverseMassA[0] = b.inverseMassB[0] = 0.5 / mass;
  b.effectiveRadius[0] = radius;
  b.effectiveMass[0] = mass;
  // v: relative velocity, positive when parting
  double overlap = -phase * b.dt * speed, v = -speed, force = 0.0;
  for (int k = 0; k < 200000; ++k) {
    v += 0.5 * b.dt * force / mass;
    overlap -= b.dt * v;
    b.overlap[0] = overlap;
    b.vn[0] = v;
    clearForces(b, false);
    for (const auto& entry : laws.entries())
      if (entry.role == LawRole::normal) entry.law->apply(b, entry.firstHistory, KernelWidth::plain);
    force = b.normalForce[0];
    v += 0.5 * b.dt * force / mass;
    if (overlap <= 0.0 && v > 0.0 && force == 0.0) return v / speed;
  }
  return 0.0;
}

std::pair<double, double> restitutionAtStep(const LawStack& laws, int type, double mass, double radius,
                                            double speed, double step) {
  constexpr int phases = 16;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (int k = 0; k < phases; ++k) {
    const double e = headOnRestitution(laws, type, mass, radius, speed, step, (k + 0.5) / phases);
    least = std::min(least, e);
    most = std::max(most, e);
  }
  return {least, most};
}

std::vector<std::string> restitutionReport(const Scene& scene, double speed, double step) {
  const LawStack laws(scene), turned(withClampTurned(scene));
  std::vector<std::string> lines;
  for (const ContactSpec& c : scene.contacts) {
    const auto index = [&](const std::string& name) {
      return static_cast<int>(std::find_if(scene.materials.begin(), scene.materials.end(),
                                           [&](const Material& m) { return m.name == name; }) -
                              scene.materials.begin());
    };
    const int type = laws.typeOf(index(c.first), index(c.second));
    const PairType& pair = laws.context().types[type];
    if (!pair.used) continue;
    const double radius = 1.0 / (1.0 / meanRadius(scene, c.first) + 1.0 / meanRadius(scene, c.second));
    const double exact = headOnRestitution(laws, type, pair.referenceMass, radius, speed);
    std::string line = fmt::format("restitution of {} on {}, head on at {:.3g} m/s: {:.3f}", c.first,
                                   c.second, speed, exact);
    if (step > 0.0) {
      const auto [least, most] = restitutionAtStep(laws, type, pair.referenceMass, radius, speed, step);
      line += fmt::format("; {:.3f} to {:.3f} with the step of this scene, by where between two steps they "
                          "meet{}",
                          least, most,
                          std::max(most - exact, exact - least) > 0.02 * std::max(exact, 0.05)
                              ? " (a smaller step brings it nearer)"
                              : "");
    }
    if (c.normal.parameters.has(clamp))
      line += fmt::format("; {:.3f} with the dashpot's attraction {}",
                          headOnRestitution(turned, type, pair.referenceMass, radius, speed),
                          c.normal.parameters.boolean(clamp) ? "left in" : "cut off");
    lines.push_back(line);
  }
  return lines;
}

} // namespace sandglass
