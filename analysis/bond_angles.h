#pragma once
// Angles between the bonds of a grain to its neighbours: the three-body correlation.
//
// For each grain i in the region and each unordered pair j < k of its neighbours nearer than the cut-off, the
// angle j-i-k: Z (Z - 1) / 2 angles a grain. Neighbours may lie outside the region. P(theta) has the integral
// 1 over 0 .. pi; random directions give sin(theta) / 2, hence also P / (sin(theta) / 2) and the density over
// cos(theta), both flat then (1 and 1/2). Each bin is normalised by its exact share of the sphere.

#include "analysis/neighbour_list.h"
#include "analysis/region.h"
#include "analysis/result.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sandglass::analysis {

struct BondAngleOptions {
  double cutoff = 0;      ///< [m]
  std::string cutoffText; ///< how it was chosen
  int bins = 180;         ///< over 180 degrees, and as many over cos(theta)
  bool species = false;   ///< also by species of the middle grain and of the two ends
};

class BondAngles {
public:
  explicit BondAngles(BondAngleOptions options) : options_(std::move(options)) {}

  /// Centres inside `region` are middles of angles.
  void add(const Frame& frame, const Region& region);

  /// P(theta) in degrees^-1, P / (sin / 2), and the density over cos(theta); partial ones as further series,
  /// "a-(b)-c" with b in the middle. Errors: counting, or scatter and blocks of frames from four on. Numbers:
  /// angles, cutoff, mean number of neighbours. Throws InputError without a single angle.
  std::vector<Curve> results() const;

private:
  struct Counts {
    std::vector<std::uint64_t> theta, cosine;
    std::uint64_t total = 0;
  };
  Counts fresh() const;
  Series series(const std::string& name, const std::array<int, 3>& kind, bool cosine, int form) const;

  BondAngleOptions options_;
  using ByKind = std::map<std::array<int, 3>, Counts>; ///< {-1, -1, -1}: all; else end, middle, end
  std::vector<ByKind> frames_;
  std::vector<std::string> names_;
  std::uint64_t middles_ = 0, neighbours_ = 0;
  std::string regionText_;
};

} // namespace sandglass::analysis
