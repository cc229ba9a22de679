#pragma once
// Velocities of a fluid on a grid from a file, by its extension. This library reads none: the program adds
// readers that need other libraries.

#include "sim/frame/frame.h"
#include "sim/scene/parameters.h"

#include <filesystem>
#include <functional>
#include <string>

namespace sandglass {

using FlowReader = std::function<FrameField(const std::filesystem::path&)>;

/// From then on files with that extension (".vti") are read so. To be called before scenes are read.
void registerFlowReader(const std::string& extension, FlowReader reader);

/// Largest number of points: the scene that a run keeps holds all their velocities.
constexpr std::size_t largestFlowGrid = 1'000'000;

/// Parameters of a gridded_wind in which `file`, `array`, `scale`, `velocity_scale` and `shift` have become
/// `points`, `origin`, `spacing` and `velocities`, so that a run does not depend on the file any more; a name
/// that is not absolute is looked up in `baseFolder`. Throws InputError.
Parameters flowFromFile(const Parameters& parameters, const std::filesystem::path& baseFolder);

} // namespace sandglass
