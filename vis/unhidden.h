#pragma once
// Which grains can be seen at all. In a heap of a million most lie behind others: they are left out before
// anything is sent to the rasteriser, and no pixel changes.
//
// Grains are taken from front to back. One is hidden when every pixel that it might touch is covered by a
// grain whose middle lies in front of its foremost point. What a grain covers is the section of an ellipsoid
// inside it with the plane through its middle, across the line of sight; what it might touch lies in the
// rectangle and in the circle around it. Both hold under perspective: the section lies in the grain, and its
// picture is the same ellipse, only smaller.

#include "vis/visible_grains.h"

namespace sandglass::vis {

struct PictureGeometry {
  Camera camera;             ///< presets resolved
  int width = 0, height = 0; ///< pixels as drawn
};

/// Indices into `grains`, from front to back; without `skipHidden` all of them.
std::vector<std::size_t> unhidden(const VisibleGrains& grains, const PictureGeometry& picture,
                                  bool skipHidden = true);

/// Pixels for a metre across the line of sight at a depth; 0 behind the eye.
double pixelsPerMetre(const PictureGeometry& picture, double depth);

/// Width in pixels of a sphere at a place.
double pixelsAcross(const Vec3& place, double radius, const PictureGeometry& picture);

} // namespace sandglass::vis
