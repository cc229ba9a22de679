#pragma once
// Which grain a ray meets first, and which lie in a rectangle of the picture.

#include "vis/camera.h"
#include "vis/renderer.h"
#include "vis/unhidden.h"
#include "vis/visible_grains.h"

namespace sandglass::vis {

PickResult pickAlong(const Ray& ray, const VisibleGrains& grains);

/// Ids of the grains whose centres lie in a rectangle of pixels, both corners included.
std::vector<std::int64_t> grainsInRectangle(const VisibleGrains& grains, const PictureGeometry& picture,
                                            int x0, int y0, int x1, int y1);

} // namespace sandglass::vis
