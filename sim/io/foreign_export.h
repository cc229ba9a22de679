#pragma once
// Frames for other programs: LAMMPS text dumps and extended XYZ, which OVITO reads as well. What is written
// is read back by sim/io/import to the same bits, but for orientations and exponents of shapes (one unit in
// the last place). Walls, contacts and fields stay behind.

#include "sim/io/run_folder.h"

namespace sandglass {

/// The frames [first, last) one after the other: ITEM: TIME and TIMESTEP, box, then
/// `id type element x y z radius vx vy vz ...`; superellipsoids with LIGGGHTS' names (semi-axes, real part of
/// the quaternion first, blockiness 2 / e). Throws RunError when the file cannot be written.
void exportLammpsDump(FrameSource& frames, std::size_t first, std::size_t last,
                      const std::filesystem::path& file);

/// The same as extended XYZ; orientations in OVITO's order x y z w.
void exportExtendedXyz(FrameSource& frames, std::size_t first, std::size_t last,
                       const std::filesystem::path& file);

} // namespace sandglass
