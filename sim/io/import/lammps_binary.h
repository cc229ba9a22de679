#pragma once
// Binary dumps of LAMMPS.

#include "sim/io/import/frame_format.h"

namespace sandglass {

ReaderKind lammpsBinary();

/// Whether a file may be a binary dump of before 2020, which neither says what it is nor names its columns.
bool looksLikeOldLammpsBinary(std::string_view head);

} // namespace sandglass
