#pragma once
// Further forms that frames leave in: CSV, and all segments of a run merged into one VTKHDF file.

#include "sim/io/run_folder.h"

namespace sandglass {

/// Rows `time,step,id,x,y,z,<scalars>,<vectors>.x,...` of the frames [first, last), comment lines with the
/// provenance in front. Numbers are written so that reading gives the same bits. Throws InputError when a
/// later frame lacks a column of the first, RunError when the file cannot be written.
void exportCsv(FrameSource& frames, std::size_t first, std::size_t last, const std::filesystem::path& file);

/// One VTKHDF file with all frames; `sceneText` goes inside. Throws InputError when quantities, walls or
/// provenance change from one frame to the next, since a file has one set of columns.
void exportVtkhdf(FrameSource& frames, const std::string& sceneText, bool singlePrecisionPositions,
                  const std::filesystem::path& file);

} // namespace sandglass
