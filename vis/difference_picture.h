#pragma once
// Where two pictures differ, to look at.

#include "vis/renderer.h"

namespace sandglass::vis {

/// The second picture pale, with every pixel that difference() counts in red; the first alone when sizes
/// differ.
Image differencePicture(const Image& image, const Image& reference, int perChannel = 8);

} // namespace sandglass::vis
