// What a run will cost, found by trying: a periodic block of the scene's own grains and laws, run for a
// moment.

#include "sim/base/random.h"
#include "sim/contact/head_on.h"
#include "sim/fields/field_registry.h"
#include "sim/grains/seeding.h"
#include "sim/solvers/dem/dem_solver.h"
#include "sim/solvers/dem/step_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sandglass {

namespace {

struct Trial {
  double secondsPerGrainStep = 0, bytesPerGrain = 0;
};

/// A dense block (simple cubic, 1 % overlap at the mean diameter, slightly stirred) without walls or gravity.
Trial tryOut(const Scene& scene) {
  constexpr int side = 14, steps = 60;
  Scene block = scene;
  const Species& species = scene.species.front();
  const double d = sizeRange(scene, species).meanDiameter;
  const double pitch = 0.99 * d;
  block.walls.clear();
  block.probes.clear();
  block.outlets.clear();
  block.fields.clear();
  block.gravity = Vec3::Zero();
  block.output = {};
  block.accuracy.maximumOverlap = 1e9;
  block.wedge.reset();
  block.domain = {Vec3::Zero(), Vec3::Constant(side * pitch), {true, true, true}};
  SolverOptions one;
  one.threads = 1;
  DemSolver solver(block, one);
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < side * side * side; ++k) {
    RandomStream random(scene.seed, RandomPurpose::grainVelocity, k);
    GrainSeed s;
    s.id = k;
    s.radius = 0.5 * d;
    s.position = pitch * (Vec3(k % side, k / side % side, k / side / side) + Vec3::Constant(0.5));
    s.velocity = 1e-3 * d / solver.stepSize() * random.direction();
    seeds.push_back(s);
  }
  solver.add(seeds);
  solver.advance(10);
  const auto start = std::chrono::steady_clock::now();
  solver.advance(steps);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  return {spent.count() / (static_cast<double>(seeds.size()) * steps), solver.bytesPerGrain()};
}

/// What the cut-offs of forces across gaps leave out, one sentence for each law and two materials that meet.
void tellCutOffs(const Scene& scene, const LawStack& laws, std::vector<std::string>& lines) {
  const auto grains = [&](int material) {
    return std::any_of(scene.species.begin(), scene.species.end(),
                       [&](const Species& s) { return s.material == scene.materials[material].name; });
  };
  for (const auto& entry : laws.entries())
    for (int a = 0; a < laws.materials(); ++a)
      for (int b = 0; b < laws.materials(); ++b) {
        const int type = laws.typeOf(a, b);
        const PairType& pair = laws.context().types[type];
        if (!pair.used || !grains(a) || (grains(b) && b < a)) continue; // the grain comes first
        const std::string text = entry.law->truncation(type, pair.largestEffectiveRadius, !grains(b));
        if (!text.empty())
          lines.push_back(
              fmt::format("{} of {} on {}: {}", entry.name, pair.materialA, pair.materialB, text));
      }
}

} // namespace

Forecast forecast(const Scene& scene) {
  const LawStack laws(scene);
  Forecast f;
  f.step = chooseStep(scene, laws);
  f.grains = expectedGrains(scene);
  const Trial trial = tryOut(scene);
  f.secondsPerGrainStep = trial.secondsPerGrainStep;
  f.bytesPerGrain = trial.bytesPerGrain;

  for (const auto& entry : laws.entries()) {
    const LawKind* kind = findLaw(entry.role, entry.name);
    f.modelled.push_back(fmt::format("{}: {}; {} bytes of history a pair", entry.name,
                                     kind ? kind->description : "a law of the program",
                                     8 * entry.law->historySize()));
  }
  for (const std::string& line : restitutionReport(scene, impactSpeed(scene), f.step.step))
    f.modelled.push_back(line);
  tellCutOffs(scene, laws, f.modelled);
  const bool periodic = scene.domain.periodic[0] || scene.domain.periodic[1] || scene.domain.periodic[2];
  const auto tell = [&](bool used, const std::string& feature, const std::string& cost) {
    (used ? f.modelled : f.notModelled).push_back(used ? feature + "; " + cost : feature);
  };
  tell(laws.turning(), "spin of grains", "32 bytes a grain");
  tell(laws.readsSpin(), "couples of rolling and torsion", "one more look at each pair that touches");
  tell(laws.range() > 0.0, "forces across a gap", fmt::format("lists reach {:.3g} m further", laws.range()));
  tell(periodic, "periodic directions", "12 bytes a grain, 1 byte a pair");
  tell(scene.wedge.has_value(), "a wedge with images across its faces", "paid by the grains near a face");
  tell(std::any_of(scene.species.begin(), scene.species.end(), [](const Species& s) { return s.frozen; }),
       "frozen grains", "a look at each of them a step");
  tell(!scene.walls.empty(), "walls", "paid by the grains that are near one");
  tell(fastestWall(scene) > 0.0, "moving walls", "grains near them are listed a little further out");
  for (const FieldSpec& field : scene.fields)
    if (const FieldKind* kind = findField(field.what.kind))
      f.modelled.push_back(fmt::format("field {}: {}; {}", field.name, kind->description, kind->cost));
  if (scene.fields.empty()) f.notModelled.push_back("fields: winds, drags, shields");
  tell(!scene.outlets.empty(), "outlets", "one look at each grain every 50 steps");
  const auto anyOutlet = [&](auto&& does) {
    return std::any_of(scene.outlets.begin(), scene.outlets.end(), does);
  };
  const auto shows = [&](const char* name) {
    const auto& list = scene.output.quantities;
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  tell(anyOutlet([](const OutletSpec& o) { return o.recycle.has_value(); }) || shows(quantity::life),
       "recycling of grains, lives", "4 bytes a grain, a list made anew whenever grains come back");
  tell(anyOutlet([](const OutletSpec& o) { return o.record; }) || shows(quantity::residenceTime),
       "residence times", "8 bytes a grain");
  tell(std::any_of(scene.stages.begin(), scene.stages.end(),
                   [](const StageSpec& s) { return s.drag.has_value(); }),
       "drag while settling", "one more look at each grain's velocity a step");
  tell(scene.gravity.norm() > 0.0, "gravity", "no memory");
  return f;
}

} // namespace sandglass
