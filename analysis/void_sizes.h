#pragma once
// Void sizes by several definitions that carry the same name in the literature (Agrawal, Galmarini & Kroger,
// Phys. Rev. E 107, 015307, 2023). Each is a function of its own; the results print which one they are.
//
//   V1  Torquato: random points in the voids, distance to the nearest solid surface
//   V2  Gelb & Gubbins: for the same points the largest empty sphere that contains them (containing_sizes.h)
//   V3  hole radii: Voronoi vertices, distance to the centres less the radius; each vertex once
//   V5  cavities: connected parts of the space left to the centre of a probe sphere, on a grid
//   gridded hole sizes (Rycroft, PhD thesis, MIT, 2007): nodes of a grid, nearest-centre distance less the
//       radius, cut by the box's planes and a cap
//
// Points lie in the region (no clearance from walls, below the free surface). Wall voids: points nearer to a
// wall than `wallDistance`, and spheres that a wall limits.

#include "analysis/region.h"
#include "analysis/result.h"
#include "analysis/results.h"
#include "analysis/surface_distance.h"
#include "analysis/voronoi.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sandglass::analysis {

/// Random points of the voids with their V1 distance.
struct VoidPoints {
  std::vector<Vec3> point;
  std::vector<double> distance; ///< to the nearest solid surface, walls included [m]
  std::vector<char> nearWall;   ///< nearer to a wall than asked
  std::size_t tried = 0;        ///< points in the region, solid or not: point.size() / tried is the porosity
};
VoidPoints voidPoints(const SurfaceDistance& distance, const Region& region, std::size_t probes,
                      double wallDistance, std::uint64_t seed);

/// Voronoi vertices of equal grains that are holes, each once, with positive radius; vertices whose sphere a
/// wall would cut are climbed to the largest sphere between grains and wall. Unequal grains: maximal spheres
/// climbed to from the void points. Largest first.
std::vector<EmptySphere> holes(const Frame& frame, const VoronoiCells& cells, const SurfaceDistance& distance,
                               const Region& region, const VoidPoints& points, double diameter);

/// Voronoi cells with vertices, radii left aside, for holes() and containingSizes().
VoronoiCells cellsForVoids(const Frame& frame, const std::optional<Vec3>& up, double diameter);

struct Cavities {
  std::vector<double> volumes; ///< [m^3], largest first
  double total = 0;            ///< [m^3]
  double spacing = 0;          ///< of the grid [m]
};

/// Distances on a grid over the region, cell-centred; NaN outside. For V5 and the gridded hole sizes.
struct DistanceGrid {
  Vec3 origin, spacing;
  std::array<int, 3> count;
  std::array<bool, 3> periodic;
  std::vector<float> grains, walls; ///< [m]
};
DistanceGrid distanceGrid(const SurfaceDistance& distance, const Region& region, double spacing);

/// Nodes farther than `probe` from all surfaces, joined along the six directions. `stride` 2 uses every
/// second node: the same with twice the spacing.
Cavities cavities(const DistanceGrid& grid, double probe, int stride);

} // namespace sandglass::analysis
