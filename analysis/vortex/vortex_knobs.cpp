#include "analysis/vortex/vortex_knobs.h"

#include "analysis/kinds/knob_specs.h"
#include "sim/base/error.h"

namespace sandglass::analysis {

const std::vector<ParameterSpec>& vortexKnobs() {
  static const VortexRules own = ownVortexRules();
  static const VortexGrainThresholds grain;
  constexpr double far = 1e6;
  static const std::vector<ParameterSpec> knobs{
      choiceKnob("rules", "own", {"own", "text", "listed"},
                 "ours, or those of the source as its text or its listing has them"),
      numberKnob("settle_window", own.settleWindow, 0, far, "own: of settling [s]", true),
      numberKnob("settle_drift", own.settleDrift, 0, far,
                 "own: change of energy from half to half that is settled"),
      numberKnob(
          "height_limit", 0, 0, far,
          "height above the floor that no grain reaches [m]; 0: the tank's top, at most 20/3 of its radius"),
      numberKnob("window", own.fluidWindow, 0, far, "own: of the states [s]", true),
      numberKnob("fluid_share", own.fluidShare, 0, 1, "own: frames that must be fluid"),
      integerKnob("fluid_violations", 1, 0, 1000, "own: radial bins that may fail to rise"),
      numberKnob("rise", grain.rise, 0, far, "least rise from bin to bin, in grain radii"),
      numberKnob("pinned_share", own.pinnedShare, 0, 1, "own: frames that must be pinned"),
      numberKnob("pinned_core", own.pinnedCore, 0, far, "own: empty core, in grain radii"),
      numberKnob("pinned_core_share", own.pinnedCoreShare, 0, 1, "own: and in tank radii"),
      numberKnob("spout_share", own.spoutShare, 0, 1, "own: frames that must spout"),
      numberKnob("spout_least", own.spoutLeast, 0, far,
                 "own: rising grains of a spout: share of all, or a number from 1"),
      numberKnob("spout_small", own.spoutSmall, 0, 1, "own: share below which it is small"),
      numberKnob("spout_large", own.spoutLarge, 0, 1, "own: share from which it is none"),
      numberKnob("spout_core", own.spoutCore, 0, 1, "own: empty core of a spout at least, in tank radii"),
      numberKnob("spout_reach", grain.spoutReach, 0, 1,
                 "rising grains count this near the axis, in tank radii"),
      numberKnob("riser_step", grain.riserStep, 0, far,
                 "source: rising grain, in radii a frame above the mean"),
      numberKnob("riser_speed", grain.riserSpeed, 0, far, "own: rising grain, in sqrt(g r) above the mean"),
      numberKnob("tank_radius", 0, 0, far, "of a tank that the scene does not say [m]"),
      numberKnob("floor", 0, -far, far, "of such a tank [m]"),
      numberKnob("top", 0, -far, far, "of such a tank [m]")};
  return knobs;
}

VortexTank tankOf(const Parameters& knobs, const RunFacts& facts) {
  VortexTank tank = facts.tank.value_or(VortexTank{});
  if (!facts.tank) {
    if (facts.gravity > 0) tank.gravity = facts.gravity;
    if (facts.up) tank.up = *facts.up;
  }
  if (knobs.number("tank_radius") > 0) tank.radius = knobs.number("tank_radius");
  if (knobs.number("floor") < knobs.number("top")) {
    tank.floor = knobs.number("floor");
    tank.top = knobs.number("top");
  }
  if (!(tank.radius > 0) || !(tank.top > tank.floor))
    throw InputError(
        "the states of a vortex need an upright round tank: the scene has no such cylinder; give "
        "vortex_states.tank_radius, .floor and .top in m");
  return tank;
}

VortexRules rulesOf(const Parameters& knobs) {
  VortexRules rules = vortexRules(knobs.text("rules"));
  rules.heightLimit = knobs.number("height_limit");
  if (!rules.sliding) return rules; // the source's are what they are
  rules.settleWindow = knobs.number("settle_window");
  rules.settleDrift = knobs.number("settle_drift");
  rules.fluidWindow = rules.pinnedWindow = rules.spoutWindow = knobs.number("window");
  rules.fluidShare = knobs.number("fluid_share");
  rules.fluidViolations = static_cast<double>(knobs.integer("fluid_violations"));
  rules.pinnedShare = knobs.number("pinned_share");
  rules.pinnedCore = knobs.number("pinned_core");
  rules.pinnedCoreShare = knobs.number("pinned_core_share");
  rules.spoutShare = knobs.number("spout_share");
  rules.spoutLeast = knobs.number("spout_least");
  rules.spoutSmall = knobs.number("spout_small");
  rules.spoutLarge = knobs.number("spout_large");
  rules.spoutCore = knobs.number("spout_core");
  return rules;
}

VortexGrainThresholds grainThresholdsOf(const Parameters& knobs) {
  return {knobs.number("rise"), knobs.number("riser_step"), knobs.number("riser_speed"),
          knobs.number("spout_reach")};
}

} // namespace sandglass::analysis
