#pragma once
// NumPy's .npy.

#include "sim/io/import/frame_format.h"

namespace sandglass {

ReaderKind npy();

} // namespace sandglass
