#pragma once
// The work of `sandglass render`: the list of pictures, the colour range and camera that they share, and
// drawing them.

#include "app/cli/render_options.h"

namespace sandglass::cli {

/// Returns the exit code: 1 when a picture is unlike its reference. Throws InputError.
int render(const RenderOptions& options);

} // namespace sandglass::cli
