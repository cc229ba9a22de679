#pragma once
// Fields from VTK image data files (VTI), such as `sandglass analyze` writes, and from results at hand.

#include "analysis/field.h"
#include "sim/frame/frame.h"

#include <filesystem>

namespace sandglass::vis {

/// Scalars and vectors at the points of the image. Throws InputError.
FrameField readVtiField(const std::filesystem::path& file);

/// An analysis' field as frames carry it; tensors stay behind.
FrameField frameField(const analysis::Field& field);

} // namespace sandglass::vis
