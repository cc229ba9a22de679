#pragma once
// The analyses that have a panel: all of the registry of analysis/, and a few of one frame that are only
// worth looking at. To add one of the latter: a function in analyses.cpp and a line in panelAnalyses().

#include "analysis/results.h"
#include "sim/frame/frame.h"
#include "sim/io/run_folder.h"
#include "sim/scene/parameters.h"
#include "sim/scene/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::desktop {

struct AnalysisInput {
  FramePtr frame;                            ///< that is shown
  std::shared_ptr<const FrameSource> frames; ///< of the run; for those that look at how things change
  std::optional<Scene> scene;                ///< where there is one
  std::string quantity;                      ///< chosen in the panel, for those that ask for one
  std::string knobs;                         ///< "name=value name=value", as somebody wrote it in the panel
};

struct PanelAnalysis {
  std::string id;                   ///< of the panel, of its command ("panel.<id>") and of exported files
  std::string title;                ///< of the panel
  std::string tip;                  ///< one sentence: what it shows
  bool asksQuantity;                ///< the panel lets the user choose one
  bool shown;                       ///< at the first start
  std::vector<ParameterSpec> knobs; ///< that the panel offers; all have a fallback
  /// In a worker. Throws InputError with a sentence when the frame lacks what it needs.
  std::function<analysis::Results(const AnalysisInput& input)> compute;
};

const std::vector<PanelAnalysis>& panelAnalyses();

} // namespace sandglass::desktop
