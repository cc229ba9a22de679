#include "analysis/run_facts.h"

#include <cmath>

namespace sandglass::analysis {

namespace {

/// Length of the domain along a direction that is a periodic axis.
std::optional<double> periodAlong(const Domain& domain, const Vec3& direction) {
  for (int k = 0; k < 3; ++k)
    if (domain.periodic[k] && std::abs(direction.normalized()[k]) == 1)
      return domain.upper[k] - domain.lower[k];
  return std::nullopt;
}

} // namespace

RunFacts factsOf(const Scene& scene) {
  RunFacts facts;
  facts.gravity = scene.gravity.norm();
  if (facts.gravity > 0) facts.up = -scene.gravity / facts.gravity;
  for (const auto& stage : scene.stages)
    facts.gates.insert(facts.gates.end(), stage.removeWalls.begin(), stage.removeWalls.end());
  for (const auto& wall : scene.walls) {
    const Parameters& p = wall.shape.parameters;
    if (facts.shape) break;
    if (wall.shape.kind == "wedge") {
      facts.shape = OutletShape::slot;
      facts.outlet = p.number("outlet");
      facts.halfAngle = p.number("half_angle");
      facts.outletCentre = p.vector("centre");
      const Vec3 up = p.vector("up").normalized(), along = p.vector("along");
      facts.slot = Slot{p.vector("centre"), up.cross((along - along.dot(up) * up).normalized()), up,
                        p.number("outlet"), p.number("width")};
      facts.slotDepth = periodAlong(scene.domain, p.vector("along"));
    } else if (wall.shape.kind == "cone_hopper") {
      facts.shape = OutletShape::circle;
      facts.outlet = p.number("outlet");
      facts.halfAngle = p.number("half_angle");
      facts.outletCentre = p.vector("base");
    }
  }
  facts.sector = scene.sector();
  facts.tank = tankOf(scene);
  for (const auto& outlet : scene.outlets)
    if (outlet.record && !facts.wayOut) facts.wayOut = outlet.normal.normalized();
  for (const auto& species : scene.species) {
    const double density = scene.material(species.material).density;
    facts.densities.push_back(density);
    if (&species == &scene.species.front())
      facts.grainDensity = density;
    else if (density != facts.grainDensity)
      facts.grainDensity = 0;
  }
  for (const auto& probe : scene.probes) {
    if (facts.flowProbe.empty() && probe.what.kind == "flow_rate") facts.flowProbe = probe.name;
    if (facts.energyProbe.empty() && probe.what.kind == "energies") facts.energyProbe = probe.name;
  }
  return facts;
}

} // namespace sandglass::analysis
