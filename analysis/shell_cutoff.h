#pragma once
// The distance up to which grains are neighbours: given in diameters, or the first minimum of g(r).

#include "analysis/registry.h"

#include <string>

namespace sandglass::analysis {

struct ShellCutoff {
  double distance = 0; ///< [m]
  std::string text;    ///< "1.41 d, the first minimum of g(r)"
};

/// `inDiameters` > 0: that many. 0: the first minimum of g(r) (E3, up to 2.5 d) of this Frame; where g(r) has
/// no minimum, 1.4 d, and the text says so.
ShellCutoff shellCutoff(const Frame& frame, double inDiameters, double diameter,
                        const AnalysisContext& context);

/// The region for statistics over single grains: the context's limits, gates and free surface; grains count
/// when their centres are `margin` diameters below the surface.
RegionOptions grainRegion(const AnalysisContext& context, double diameter, double margin = 2);

} // namespace sandglass::analysis
