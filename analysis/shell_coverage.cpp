#include "analysis/shell_coverage.h"

#include "analysis/quasi_random.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass::analysis {

namespace {

constexpr std::size_t tableSize = 16384; // power of two
constexpr int radii = 16;                // strata of equal volume within a shell

std::vector<Vec3> directionTable(std::uint64_t seed) {
  std::vector<Vec3> table(tableSize);
  const QuasiRandom3 sequence(seed, 0x646972ULL);
  for (std::size_t n = 0; n < tableSize; ++n) {
    const auto u = sequence(n);
    const double z = 2 * u[0] - 1, phi = 2 * std::numbers::pi * u[1], s = std::sqrt(1 - z * z);
    table[n] = {s * std::cos(phi), s * std::sin(phi), z};
  }
  return table;
}

/// Uniform random rotation, so that shells of different radius do not share their directions' error.
Eigen::Matrix3d rotation(std::uint64_t seed, int bin) {
  RandomStream random(seed, RandomPurpose::analysisSample,
                      0x726f74000000ULL + static_cast<std::uint64_t>(bin));
  const Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

struct Tally {
  std::uint64_t hits = 0;    ///< points inside
  std::uint64_t mixed = 0;   ///< sum over centres of k (M - k), for the error
  std::uint64_t squares = 0; ///< sum over centres of k^2, for the error of a subset
};

} // namespace

ShellCoverage shellCoverage(const Region& region, std::span<const Vec3> centres,
                            const ShellCoverageOptions& options) {
  ShellCoverage result{std::vector<double>(options.bins, 1.0), std::vector<double>(options.bins, 0.0)};
  if (centres.empty()) return result;
  const auto n = static_cast<std::int64_t>(centres.size());
  const std::uint64_t m = static_cast<std::uint64_t>(std::clamp<std::int64_t>(
      options.pointsPerShell / n, std::min(4, options.directions), options.directions));
  const std::int64_t used = std::min<std::int64_t>(
      n, std::max<std::int64_t>(1, options.pointsPerShell / static_cast<std::int64_t>(m)));

  const auto table = directionTable(options.seed);
  std::vector<Eigen::Matrix3d> turn(options.bins);
  std::vector<std::array<double, radii>> radius(options.bins);
  const double dr = options.rMax / options.bins;
  for (int b = 0; b < options.bins; ++b) {
    turn[b] = rotation(options.seed, b);
    const double low = std::pow(b * dr, 3), high = std::pow((b + 1) * dr, 3);
    for (int s = 0; s < radii; ++s)
      radius[b][s] = std::cbrt(low + (high - low) * (s + 0.5) / radii);
  }

  tbb::enumerable_thread_specific<std::vector<Tally>> partial(
      [&] { return std::vector<Tally>(options.bins); });
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, used, 64), [&](const auto& range) {
    auto& tally = partial.local();
    for (std::int64_t c = range.begin(); c < range.end(); ++c) {
      const Vec3& centre = centres[static_cast<std::size_t>(c * n / used)];
      const double inside = region.depthInside(centre, options.rMax);
      for (int b = 0; b < options.bins; ++b) {
        std::uint64_t k = m;
        if ((b + 1) * dr > inside) {
          k = 0;
          for (std::uint64_t q = 0; q < m; ++q) {
            const std::uint64_t index = static_cast<std::uint64_t>(c) * m + q;
            const Vec3 x = centre + radius[b][(index * 7) % radii] * (turn[b] * table[index % tableSize]);
            k += region.contains(x);
          }
        }
        tally[b].hits += k;
        tally[b].mixed += k * (m - k);
        tally[b].squares += k * k;
      }
    }
  });

  for (int b = 0; b < options.bins; ++b) {
    Tally sum;
    for (const auto& tally : partial) {
      sum.hits += tally[b].hits;
      sum.mixed += tally[b].mixed;
      sum.squares += tally[b].squares;
    }
    const double points = static_cast<double>(used) * static_cast<double>(m);
    result.share[b] = static_cast<double>(sum.hits) / points;
    // Within centres: sum of M p (1 - p), unbiased from k (M - k) / (M - 1). Between centres only for a
    // subset.
    double squared =
        m > 1 ? static_cast<double>(sum.mixed) / static_cast<double>(m - 1) : static_cast<double>(sum.hits);
    if (used < n && used > 1)
      squared = static_cast<double>(sum.squares) -
                static_cast<double>(sum.hits) * static_cast<double>(sum.hits) / static_cast<double>(used);
    result.error[b] = std::sqrt(std::max(0.0, squared)) / points;
  }
  return result;
}

} // namespace sandglass::analysis
