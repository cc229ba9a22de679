#pragma once
// How well species are mixed in space, with what chance alone would give.
//
// Cells of a grid with n_c grains, x_c of them of the species, x in all:
//   segregation index SI = sum n_c |x_c / x - 1| / N (the form of Anand, PhD thesis, 2009, over cells)
//   Lacey's index M = (S0^2 - S^2) / (S0^2 - Sr^2), S^2 = sum n_c (x_c - x)^2 / N, S0^2 = x (1 - x) apart,
//   Sr^2 the same of shuffled grains (Lacey, J. Appl. Chem. 4, 257, 1954): 1 mixed, 0 apart
// SI of a perfect mixture is not 0, since cells hold few grains: its floor is the mean over shuffles of the
// species.

#include "sim/base/vec.h"

#include <cstdint>
#include <span>

namespace sandglass::analysis {

struct Mixing {
  double index = 0;                     ///< SI
  double floor = 0, floorDeviation = 0; ///< of SI over shuffles
  double lacey = 0;
  double share = 0; ///< x, by number
  std::size_t cells = 0;
};

/// Grains whose `marked` is true against the others. Throws InputError when one kind is missing or there are
/// fewer than two cells with grains.
Mixing mixing(std::span<const Vec3> points, std::span<const char> marked, double cell, int shuffles,
              std::uint64_t seed);

} // namespace sandglass::analysis
