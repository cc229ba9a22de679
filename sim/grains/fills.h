#pragma once
// The fillings that place grains at once; one file each. seeding.cpp calls them in the order of the scene.
// Their InputErrors are phrases that continue "FILE: fill.1 ...".

#include "sim/grains/open_space.h"
#include "sim/grains/placement_grid.h"
#include "sim/grains/seeding.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sandglass {

/// What a filling needs to know; `placed` is the space as earlier fillings left it.
struct FillContext {
  const Scene& scene;
  const FillSpec& fill;
  const OpenSpace& open;
  PlacementGrid& placed;
  std::int64_t firstId;
  std::string name; ///< "fill.1", for the log
};

/// Solid fraction up to which random insertion is quick; and where it ends for spheres of one size.
inline constexpr double quickSolidFraction = 0.3, jammedSolidFraction = 0.38;

/// Random sequential insertion, large grains first. Throws InputError when they do not all find room.
std::vector<GrainSeed> fillRandomly(const FillContext& context);

/// How many grains a random filling brings: as it says, or what mass or solid fraction come to.
std::int64_t randomFillCount(const Scene& scene, const FillSpec& fill);

/// Share of a region that is open to grains: 20,000 evenly spread points.
double openShare(const Scene& scene, const FillSpec& fill);

/// Lattice points whose spheres clear the walls; throws InputError when neighbours overlap.
std::vector<GrainSeed> fillLattice(const FillContext& context);

/// The grains as listed. May overlap up to the scene's maximum_overlap, for experiments that begin in
/// contact.
std::vector<GrainSeed> fillFromList(const FillContext& context);

} // namespace sandglass
