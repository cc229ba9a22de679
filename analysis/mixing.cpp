#include "analysis/mixing.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"
#include "sim/base/random.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace sandglass::analysis {

Mixing mixing(std::span<const Vec3> points, std::span<const char> marked, double cell, int shuffles,
              std::uint64_t seed) {
  const auto n = static_cast<double>(points.size());
  double all = 0;
  for (const char m : marked)
    all += m ? 1 : 0;
  if (!(all > 0) || !(all < n))
    throw InputError("mixing needs grains of two kinds in the region, but all are of one");
  std::map<std::array<long, 3>, std::size_t> number;
  std::vector<std::size_t> of;
  std::vector<double> grains;
  for (const Vec3& x : points) {
    const std::array<long, 3> key{std::lround(std::floor(x.x() / cell)),
                                  std::lround(std::floor(x.y() / cell)),
                                  std::lround(std::floor(x.z() / cell))};
    const auto [it, isNew] = number.emplace(key, number.size());
    if (isNew) grains.push_back(0);
    of.push_back(it->second);
    grains[it->second] += 1;
  }
  if (grains.size() < 2)
    throw InputError("mixing needs at least two cells with grains: choose smaller cells");
  Mixing result;
  result.share = all / n;
  result.cells = grains.size();
  const double x = result.share;
  const auto measure = [&](std::span<const char> labels) {
    std::vector<double> count(grains.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
      count[of[i]] += labels[i] ? 1 : 0;
    double index = 0, square = 0;
    for (std::size_t c = 0; c < grains.size(); ++c) {
      index += grains[c] * std::abs(count[c] / grains[c] / x - 1) / n;
      square += grains[c] * std::pow(count[c] / grains[c] - x, 2) / n;
    }
    return std::pair{index, square};
  };
  const auto [index, square] = measure(marked);
  std::vector<char> labels(marked.begin(), marked.end());
  std::vector<double> floors;
  double randomSquare = 0;
  RandomStream random(seed, RandomPurpose::analysisSample, 0x6d6978ULL);
  for (int s = 0; s < shuffles; ++s) {
    for (std::size_t i = labels.size(); i > 1; --i)
      std::swap(labels[i - 1], labels[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    const auto [f, r] = measure(labels);
    floors.push_back(f);
    randomSquare += r / shuffles;
  }
  result.index = index;
  result.floor = mean(floors);
  result.floorDeviation = std::sqrt(variance(floors));
  result.lacey = (x * (1 - x) - square) / (x * (1 - x) - randomSquare);
  return result;
}

} // namespace sandglass::analysis
