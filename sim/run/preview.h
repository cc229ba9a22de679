#pragma once
// What a scene looks like before it runs.

#include "sim/frame/frame.h"
#include "sim/scene/scene.h"

namespace sandglass {

/// Walls, and the grains that the first stage places at once unless the scene brings in more than
/// `mostGrains`. Throws InputError as a run would: grains that do not fit, what no solver can do.
FramePtr previewFrame(const Scene& scene, std::int64_t mostGrains);

} // namespace sandglass
