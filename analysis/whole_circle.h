#pragma once
// Frames of a wedge (a sector of a circle that stands for all of it, Scene::wedge) as the whole circle, so
// that analyses see neighbours across the faces and volumes between the walls.

#include "sim/frame/frame.h"
#include "sim/math/sector.h"

#include <unordered_map>

namespace sandglass::analysis {

/// Follows the grains from Frame to Frame: one that leaves through a face and comes back through the other
/// goes on as the image that it has become, so that paths have no jumps (as long as no grain moves by half a
/// sector between Frames).
class WholeCircle {
public:
  explicit WholeCircle(Sector sector) : sector_(std::move(sector)) {}

  /// `count()` times as many grains: first one image of each grain in the Frame's order, then the next images
  /// in the same order. Ids are id + k 2^40. Vectors, orientations, contacts and forces turn with the grains;
  /// walls are the whole circle's already. Throws InputError for ids of 2^40 and more.
  Frame add(const Frame& frame);
  const Sector& sector() const { return sector_; }

private:
  struct Place {
    Vec3 position = Vec3::Zero();
    int turns = 0; ///< sectors by which image 0 stands before the grain of the Frame
  };
  Sector sector_;
  std::unordered_map<std::int64_t, Place> place_;
};

} // namespace sandglass::analysis
