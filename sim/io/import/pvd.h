#pragma once
// ParaView's collections of files (.pvd).

#include "sim/io/import/frame_format.h"

namespace sandglass {

/// Times come from the collection; each file is read by the reader that its own content asks for. Parts of
/// one time become one frame.
ReaderKind pvd();

} // namespace sandglass
