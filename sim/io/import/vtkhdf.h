#pragma once
// VTKHDF files of other programs (VTK, ParaView, MercuryDPM): poly data and unstructured grids.

#include "sim/io/import/frame_format.h"

namespace sandglass {

ReaderKind vtkhdf();

/// Whether a file is to be read as a segment of this program: an HDF5 file with the group /Sandglass, or one
/// that is named .vtkhdf and is nobody else's VTKHDF (torn ones, whose fault is then told).
bool isOwnSegment(const std::filesystem::path& file);

} // namespace sandglass
