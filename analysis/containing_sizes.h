#pragma once
// V2, the void size of Gelb & Gubbins (Langmuir 15, 305, 1999): the radius of the largest empty sphere that
// contains a point. Found as the best of a climb from the point and of many empty spheres, so that it can
// only come out too small.

#include "analysis/void_sizes.h"

#include <vector>

namespace sandglass::analysis {

/// The largest sphere about each void point that a climb from it finds: where V2 begins [m].
std::vector<double> climbedSizes(const SurfaceDistance& distance, const Region& region,
                                 const VoidPoints& points, double diameter);

/// V2 of each void point [m], at least `points.distance`. Tried are the `holes`, and on Voronoi edges and
/// faces `level` points between (equal grains: there the centre of a largest sphere lies, Agrawal, Galmarini
/// & Kroger 2023) or spheres that the void points meet on their way uphill (unequal ones). Uses the calling
/// thread's TBB arena; equal for any number of threads.
std::vector<double> containingSizes(const Frame& frame, const VoronoiCells& cells,
                                    const SurfaceDistance& distance, const Region& region,
                                    const std::vector<EmptySphere>& holes, const VoidPoints& points,
                                    int level, double diameter);

} // namespace sandglass::analysis
