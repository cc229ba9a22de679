#pragma once
// Which points a sweep runs, and in which order: the same for every start and every number of threads.

#include "analysis/sweep/sweep_plan.h"

#include <functional>

namespace sandglass::analysis {

/// The points of level 0. Grids come coarse first: every second value of each axis after the ones between
/// which they lie.
std::vector<SweepPoint> firstPoints(const SweepPlan& plan);

/// The points to add at `level` (from 1): halfway between neighbours along an axis, as near as points of that
/// level are, for which `differ` holds. `points` are all there are, in the order of their ids.
std::vector<SweepPoint>
refinedPoints(const SweepPlan& plan, const std::vector<SweepPoint>& points, int level,
              const std::function<bool(const SweepPoint&, const SweepPoint&)>& differ);

} // namespace sandglass::analysis
