#include "sim/scene/scene_sections.h"

#include <algorithm>
#include <limits>

namespace sandglass {

namespace {

template <class T> void get(const Parameters& values, const char* key, T& target) {
  if (!values.has(key)) return;
  const ParameterValue& value = values.all().at(key);
  if constexpr (std::is_same_v<T, std::optional<double>>)
    target = std::get<double>(value);
  else
    target = std::get<T>(value);
}

void put(Parameters& values, const char* key, const std::optional<double>& value) {
  if (value) values.set(key, *value);
}

void get(const Parameters& values, std::vector<FieldFactor>& fields) {
  if (!values.has("fields") || !values.has("field_factors")) return;
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  const auto& names = values.texts("fields");
  const auto& factors = values.numbers("field_factors");
  fields.clear();
  for (std::size_t k = 0; k < std::max(names.size(), factors.size()); ++k) // checks find what is left over
    fields.push_back({k < names.size() ? names[k] : "", k < factors.size() ? factors[k] : missing});
}

void put(Parameters& values, const std::vector<FieldFactor>& fields) {
  std::vector<std::string> names;
  std::vector<double> factors;
  for (const FieldFactor& f : fields) {
    names.push_back(f.field);
    factors.push_back(f.factor);
  }
  values.set("fields", names);
  values.set("field_factors", factors);
}

constexpr const char* axes[] = {"x", "y", "z"};

} // namespace

void load(const Parameters& values, Scene& scene) {
  get(values, "title", scene.title);
  get(values, "description", scene.description);
  auto seed = static_cast<std::int64_t>(scene.seed);
  get(values, "seed", seed);
  scene.seed = static_cast<std::uint64_t>(seed);
  get(values, "solver", scene.solver);
  get(values, "gravity", scene.gravity);
}

Parameters store(const Scene& scene) {
  Parameters values;
  values.set("title", scene.title);
  values.set("description", scene.description);
  values.set("seed", static_cast<std::int64_t>(scene.seed));
  values.set("solver", scene.solver);
  values.set("gravity", scene.gravity);
  return values;
}

void load(const Parameters& values, Domain& domain) {
  get(values, "lower", domain.lower);
  get(values, "upper", domain.upper);
  std::vector<std::string> periodic;
  get(values, "periodic", periodic);
  for (std::size_t k = 0; k < 3; ++k)
    domain.periodic[k] = std::find(periodic.begin(), periodic.end(), axes[k]) != periodic.end();
}

Parameters store(const Domain& domain) {
  Parameters values;
  values.set("lower", domain.lower);
  values.set("upper", domain.upper);
  std::vector<std::string> periodic;
  for (std::size_t k = 0; k < 3; ++k)
    if (domain.periodic[k]) periodic.emplace_back(axes[k]);
  values.set("periodic", periodic);
  return values;
}

void load(const Parameters& values, WedgeSpec& wedge) {
  get(values, "angle", wedge.angle);
  get(values, "axis", wedge.axis);
}

Parameters store(const WedgeSpec& wedge) {
  Parameters values;
  values.set("angle", wedge.angle);
  values.set("axis", wedge.axis);
  return values;
}

void load(const Parameters& values, Material& material) {
  get(values, "name", material.name);
  get(values, "density", material.density);
  double share = 1.0; // not kept: the density is what counts
  get(values, "mass_share", share);
  material.density *= share;
  get(values, "youngs_modulus", material.youngsModulus);
  get(values, "poisson_ratio", material.poissonRatio);
}

Parameters store(const Material& material) {
  Parameters values;
  values.set("name", material.name);
  if (material.density > 0) values.set("density", material.density);
  put(values, "youngs_modulus", material.youngsModulus);
  put(values, "poisson_ratio", material.poissonRatio);
  return values;
}

void load(const Parameters& values, ContactSpec& contact) {
  std::vector<std::string> between;
  get(values, "between", between);
  if (between.size() != 2) return;
  contact.first = between[0];
  contact.second = between[1];
}

Parameters store(const ContactSpec& contact) {
  Parameters values;
  values.set("between", std::vector<std::string>{contact.first, contact.second});
  return values;
}

void load(const Parameters& values, Species& species) {
  get(values, "name", species.name);
  get(values, "material", species.material);
  get(values, "frozen", species.frozen);
}

Parameters store(const Species& species) {
  Parameters values;
  values.set("name", species.name);
  values.set("material", species.material);
  if (species.frozen) values.set("frozen", true);
  return values;
}

void load(const Parameters& values, WallSpec& wall) {
  get(values, "name", wall.name);
  get(values, "material", wall.material);
}

Parameters store(const WallSpec& wall) {
  Parameters values;
  values.set("name", wall.name);
  values.set("material", wall.material);
  return values;
}

void load(const Parameters& values, FieldSpec& field) {
  get(values, "name", field.name);
}

Parameters store(const FieldSpec& field) {
  Parameters values;
  values.set("name", field.name);
  return values;
}

void load(const Parameters& values, OutletSpec& outlet) {
  get(values, "name", outlet.name);
  get(values, "point", outlet.point);
  get(values, "normal", outlet.normal);
  get(values, "record", outlet.record);
}

void load(const Parameters& values, RecycleSpec& recycle) {
  get(values, "lower", recycle.lower);
  get(values, "upper", recycle.upper);
  get(values, "velocity", recycle.velocity);
}

Parameters store(const RecycleSpec& recycle) {
  Parameters values;
  values.set("lower", recycle.lower);
  values.set("upper", recycle.upper);
  values.set("velocity", recycle.velocity);
  return values;
}

Parameters store(const OutletSpec& outlet) {
  Parameters values;
  values.set("name", outlet.name);
  values.set("point", outlet.point);
  values.set("normal", outlet.normal);
  if (outlet.record) values.set("record", true);
  return values;
}

void load(const Parameters& values, FillSpec& fill) {
  get(values, "stage", fill.stage);
  std::string species;
  get(values, "species", species);
  if (!species.empty()) fill.mixture = {{species, 1.0}};
  std::string by;
  get(values, "by", by);
  fill.byMass = by == "mass";
}

Parameters store(const FillSpec& fill) {
  Parameters values;
  values.set("stage", fill.stage);
  values.set("by", std::string(fill.byMass ? "mass" : "number"));
  return values;
}

void load(const Parameters& values, Share& share) {
  get(values, "species", share.species);
  get(values, "fraction", share.fraction);
}

Parameters store(const Share& share) {
  Parameters values;
  values.set("species", share.species);
  values.set("fraction", share.fraction);
  return values;
}

void load(const Parameters& values, StageSpec& stage) {
  get(values, "name", stage.name);
  get(values, "remove_walls", stage.removeWalls);
  get(values, stage.fields);
  get(values, "drag", stage.drag);
  get(values, "duration", stage.duration);
  get(values, "settled", stage.settledKineticEnergy);
  get(values, "settled_speed", stage.settledSpeed);
  get(values, "settled_after", stage.settledAfter);
  get(values, "empty", stage.untilEmpty);
  get(values, "mass_discharged", stage.massDischarged);
  get(values, "quiet", stage.quietTime);
  get(values, "recirculations", stage.recirculations);
}

Parameters store(const StageSpec& stage) {
  Parameters values;
  values.set("name", stage.name);
  values.set("remove_walls", stage.removeWalls);
  put(values, stage.fields);
  put(values, "drag", stage.drag);
  return values;
}

Parameters storeUntil(const StageSpec& stage) {
  Parameters values;
  put(values, "duration", stage.duration);
  put(values, "settled", stage.settledKineticEnergy);
  put(values, "settled_speed", stage.settledSpeed);
  values.set("settled_after", stage.settledAfter);
  values.set("empty", stage.untilEmpty);
  put(values, "mass_discharged", stage.massDischarged);
  put(values, "quiet", stage.quietTime);
  put(values, "recirculations", stage.recirculations);
  return values;
}

void load(const Parameters& values, EventSpec& event) {
  get(values, "step", event.step);
  if (values.has("gravity")) event.gravity = values.vector("gravity");
  get(values, "drag", event.drag);
  get(values, "remove_walls", event.removeWalls);
  get(values, event.fields);
  get(values, "pace_walls", event.paceWalls);
  get(values, "pace", event.pace);
  get(values, "end_stage", event.endStage);
}

Parameters store(const EventSpec& event) {
  Parameters values;
  values.set("step", event.step);
  if (event.gravity) values.set("gravity", *event.gravity);
  put(values, "drag", event.drag);
  values.set("remove_walls", event.removeWalls);
  put(values, event.fields);
  values.set("pace_walls", event.paceWalls);
  put(values, "pace", event.pace);
  values.set("end_stage", event.endStage);
  return values;
}

void load(const Parameters& values, ProbeSpec& probe) {
  get(values, "name", probe.name);
  get(values, "interval", probe.interval);
}

Parameters store(const ProbeSpec& probe) {
  Parameters values;
  values.set("name", probe.name);
  values.set("interval", probe.interval);
  return values;
}

void load(const Parameters& values, OutputSpec& output) {
  get(values, "frame_interval", output.frameInterval);
  get(values, "checkpoint_interval", output.checkpointInterval);
  get(values, "quantities", output.quantities);
  get(values, "contacts", output.contacts);
  std::string positions;
  get(values, "positions", positions);
  output.singlePrecisionPositions = positions == "single";
}

Parameters store(const OutputSpec& output) {
  Parameters values;
  values.set("frame_interval", output.frameInterval);
  values.set("checkpoint_interval", output.checkpointInterval);
  values.set("quantities", output.quantities);
  values.set("contacts", output.contacts);
  values.set("positions", std::string(output.singlePrecisionPositions ? "single" : "double"));
  return values;
}

void load(const Parameters& values, AccuracySpec& accuracy) {
  get(values, "level", accuracy.level);
  accuracy.stepsPerContact = accuracy.level == "draft" ? 15 : accuracy.level == "reference" ? 50 : 25;
  get(values, "steps_per_contact", accuracy.stepsPerContact);
  get(values, "time_step", accuracy.timeStep);
  get(values, "stiffness_scale", accuracy.stiffnessScale);
  std::string precision, arithmetic;
  get(values, "precision", precision);
  accuracy.mixedPrecision = precision == "mixed";
  get(values, "arithmetic", arithmetic);
  accuracy.fastArithmetic = arithmetic == "fast";
  std::string integrator;
  get(values, "integrator", integrator);
  accuracy.semiImplicit = integrator == "semi_implicit";
  get(values, "skin", accuracy.skin);
  get(values, "maximum_overlap", accuracy.maximumOverlap);
  get(values, "maximum_travel", accuracy.maximumTravel);
}

Parameters store(const AccuracySpec& accuracy) {
  Parameters values;
  values.set("level", accuracy.level);
  values.set("steps_per_contact", accuracy.stepsPerContact);
  put(values, "time_step", accuracy.timeStep);
  values.set("stiffness_scale", accuracy.stiffnessScale);
  values.set("precision", std::string(accuracy.mixedPrecision ? "mixed" : "double"));
  values.set("arithmetic", std::string(accuracy.fastArithmetic ? "fast" : "portable"));
  values.set("integrator", std::string(accuracy.semiImplicit ? "semi_implicit" : "leapfrog"));
  values.set("skin", accuracy.skin);
  values.set("maximum_overlap", accuracy.maximumOverlap);
  values.set("maximum_travel", accuracy.maximumTravel);
  return values;
}

} // namespace sandglass
