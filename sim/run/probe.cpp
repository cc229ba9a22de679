#include "sim/run/probe.h"

#include "sim/base/error.h"
#include "sim/run/flow_rate_probe.h"

#include <fmt/format.h>

#include <numbers>

namespace sandglass {

namespace {

class EnergiesProbe final : public Probe {
public:
  std::vector<std::string> values() const override {
    return {"translational", "rotational", "gravitational", "elastic", "total"};
  }
  std::vector<double> sample(const Solver& solver) override {
    const Energies e = solver.energies();
    return {e.translational, e.rotational, e.gravitational, e.elastic, e.total()};
  }
};

class MassInRegionProbe final : public Probe {
public:
  MassInRegionProbe(const Parameters& p, const Scene& scene)
      : scene_(scene), lower_(p.vector("lower")), upper_(p.vector("upper")) {}
  std::vector<std::string> values() const override { return {"mass", "grains"}; }
  std::vector<double> sample(const Solver& solver) override {
    double mass = 0;
    std::int64_t grains = 0;
    for (const auto& grain : solver.present()) {
      const auto x = grain.position.array();
      if (!((x >= lower_.array()).all() && (x < upper_.array()).all())) continue;
      mass += grainMass(scene_, grain);
      ++grains;
    }
    return {mass, static_cast<double>(grains)};
  }

private:
  const Scene& scene_;
  Vec3 lower_, upper_;
};

class WallForceProbe final : public Probe {
public:
  explicit WallForceProbe(const Parameters& p) : wall_(p.text("wall")) {}
  std::vector<std::string> values() const override {
    return {"force.x",  "force.y", "force.z", "torque.x",  "torque.y",
            "torque.z", "power",   "work",    "wear_work", "collisions"};
  }
  std::vector<double> sample(const Solver& solver) override {
    for (const auto& wall : solver.walls())
      if (wall.name == wall_)
        return {wall.force.x(),  wall.force.y(), wall.force.z(), wall.torque.x(), wall.torque.y(),
                wall.torque.z(), wall.power,     wall.work,      wall.wearWork,   double(wall.collisions)};
    return std::vector<double>(values().size()); // a solver may drop a wall once a stage has removed it
  }

private:
  std::string wall_;
};

} // namespace

double grainMass(const Scene& scene, const GrainSeed& grain) {
  const double density = scene.material(scene.species.at(grain.species).material).density;
  return density * (4.0 / 3.0 * std::numbers::pi) * grain.radius * grain.radius * grain.radius;
}

std::unique_ptr<Probe> makeProbe(const ProbeSpec& spec, const Scene& scene) {
  const auto& [kind, parameters] = spec.what;
  if (kind == "energies") return std::make_unique<EnergiesProbe>();
  if (kind == "mass_in_region") return std::make_unique<MassInRegionProbe>(parameters, scene);
  if (kind == "flow_rate") return std::make_unique<FlowRateProbe>(parameters, scene);
  if (kind == "wall_force") return std::make_unique<WallForceProbe>(parameters);
  throw InputError(
      fmt::format("the probe '{}' is of the kind '{}'; there are energies, mass_in_region, flow_rate "
                  "and wall_force",
                  spec.name, kind));
}

} // namespace sandglass
