#pragma once
// Which sizes of grains share a level of cells.

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

/// Grains counted by size. Bin k holds reaches in (most / 2^((k+1)/2), most / 2^(k/2)]; the last bin all
/// smaller ones too.
struct SizeBins {
  static constexpr int count = 24;
  std::array<std::int64_t, count> grains{};
  std::array<double, count> largest{}; ///< largest reach of the bin's grains [m]

  /// The bin of a reach among grains of which the largest has the reach `most`.
  static int of(double reach, double most);
  void merge(const SizeBins& other);
};

/// The level of each bin, counted from fine to coarse. Neighbouring bins share a level where one lookup in
/// wider cells costs less than two; the estimate takes the grains as densely packed.
std::array<int, SizeBins::count> chooseLevels(const SizeBins& bins);

} // namespace sandglass
