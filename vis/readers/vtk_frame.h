#pragma once
// Grains from VTK files: legacy (.vtk), XML poly data (.vtp) and unstructured grids (.vtu), as LIGGGHTS,
// Yade, MercuryDPM and ParaView write them. Points are grains, point arrays their columns.

#include "sim/io/import/raw_frame.h"

#include <filesystem>

namespace sandglass::vis {

/// One frame; a field array named TIME, TimeValue or time holds its time. Throws InputError.
RawFrame readVtkFrame(const std::filesystem::path& file);

/// From then on openFrames() reads such files, each in a child process (child_reader.h), for which the
/// program's main() calls serveAsReader() first.
void registerFrameReaders();

} // namespace sandglass::vis
