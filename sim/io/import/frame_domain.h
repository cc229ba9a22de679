#pragma once
// The domain of a frame from elsewhere.

#include "sim/io/import/column_set.h"

#include <optional>

namespace sandglass {

/// Gives the frame its domain: `box` [m], or, without one, what the grains take up. Grains go into the box
/// where it repeats (dumps may lag behind, or be unwrapped). Throws InputError for a repeating direction
/// without extent, or a grain so far away that its place in the box is rounding.
void fitDomain(Frame& frame, const std::optional<Domain>& box, const FramePlace& place);

/// Puts the grains of a tilted box with the edges (lx, 0, 0), (xy, ly, 0), (xz, yz, lz), tilt = (xy, xz, yz),
/// into the upright box of the same volume by whole edges, and says in `box` along which directions that box
/// still repeats: always along x, along y and z where the tilts come to whole periods. Directions that do not
/// repeat upright any more become open sides. Returns what the user should know; empty when nothing is lost.
std::string straighten(std::vector<Vec3>& position, Domain& box, const Vec3& tilt, const FramePlace& place);

} // namespace sandglass
