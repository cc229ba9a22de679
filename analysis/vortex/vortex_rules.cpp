#include "analysis/vortex/vortex_rules.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <array>

namespace sandglass::analysis {

const char* nameOf(VortexState state) {
  static constexpr std::array names{"unresolved", "flat", "fluid", "pinned", "small spout", "large spout"};
  return names[static_cast<std::size_t>(state)];
}

VortexRules listedVortexRules() {
  return {.name = "listed",
          .pinnedAddsUp = true,
          .settleWindow = 500,
          .settleDrift = 3e-5,
          .fluidWindow = 1500,
          .pinnedWindow = 2000,
          .spoutWindow = 2000};
}

VortexRules textVortexRules() {
  VortexRules rules = listedVortexRules();
  rules.name = "text";
  rules.pinnedAddsUp = false;
  rules.pinnedAtWall = rules.spoutsApart = true;
  return rules;
}

VortexRules ownVortexRules() {
  return {.name = "own",
          .sliding = true,
          .settleWindow = 0.5,
          .settleDrift = 0.05,
          .fluidWindow = 1.5,
          .pinnedWindow = 1.5,
          .pinnedCoreShare = 0.25,
          .spoutWindow = 1.5,
          .spoutShare = 0.9,
          .spoutLeast = 0.02,
          .spoutCore = 0.1};
}

VortexRules vortexRules(const std::string& name) {
  for (const auto& rules : {ownVortexRules(), textVortexRules(), listedVortexRules()})
    if (rules.name == name) return rules;
  throw InputError(fmt::format("there are no rules '{}' for the states of a vortex; there are own, text and "
                               "listed",
                               name));
}

std::vector<std::pair<std::string, double>> VortexRules::thresholds() const {
  return {{"settle_window", settleWindow}, {"settle_drift", settleDrift},
          {"height_limit", heightLimit},   {"fluid_window", fluidWindow},
          {"fluid_share", fluidShare},     {"fluid_violations", fluidViolations},
          {"pinned_window", pinnedWindow}, {"pinned_share", pinnedShare},
          {"pinned_core", pinnedCore},     {"pinned_core_share", pinnedCoreShare},
          {"spout_window", spoutWindow},   {"spout_share", spoutShare},
          {"spout_least", spoutLeast},     {"spout_small", spoutSmall},
          {"spout_large", spoutLarge},     {"spout_core", spoutCore}};
}

} // namespace sandglass::analysis
