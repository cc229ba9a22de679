#pragma once
// What `sandglass analyze` reads: runs and frame files with what their scenes say.

#include "analysis/result.h"
#include "analysis/run_facts.h"
#include "app/cli/analyze_options.h"
#include "sim/io/run_folder.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace sandglass::cli {

/// One run or file with what its scene says.
struct Source {
  std::filesystem::path path;
  std::string prefix; ///< of its result files
  std::unique_ptr<FrameSource> frames;
  analysis::RunFacts facts; ///< `up` comes from --up where there is no scene
};

/// Throws InputError when there are no frames. `several`: results get the name of the source as prefix.
Source openSource(const std::string& text, bool several, const AnalyzeOptions& options = {});

/// The last frame with all gates closed (the settled bed), or the last of all.
std::size_t settledFrame(const Source& source);

/// First and last index that --frames names; the settled bed without.
std::pair<std::size_t, std::size_t> framesFor(const Source& source, const AnalyzeOptions& options);

/// Grain diameter: --diameter, else the mean of the frame.
double diameterFor(const AnalyzeOptions& options, const Frame& frame);

/// The user's limits, the surface's margin, up and the gates, for a region.
analysis::RegionOptions limitsFor(const Source& source, const AnalyzeOptions& options, double diameter);

/// Provenance of the frame and the name of the source.
template <class Result> void stamp(Result& result, const Source& source, const Frame& frame) {
  for (const auto& [key, value] : frame.provenance)
    result.provenance[key] = value;
  result.provenance["source"] = source.path.string();
}

} // namespace sandglass::cli
