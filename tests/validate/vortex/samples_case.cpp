// The samples vortex_tank, vortex_spout and vortex_manual against what they should come to.

#include "analysis/vortex/vortex_states.h"
#include "analysis/vortex/vortex_tank.h"
#include "analysis/vortex/vortex_theory.h"
#include "sim/run/run.h"
#include "tests/validate/vortex/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::validate {

namespace {

Scene sample(const std::string& name) {
  return readScene(SANDGLASS_SOURCE_DIR "/sample_runs/" + name + "/scene.toml");
}

/// A run in full, looked at each millisecond.
analysis::VortexMeasures measured(Scene scene) {
  scene.output.frameInterval = 1e-3;
  analysis::VortexMeasures measures(analysis::tankOf(scene).value(), {}, scene.materials[0].density);
  Run run(scene, {});
  run.onSavedFrame = [&](const FramePtr& frame) { measures.add(*frame); };
  run.execute();
  return measures;
}

bool spouts(analysis::VortexState state) {
  return state == analysis::VortexState::smallSpout || state == analysis::VortexState::largeSpout;
}

double rotationOf(const Scene& scene) {
  const auto at = std::find_if(scene.fields.begin(), scene.fields.end(),
                               [](const FieldSpec& f) { return f.name == "rotation"; });
  return at->what.parameters.number("angular_velocity");
}

// A bead at the wall that nothing holds back is drawn along by dv/dt = (c1 (u - v) + c2 (u - v)^2) / m, so
// that u - v = (c1/c2) / ((1 + c1 / (c2 u)) exp(c1 t / m) - 1): no bed turns faster.
double freeSpinUp(double radius, double density, double distance, double rotation, double time) {
  const double c1 = 1.55e-4 * 2 * radius, c2 = 0.22 * 4 * radius * radius, u = rotation * distance,
               m = 4.0 / 3.0 * M_PI * std::pow(radius, 3) * density;
  return (u - c1 / c2 / ((1 + c1 / (c2 * u)) * std::exp(c1 * time / m) - 1)) / distance;
}

void tankAndSpout(Report& report) {
  const Scene tank = sample("vortex_tank");
  const auto slow = measured(tank);
  // The flow turns about -z.
  const double turned = -slow.samples().back().rotation;
  report.between("samples", "vortex_tank: rotation of the bed at 5 s over that of beads without friction",
                 turned / freeSpinUp(4e-3, 1e4, 0.056, rotationOf(tank), 5), 0, 0, 1, "drag law integrated");
  report.between("samples", "vortex_tank: rotation of the bed at 5 s over that of the fluid",
                 turned / rotationOf(tank), 0, 0.01, 0.4,
                 "re-run of Rice's listing over all radii: 0.01 to 0.4");
  const Scene fountain = sample("vortex_spout");
  const auto fast = measured(fountain);
  const auto verdict = vortexVerdict(fast, analysis::ownVortexRules());
  report.between("samples", "vortex_spout: our rules see a spout", spouts(verdict.state), 0, 1, 1,
                 "the scene's purpose");
  report.between("samples", "vortex_spout: rotation of the bed over that of the fluid",
                 -analysis::bedRotation(fast) / rotationOf(fountain), 0, 0.4, 1,
                 "held back by the friction of the wall");
}

Vec3 along(const Frame& frame, int grain) {
  return frame.vector(quantity::velocity).at(static_cast<std::size_t>(grain));
}

void manual(Report& report) {
  FramePtr first, last;
  Run run(sample("vortex_manual"), {});
  run.onSavedFrame = [&](const FramePtr& frame) {
    if (!first) first = frame;
    last = frame;
  };
  run.execute();
  const Frame& f = *last;
  const auto spin = [&](const FramePtr& frame, int k) {
    return frame->vector(quantity::spin).at(static_cast<std::size_t>(k));
  };
  const auto zero = [&](const std::string& what, double value, double bound, const char* why) {
    report.between("samples", "vortex_manual: " + what, value, 0, 0, bound, why);
  };
  for (const int k : {0, 2, 4, 6})
    zero(fmt::format("momentum of the pair {} and {} over m v", k, k + 1),
         (along(f, k) + along(f, k + 1)).norm(), 1e-10, "conservation");
  zero("sideways speed of the head-on pair [m/s]", std::abs(along(f, 0).y()), 1e-9, "symmetry");
  zero("sideways speed of the counter-spinning pair [m/s]", std::abs(along(f, 2).y()), 1e-9,
       "surfaces that roll on each other do not slip");
  zero("its change of spin [rad/s]", (spin(last, 2) - spin(first, 2)).norm(), 1e-6, "the same");
  // About the axis of the tank, over the mass; 2/5 m r^2 is the moment of inertia.
  const auto angular = [&](const FramePtr& frame, int k) {
    return (frame->position.at(static_cast<std::size_t>(k)).cross(along(*frame, k)) +
            0.4 * 6e-3 * 6e-3 * spin(frame, k))
        .z();
  };
  const double before = angular(first, 4) + angular(first, 5);
  zero("relative change of the angular momentum of the pair with equal spins",
       std::abs((angular(last, 4) + angular(last, 5)) / before - 1), 1e-10, "conservation");
  report.between("samples", "vortex_manual: sideways speed that their spins give them [m/s]",
                 std::abs(along(f, 4).dot(Vec3(-1, 1, 0).normalized())), 0, 0.3, 1,
                 "apart from each other; hard beads: mu (1 + e) v = 0.45");
  zero("difference of the spins of that pair [rad/s]", (spin(last, 4) - spin(last, 5)).norm(), 1e-6,
       "mirror symmetry");
  for (const int k : {8, 9})
    zero(fmt::format("sideways speed and r times spin of the bead {} at the wall [m/s]", k),
         std::abs(along(f, k).y()) + 6e-3 * spin(last, k).norm(), 1e-9, "symmetry");
  for (const int k : {10, 11})
    report.near("samples", fmt::format("vortex_manual: sideways speed of the spinning bead {} [m/s]", k),
                std::abs(along(f, k).y()), 0,
                std::min(0.3 * (1 + std::abs(along(f, k).x())), 2.0 / 7.0 * 6e-3 * 1000), 0.1,
                "min(2 r w / 7, mu (1 + e) v)");
}

} // namespace

std::string judgeSamples(Report& report) {
  tankAndSpout(report);
  manual(report);
  return "The scenes `sample_runs/vortex_tank`, `vortex_spout` and `vortex_manual` in full, the first two "
         "looked "
         "at each millisecond.";
}

} // namespace sandglass::validate
