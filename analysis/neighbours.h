#pragma once
// Who is near whom. A grid of cells over the points; along periodic directions every image counts as a point
// of its own, however thin the domain (no minimum-image rule).

#include "sim/frame/frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sandglass::analysis {

struct PairCountOptions {
  double rMax = 0;         ///< [m], > 0
  int bins = 100;          ///< of equal width from 0 to rMax
  bool selfImages = false; ///< whether a point counts its own periodic images
};

/// Ordered pairs (i, j or an image of j) by distance: i runs over the points whose `reference` entry is true
/// (all when it is empty), j over all points. Bin b holds b dr <= distance < (b + 1) dr. A point is not its
/// own neighbour. Uses the calling thread's TBB arena; the counts are integers, equal for any number of
/// threads.
std::vector<std::uint64_t> countPairs(std::span<const Vec3> points, const std::vector<char>& reference,
                                      const Domain& domain, const PairCountOptions& options);

/// Number of points (images included, the point itself not) within `radius` of each point.
std::vector<int> countNeighbours(std::span<const Vec3> points, const Domain& domain, double radius);

} // namespace sandglass::analysis
