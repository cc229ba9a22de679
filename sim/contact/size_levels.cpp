#include "sim/contact/size_levels.h"

#include <algorithm>
#include <bit>

namespace sandglass {

namespace {

/// Measured, in cycles: visiting the cells around a grain on its own level and on a coarser one, and testing
/// the grains there, per grain and cell.
constexpr double ownVisit = 45.0, coarserVisit = 60.0, perOccupant = 13.5;

struct Group {
  int firstBin, lastBin; ///< large to small
  double grains, reach;
};

double cost(const std::vector<Group>& groups, double volume) {
  double total = 0.0, coarser = 0.0;
  for (const Group& g : groups) { // from coarse to fine
    const double tests = perOccupant * g.grains * 8.0 * g.reach * g.reach * g.reach / volume;
    total += g.grains * (ownVisit + tests + coarser);
    coarser += coarserVisit + tests;
  }
  return total;
}

} // namespace

int SizeBins::of(double reach, double most) {
  const double ratio = most / reach;
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(ratio * ratio) >> 52) - 1023;
  return std::clamp(exponent, 0, count - 1);
}

void SizeBins::merge(const SizeBins& other) {
  for (int k = 0; k < count; ++k) {
    grains[k] += other.grains[k];
    largest[k] = std::max(largest[k], other.largest[k]);
  }
}

std::array<int, SizeBins::count> chooseLevels(const SizeBins& bins) {
  std::vector<Group> groups;
  double volume = 0.0;
  for (int k = 0; k < SizeBins::count; ++k) {
    if (bins.grains[k] == 0) continue;
    const double n = static_cast<double>(bins.grains[k]), r = bins.largest[k];
    groups.push_back({k, k, n, r});
    volume += 7.0 * n * r * r * r; // 4 pi / 3 over a packing of 0.6
  }
  for (;;) { // merge the two neighbours that gain most
    double best = cost(groups, volume);
    std::vector<Group> chosen;
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
      std::vector<Group> merged = groups;
      merged[g].lastBin = merged[g + 1].lastBin;
      merged[g].grains += merged[g + 1].grains;
      merged.erase(merged.begin() + static_cast<std::ptrdiff_t>(g) + 1);
      if (const double c = cost(merged, volume); c <= best) {
        best = c;
        chosen = std::move(merged);
      }
    }
    if (chosen.empty()) break;
    groups = std::move(chosen);
  }
  std::array<int, SizeBins::count> level{};
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int k = groups[g].firstBin; k <= groups[g].lastBin; ++k)
      level[k] = static_cast<int>(groups.size() - 1 - g);
  return level;
}

} // namespace sandglass
