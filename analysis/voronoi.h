#pragma once
// Voronoi cells of grains, cut by the scene's walls and by the free surface; radical (Laguerre) cells where
// sizes differ. The cells themselves are cut by voro++ (Rycroft, Chaos 19, 041111, 2009); who cuts them is
// found here, so that any periodic image, wall and number of threads will do.
//
// Between grains the plane lies at t = (D^2 + R_i^2 - R_j^2) / (2 D) from i towards j; without radii at D
// / 2. No grain farther than rho + sqrt(rho^2 + R_max^2 - R_i^2) can cut a cell whose farthest vertex is rho
// away. A wall cuts along the tangent plane at its nearest point to the grain (exact for flat walls), and,
// where a vertex still lies beyond a curved one, along further tangent planes, `wallRounds` times; the volume
// that remains outside falls with (d / R)^2 from the first round on. Edges that point into the bed (lips) cut
// across the line to the grain. The free surface cuts level, a mean radius above the highest centre of its
// column.

#include "sim/frame/frame.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sandglass::analysis {

struct VoronoiOptions {
  bool radical = true;    ///< radii count; needs radii in the Frame
  int wallRounds = 3;     ///< of further tangent planes at curved walls
  std::optional<Vec3> up; ///< cut at the free surface; needs `diameter`
  double diameter = 0;    ///< [m] mean; 0: from the mean spacing
  bool vertices = false;  ///< keep them
};

/// What a face looks at where it is not a grain.
namespace beyond {
inline constexpr int wall = -1;
inline constexpr int bound = -2;   ///< the domain's end, where no wall is
inline constexpr int surface = -3; ///< the free surface
} // namespace beyond

struct VoronoiFace {
  int other = beyond::bound;                  ///< index of the grain, or what is beyond
  double area = 0;                            ///< [m^2]
  Vec3 vector = Vec3::Zero();                 ///< to the other grain's image; outward unit normal otherwise
  std::uint32_t firstCorner = 0, corners = 0; ///< into the cell's corners(), when vertices were asked for
};

/// Cells in the order of the Frame's grains. A grain above the surface, behind a wall or with an empty
/// radical cell has the volume NaN and no face.
struct VoronoiCells {
  std::vector<double> volume;     ///< [m^3]
  std::vector<std::size_t> start; ///< first face of each cell; one more than grains
  std::vector<VoronoiFace> face;  ///< larger first
  std::vector<char> atWall, atBound, atSurface;
  std::vector<Vec3> vertex; ///< [m], of all cells in turn, when asked for
  std::vector<std::size_t> vertexStart;
  std::vector<int> corner; ///< vertices around each face, as positions among the cell's vertices
  std::vector<std::size_t> cornerStart;

  std::size_t size() const { return volume.size(); }
  std::span<const VoronoiFace> faces(std::size_t i) const {
    return {face.data() + start[i], start[i + 1] - start[i]};
  }
  std::span<const Vec3> vertices(std::size_t i) const {
    return {vertex.data() + vertexStart[i], vertexStart[i + 1] - vertexStart[i]};
  }
  std::span<const int> corners(std::size_t i, const VoronoiFace& f) const {
    return {corner.data() + cornerStart[i] + f.firstCorner, f.corners};
  }
};

/// Uses the calling thread's TBB arena; equal for any number of threads. Throws InputError when radii are
/// asked for and missing.
VoronoiCells voronoiCells(const Frame& frame, const VoronoiOptions& options);

} // namespace sandglass::analysis
