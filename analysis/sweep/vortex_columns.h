#pragma once
// What the table of a sweep keeps of a bed in a vortex.

#include "analysis/sweep/sweep_table.h"
#include "analysis/vortex/vortex_measures.h"
#include "analysis/vortex/vortex_rules.h"

namespace sandglass::analysis {

/// `state` and its start, confidence and settling by `rules`, `state_text` and `state_listed` by the
/// source's, and what they are told from.
std::vector<std::pair<SweepColumn, SweepValue>> vortexColumns(const VortexMeasures& measures,
                                                              const Frame& last, const VortexRules& rules);

/// Those of vortexResults() that are told from all frames, against time.
std::vector<Curve> vortexCurves(const VortexMeasures& measures, const VortexRules& rules);

} // namespace sandglass::analysis
