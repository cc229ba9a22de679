#pragma once
// A phase diagram with small pictures of runs beside it, in one file.

#include "analysis/result.h"
#include "vis/renderer.h"

#include <filesystem>
#include <vector>

namespace sandglass::vis {

struct PhaseExample {
  FramePtr frame;
  View view; ///< with its title and size
};

/// The chart at the left, as high as the examples in two columns at the right need; in the picture's text
/// what a chart has.
Image phasePicture(Renderer& renderer, const analysis::Curve& chart,
                   const std::vector<PhaseExample>& examples);
void writePhasePicture(Renderer& renderer, const analysis::Curve& chart,
                       const std::vector<PhaseExample>& examples, const std::filesystem::path& file);

} // namespace sandglass::vis
