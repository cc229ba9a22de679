#include "analysis/local_density.h"

#include "analysis/neighbours.h"
#include "analysis/quasi_random.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

namespace sandglass::analysis {

LocalDensity localDensity(const Region& region, std::span<const Vec3> points, double radius,
                          std::uint64_t seed) {
  LocalDensity local{countNeighbours(points, region.domain(), radius), std::vector<double>(points.size())};
  constexpr std::uint64_t samples = 128;
  const double ball = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  const QuasiRandom3 sequence(seed, 0x62616c6cULL);
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    local.volume[i] = ball;
    if (region.depthInside(points[i], radius) >= radius) return;
    std::uint64_t hits = 0;
    // Points go on through the sequence from grain to grain, so that errors of grains are independent.
    for (std::uint64_t n = i * samples; n < (i + 1) * samples; ++n) {
      const auto u = sequence(n);
      const double z = 2 * u[0] - 1, phi = 2 * std::numbers::pi * u[1], s = std::sqrt(1 - z * z);
      hits += region.contains(points[i] +
                              radius * std::cbrt(u[2]) * Vec3(s * std::cos(phi), s * std::sin(phi), z));
    }
    local.volume[i] = ball * static_cast<double>(hits) / samples;
  });
  return local;
}

} // namespace sandglass::analysis
