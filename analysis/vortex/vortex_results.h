#pragma once
// The states of a vortex run as results: curves, the evidence, the surface, a sentence.

#include "analysis/results.h"
#include "analysis/vortex/vortex_measures.h"
#include "analysis/vortex/vortex_rules.h"

namespace sandglass::analysis {

/// Curves `vortex_state`, `vortex_rotation`, `vortex_core`, `vortex_risers`, `vortex_energy` against time,
/// `vortex_surface` against the distance from the axis; tables `vortex_states` (the three sets of rules
/// beside each other) and `vortex_evidence` (what each rule of `rules` found and needs, and all thresholds).
Results vortexResults(const VortexMeasures& measures, const VortexRules& rules);

} // namespace sandglass::analysis
