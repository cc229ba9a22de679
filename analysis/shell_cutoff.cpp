#include "analysis/shell_cutoff.h"

#include "analysis/pair_correlation.h"
#include "sim/base/error.h"

#include <fmt/format.h>

namespace sandglass::analysis {

RegionOptions grainRegion(const AnalysisContext& context, double diameter, double margin) {
  RegionOptions region = context.limits;
  region.up = context.facts.up;
  region.gates = context.facts.gates;
  region.diameter = diameter;
  if (region.clearance <= 0) region.clearance = 0.5 * diameter;
  if (region.up && region.surfaceMargin <= 0) region.surfaceMargin = margin * diameter;
  return region;
}

ShellCutoff shellCutoff(const Frame& frame, double inDiameters, double diameter,
                        const AnalysisContext& context) {
  if (inDiameters > 0)
    return {inDiameters * diameter,
            fmt::format("{:.4g} d ({:.4g} m), as asked", inDiameters, inDiameters * diameter)};
  PairCorrelationOptions options;
  options.diameter = diameter;
  options.rMax = 2.5 * diameter;
  options.bins = 125;
  options.pointsPerShell = 20000;
  options.region = grainRegion(context, diameter);
  options.seed = context.seed;
  try {
    const Curve g = pairCorrelation(frame, options).g;
    if (const auto it = g.numbers.find("first_minimum"); it != g.numbers.end())
      return {it->second * diameter, fmt::format("{:.4g} d ({:.4g} m), the first minimum of g(r)", it->second,
                                                 it->second * diameter)};
  } catch (const InputError&) {
    // Too few grains inside for a g(r): the usual distance then.
  }
  return {1.4 * diameter, fmt::format("1.4 d ({:.4g} m), since g(r) has no first minimum", 1.4 * diameter)};
}

} // namespace sandglass::analysis
