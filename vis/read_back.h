#pragma once
// From VTK's framebuffer to an Image.

#include "vis/renderer.h"

class vtkRenderWindow;

namespace sandglass::vis {

/// What the window shows, opaque.
Image readBack(vtkRenderWindow* window);

/// Colour and opacity of a picture known on black and on white ground: what lies between differs by
/// 1 - opacity. Exact for lines, text and translucent walls alike.
Image withoutGround(const Image& onBlack, const Image& onWhite);

/// Half as wide and high, by the mean of four pixels, weighed by opacity.
Image halved(const Image& image);

} // namespace sandglass::vis
