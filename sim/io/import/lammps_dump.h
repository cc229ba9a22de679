#pragma once
// Text dumps of LAMMPS and LIGGGHTS.

#include "sim/io/import/frame_format.h"

namespace sandglass {

ReaderKind lammpsDump();

} // namespace sandglass
