#pragma once
// What `sandglass render` is asked for, and the small languages of its options.

#include "app/cli/import_options.h"
#include "vis/renderer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::cli {

struct RenderOptions {
  std::vector<std::string> sources, sideBySide;
  std::string folder, movie, reference, field;
  std::string viewFile, camera, colour, map, range, size, frames, select, arrows, slice, backend = "auto";
  std::vector<std::string> clips;
  std::vector<std::int64_t> tracks; ///< ids of grains
  double trackDuration = 0;         ///< [s]; 0: since the first frame
  std::optional<double> at;         ///< [s]
  int every = 1;
  double framesPerSecond = 25, threshold = 0.001;
  double turn = 0;     ///< [deg]
  int supersample = 0; ///< 0: the view's
  ImportArguments import;
  bool transparent = false, orthographic = false, forceChains = false;
};

/// The view file, or `base` where there is none, with the options laid over it. Throws InputError for every
/// option that makes no sense.
vis::View viewOf(const RenderOptions& options, const vis::View& base = {});

/// Indices of the frames to draw, out of `times`. Throws InputError when none is left.
std::vector<std::size_t> chosenFrames(const RenderOptions& options, const std::vector<double>& times,
                                      const std::string& source);

vis::GlBackend backendOf(const std::string& name);

} // namespace sandglass::cli
