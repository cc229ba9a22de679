#pragma once
// Which grain a ray meets first.

#include "vis/camera.h"
#include "vis/renderer.h"
#include "vis/visible_grains.h"

namespace sandglass::vis {

PickResult pickAlong(const Ray& ray, const VisibleGrains& grains);

} // namespace sandglass::vis
