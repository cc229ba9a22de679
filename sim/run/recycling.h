#pragma once
// Puts grains that passed a recycling outlet back over the bed, so that a steady state can go on.
//
// Grains wait in the order in which they left (of one moment: ascending ids). The first in the queue of an
// outlet takes a level place at random in the outlet's box, which depends on seed, id, life and the number of
// tries alone, and there the lowest height with its own diameter free above it: over the surface of the bed,
// whose voids are smaller, but below grains that are still falling. Where that is no longer inside the box or
// a wall is in the way it tries again, a few times now and then at the next look; those behind it wait. A
// grain keeps its id, species, size and conserved quantities, counts a life more, and does not turn.

#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

#include <deque>
#include <vector>

namespace sandglass {

class Recycling {
public:
  explicit Recycling(const Scene& scene);

  /// A grain that has left; waits if its outlet recycles.
  void left(LeftGrain grain);
  std::size_t waiting() const;

  /// Grains that find a place now, where neither the walls standing in `stage` nor grains are.
  std::vector<GrainSeed> due(const Solver& solver, const std::string& stage);

  std::vector<std::byte> save() const;
  void load(const std::vector<std::byte>& bytes);

private:
  struct Queue {
    std::deque<GrainSeed> grains;
    std::int64_t tries = 0; ///< of the first one so far
  };
  const Scene& scene_;
  std::vector<Queue> queues_; ///< one an outlet
};

} // namespace sandglass
