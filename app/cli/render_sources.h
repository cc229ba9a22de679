#pragma once
// What `sandglass render` draws from: runs, frame files, patterns of them, and pictures that name their run.

#include "app/cli/render_options.h"
#include "sim/io/run_folder.h"
#include "vis/history.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::cli {

struct RenderSource {
  std::unique_ptr<FrameSource> frames;
  std::string stem;                ///< begins the names of its pictures, unlike that of any other source
  std::optional<std::size_t> only; ///< the one frame of a picture that was given
  std::optional<vis::View> view;   ///< that of the picture
  std::shared_ptr<const vis::History> history;
};

/// Opens every source; patterns (*, ?, [..]) are expanded, those of other programs'
/// files to one source. Throws InputError with every fault at once.
std::vector<RenderSource> openSources(const std::vector<std::string>& names, const ImportArguments& import);

/// Index of the frame whose time is nearest.
std::size_t nearestFrame(const FrameSource& frames, double time);

} // namespace sandglass::cli
