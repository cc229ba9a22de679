#include "analysis/sweep/sweep_classes.h"

#include "analysis/vortex/vortex_rules.h"

#include <algorithm>

namespace sandglass::analysis {

std::vector<std::string> orderOfClasses(const std::set<std::string>& names) {
  std::vector<std::string> states;
  for (int s = 0; s <= static_cast<int>(VortexState::largeSpout); ++s)
    states.emplace_back(nameOf(static_cast<VortexState>(s)));
  const bool areStates = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return name == failedName || std::find(states.begin(), states.end(), name) != states.end();
  });
  if (!areStates) return {names.begin(), names.end()};
  if (names.contains(failedName)) states.emplace_back(failedName);
  return states;
}

bool isRotation(const std::string& unit) {
  return unit == "rad/s" || unit == "1/s";
}

} // namespace sandglass::analysis
