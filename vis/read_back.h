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

/// So many times less wide and high, by the mean of times^2 pixels, weighed by opacity.
Image reduced(const Image& image, int times);

/// Two pictures of one height side by side, a thin line between them.
Image beside(const Image& left, const Image& right);

} // namespace sandglass::vis
