#pragma once
// Grains as mixed precision sees them. Geometry, relative motion, laws, forces and histories of pairs are
// single precision; sums, positions and velocities are kept in double.
//
// A record has four fixed-point numbers (position and radius) and eight floats (velocity and 1/mass, radius
// times spin and 1/radius). A unit is 2^-30 of the largest diameter, that rounded up to a power of two of a
// metre; numbers wrap around at 2^32 units. Partners are less than three diameters apart, so nobody who seems
// to touch by the difference of two wrapped numbers is in truth a turn away, and the difference is exact
// however far from the origin they are: to half a unit each, 5e-10 to 1e-9 of a diameter. Squares of the
// differences are taken in double, where the difference between the squared sum of radii and the squared
// distance is exact but for the last place, and the overlap is that over the sum of both: to single precision
// although it is a small share of a diameter.

#include "sim/base/aligned.h"
#include "sim/contact/pair_kernel.h"
#include "sim/contact/pair_list.h"
#include "sim/grains/grain_store.h"

#include <cstdint>

namespace sandglass {

class MixedRecords {
public:
  /// Farthest coordinate over the largest diameter that fixed-point numbers are made of.
  static constexpr double farthest = 1 << 20;
  /// Largest skin of neighbour lists, over the mean diameter: two grains may part by twice what each may
  /// move, half a skin and a quarter of a diameter, beyond where they were listed, and stay below three
  /// diameters.
  static constexpr double largestSkin = 0.45;

  /// Room for all grains and the phantoms; `view` sees it. Records themselves: refresh().
  void bind(const GrainStore& grains, const PairList& list, ParticleView& view);
  /// All records anew, from the grains.
  static void refresh(const Kernel& kernel, const ParticleView& view, std::int64_t grains);

  std::size_t bytes() const { return (records_.capacity() + shifts_.capacity()) * sizeof(std::int32_t); }

private:
  AlignedVector<std::int32_t> records_, shifts_;
};

} // namespace sandglass
