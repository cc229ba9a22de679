#pragma once
// Who is near whom, as lists with the vectors between: what bond angles, bond order and clusters walk over.

#include "sim/frame/frame.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sandglass::analysis {

/// The neighbours of point i are entries start[i] .. start[i + 1] - 1. Every periodic image is a neighbour of
/// its own, a point's own images included.
struct NeighbourList {
  std::vector<std::size_t> start;   ///< one more than points
  std::vector<std::uint32_t> index; ///< the neighbour
  std::vector<Vec3> vector;         ///< from the point to it [m]

  std::size_t size() const { return start.empty() ? 0 : start.size() - 1; }
  int count(std::size_t i) const { return static_cast<int>(start[i + 1] - start[i]); }
  std::span<const std::uint32_t> indices(std::size_t i) const {
    return {index.data() + start[i], start[i + 1] - start[i]};
  }
  std::span<const Vec3> vectors(std::size_t i) const {
    return {vector.data() + start[i], start[i + 1] - start[i]};
  }
};

/// All within `cutoff` [m]; of each point in ascending order of index, then of distance. Points must lie in
/// the domain along periodic axes. Equal for any number of threads.
NeighbourList neighboursWithin(std::span<const Vec3> points, const Domain& domain, double cutoff);

/// Those of neighboursWithin(2 `share` R_max) whose gap is small: |x_ij| < share (R_i + R_j).
NeighbourList neighboursByGap(std::span<const Vec3> points, std::span<const double> radii,
                              const Domain& domain, double share);

/// Connected components of the pairs that `linked(i, entry)` accepts, entry being the position in the list.
/// Components are numbered from 0 in order of their first point; points that `member` refuses have -1.
std::vector<int> components(const NeighbourList& list, const std::function<bool(std::size_t)>& member,
                            const std::function<bool(std::size_t, std::size_t)>& linked);

} // namespace sandglass::analysis
