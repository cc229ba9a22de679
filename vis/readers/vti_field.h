#pragma once
// Fields from VTK image data files (VTI), such as `sandglass analyze` writes, and from results at hand.

#include "analysis/field.h"
#include "sim/frame/frame.h"

#include <filesystem>

namespace sandglass::vis {

/// Scalars and vectors at the points of the image; a file `.vtk` is read as legacy structured points. Throws
/// InputError.
FrameField readVtiField(const std::filesystem::path& file);

/// From then on scenes may name ".vti" and ".vtk" files as winds; they are read in a child process.
void registerFlowReaders();

/// An analysis' field as frames carry it; tensors stay behind.
FrameField frameField(const analysis::Field& field);

} // namespace sandglass::vis
