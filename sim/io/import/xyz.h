#pragma once
// XYZ and extended XYZ.

#include "sim/io/import/frame_format.h"

namespace sandglass {

ReaderKind xyz();

} // namespace sandglass
