#pragma once
// The thresholds of the vortex states as knobs: of the analysis, and of a sweep's table [thresholds].

#include "analysis/run_facts.h"
#include "analysis/vortex/vortex_measures.h"
#include "analysis/vortex/vortex_rules.h"
#include "sim/scene/parameters.h"

#include <vector>

namespace sandglass::analysis {

/// All have a fallback. `rules` chooses the set; the source's windows and thresholds are what they are.
const std::vector<ParameterSpec>& vortexKnobs();

VortexRules rulesOf(const Parameters& knobs);
VortexGrainThresholds grainThresholdsOf(const Parameters& knobs);
/// The scene's tank, or the one that knobs describe. Throws InputError when neither does.
VortexTank tankOf(const Parameters& knobs, const RunFacts& facts);

} // namespace sandglass::analysis
