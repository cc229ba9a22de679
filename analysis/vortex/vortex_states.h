#pragma once
// The state of a bed in a vortex, from the numbers that VortexMeasures keeps of each frame: at the end of the
// run or at any frame before, by any of the sets of rules in vortex_rules.h.

#include "analysis/vortex/vortex_measures.h"
#include "analysis/vortex/vortex_rules.h"

#include <optional>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// What one rule found.
struct VortexEvidence {
  std::string rule; ///< "settled", "fluid", "pinned", "small spout", "large spout"
  bool holds = false;
  double found = 0;    ///< what was measured, as `measure` says; NaN: not enough frames
  double needed = 0;   ///< what it must reach (settled: must not exceed)
  std::string measure; ///< "share of frames whose surface rises outwards", ...
  double since = 0;    ///< [s] start of the window in which it holds; NaN when it does not
};

struct VortexVerdict {
  VortexState state = VortexState::unresolved;
  double start = 0;      ///< [s] since when without break; NaN when unresolved
  double confidence = 0; ///< share of the neighbouring thresholds that give the same state, 0 to 1
  double settled = 0;    ///< [s] when the bed had settled; NaN: never
  std::vector<VortexEvidence> evidence;
};

/// State at the last frame. Confidence: every threshold in turn a fifth lower and a fifth higher.
VortexVerdict vortexVerdict(const VortexMeasures& measures, const VortexRules& rules);

/// State at each frame, as the rules would have it when the run ended there.
std::vector<VortexState> vortexHistory(const VortexMeasures& measures, const VortexRules& rules);

/// Mean period [s] of the bed's bouncing: intervals between crossings, in the same direction, of the mean
/// height through its mean over the last `frames` frames. Nothing with fewer than four crossings.
std::optional<double> bouncePeriod(const VortexMeasures& measures, std::size_t frames = 1000);

/// Median distance of the innermost centre from the axis [m] over the last `frames` frames.
double coreRadius(const VortexMeasures& measures, std::size_t frames = 1000);

/// Mean rotation of the bed [rad/s] over the last `frames` frames.
double bedRotation(const VortexMeasures& measures, std::size_t frames = 1000);

} // namespace sandglass::analysis
