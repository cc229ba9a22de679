#pragma once
// Frames one after the other into a text file.

#include "sim/io/run_folder.h"

#include <filesystem>
#include <functional>
#include <string>

namespace sandglass {

/// Frames [first, last): `write(frame, i, text)` adds what is to stand in the file for frame i. The file is
/// whole or absent. Throws RunError.
void writeTextFrames(FrameSource& frames, std::size_t first, std::size_t last,
                     const std::filesystem::path& file,
                     const std::function<void(const Frame&, std::size_t i, std::string&)>& write);

} // namespace sandglass
