#pragma once
// The analyses of one frame that have a panel. To add one: a function below and a line in frameAnalyses().

#include "analysis/result.h"
#include "sim/frame/frame.h"

#include <string>
#include <vector>

namespace sandglass::desktop {

struct AnalysisInput {
  FramePtr frame;
  Vec3 up = Vec3::Zero(); ///< against gravity; zero when there is none
  std::string quantity;   ///< chosen in the panel, for those that ask for one
};

/// Computed in a worker. Throws InputError with a sentence when the frame lacks what it needs.
struct FrameAnalysis {
  const char* id;    ///< of the panel, of its command ("panel.<id>") and of exported files
  const char* title; ///< of the panel
  const char* tip;   ///< one sentence: what it shows
  bool asksQuantity; ///< the panel lets the user choose one
  bool shown;        ///< at the first start
  analysis::Curve (*compute)(const AnalysisInput& input);
};

const std::vector<FrameAnalysis>& frameAnalyses();

} // namespace sandglass::desktop
