#pragma once
// One run of a sweep, in memory: nothing is written, frames pass by and are forgotten, and what is left is a
// row of the table, curves and the last frame.

#include "analysis/sweep/sweep_plan.h"
#include "analysis/sweep/sweep_table.h"

#include <atomic>

namespace sandglass::analysis {

/// Runs on one thread, whatever the scene says. A fault becomes the outcome's sentence, never an exception.
/// Nothing when `stop` was set before the end.
std::optional<SweepOutcome> runPoint(const SweepPlan& plan, const SweepPoint& point, std::uint64_t seed,
                                     const std::atomic<bool>& stop,
                                     const std::function<void(double fraction)>& onProgress = {});

/// Whether the plan asks for the states of a vortex in this scene: always ("vortex"), or when it has an
/// upright round tank and a field that turns ("auto").
bool tellsVortex(const SweepPlan& plan, const Scene& scene);

/// At most `most` points of a curve, evenly from all.
Curve thinned(Curve curve, std::size_t most);

} // namespace sandglass::analysis
