#pragma once
// Tables of grains as text: CSV, and rows with white space between.

#include "sim/io/import/frame_format.h"

namespace sandglass {

ReaderKind csv();
ReaderKind pointRows();

} // namespace sandglass
