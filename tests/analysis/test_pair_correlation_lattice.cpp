// g(r) where the answer is known exactly: lattices.

#include "analysis/neighbours.h"
#include "analysis/pair_correlation.h"
#include "tests/analysis/containers.h"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

/// Neighbours per point at squared distance q (in units of u), from bins fine enough to part the shells.
std::map<int, double> shells(const Frame& frame, double u, int upTo) {
  // Bin b of 20 per unit of r / u; shells of distance sqrt(q) u with q <= 10 are more than 0.15 apart.
  const double rMax = (std::sqrt(upTo) + 0.025) * u;
  const int bins = static_cast<int>(std::lround(rMax / u * 400));
  const auto counts = countPairs(frame.position, {}, frame.domain, {rMax, bins, true});
  std::map<int, double> found;
  for (std::size_t b = 0; b < counts.size(); ++b)
    if (counts[b] > 0) {
      const double r = (static_cast<double>(b) + 0.5) / 400;
      found[static_cast<int>(std::lround(r * r))] +=
          static_cast<double>(counts[b]) / static_cast<double>(frame.size());
    }
  return found;
}

} // namespace

TEST_CASE("simple cubic shells", "[gr][lattice]") {
  // Numbers of integer vectors of squared length q: 6, 12, 8, 6, 24, 24, 0, 12, 30, 24.
  const std::map<int, double> expected{{1, 6},  {2, 12}, {3, 8},  {4, 6},  {5, 24},
                                       {6, 24}, {8, 12}, {9, 30}, {10, 24}};
  const double a = 0.003;
  SECTION("wide box") {
    const Frame frame =
        frameOf(lattice({8, 8, 8}, a, simpleCubic), Vec3::Constant(8 * a), {true, true, true}, a / 2);
    CHECK(shells(frame, a, 10) == expected);
  }
  SECTION("box thinner than the reach: images seen several times over") {
    const Frame frame =
        frameOf(lattice({2, 5, 1}, a, simpleCubic), a * Vec3(2, 5, 1), {true, true, true}, a / 2);
    CHECK(shells(frame, a, 10) == expected);
  }
}

TEST_CASE("face-centred cubic shells", "[gr][lattice]") {
  // In units of the nearest distance a / sqrt 2: 12, 6, 24, 12, 24, 8, 48, 6.
  const std::map<int, double> expected{{1, 12}, {2, 6}, {3, 24}, {4, 12}, {5, 24}, {6, 8}, {7, 48}, {8, 6}};
  const double a = 0.003;
  const Frame frame =
      frameOf(lattice({5, 2, 6}, a, faceCentred), a * Vec3(5, 2, 6), {true, true, true}, a / 4);
  CHECK(shells(frame, a / std::numbers::sqrt2, 8) == expected);
}

TEST_CASE("a lattice's first shell and coordination", "[gr][lattice]") {
  const double a = 0.003, d = a / std::numbers::sqrt2;
  const Frame frame =
      frameOf(lattice({6, 6, 6}, a, faceCentred), Vec3::Constant(6 * a), {true, true, true}, d / 2);
  PairCorrelationOptions options;
  options.rMax = 3.01 * d;
  options.bins = 301;
  options.selfImages = true;
  const auto result = pairCorrelation(frame, options);
  // Shells at 1 and sqrt 2, nothing between; the middle of the gap is 1.2.
  CHECK(result.g.numbers.at("contact_peak") == Approx(1).margin(0.01));
  CHECK(result.g.numbers.at("first_minimum") == Approx(1.2).margin(0.06));
  CHECK(result.g.numbers.at("coordination_first_shell") == 12);
  CHECK(result.coordination.series[0].y[150] == Approx(18)); // 12 + 6 below 1.51 d
  // The sum over bins of g rho v is the number of neighbours: 12 + 6 + 24 + 12 + 24 + 8 + 48 + 6 + 36 within
  // 3 d.
  CHECK(result.coordination.series[0].y.back() == Approx(176));
}

TEST_CASE("pairs found by cells are those of the double loop", "[gr]") {
  const Vec3 size(4, 1.1, 7);
  for (const std::array<bool, 3> periodic :
       {std::array{true, true, true}, {false, true, false}, {false, false, false}}) {
    const Frame frame = uniformFrame(150, size, periodic, 0, {}, 11);
    const double rMax = 2.7;
    const int bins = 30;
    std::vector<char> reference(frame.size());
    for (std::size_t i = 0; i < reference.size(); ++i)
      reference[i] = i % 3 == 0;
    std::vector<std::uint64_t> all(bins), some(bins);
    const auto reach = [&](int k) { return periodic[k] ? 3 : 0; }; // 3 * 1.1 > 2.7
    for (std::size_t i = 0; i < frame.size(); ++i)
      for (std::size_t j = 0; j < frame.size(); ++j)
        for (int a = -reach(0); a <= reach(0); ++a)
          for (int b = -reach(1); b <= reach(1); ++b)
            for (int c = -reach(2); c <= reach(2); ++c) {
              if (i == j) continue;
              const Vec3 h = frame.position[j] + size.cwiseProduct(Vec3(a, b, c)) - frame.position[i];
              const auto bin = static_cast<std::size_t>(h.norm() / rMax * bins);
              if (bin >= all.size()) continue;
              ++all[bin];
              some[bin] += reference[i];
            }
    CHECK(countPairs(frame.position, {}, frame.domain, {rMax, bins, false}) == all);
    CHECK(countPairs(frame.position, reference, frame.domain, {rMax, bins, false}) == some);
  }
}

TEST_CASE("g(r) has the same bits for any number of threads", "[gr][threads]") {
  const Vec3 size(0.03, 0.03, 0.04);
  const Frame frame = uniformFrame(3000, size, {false, false, false}, 0.001, {cylinderWall(0.015, 0.04)}, 3);
  std::vector<std::vector<double>> g;
  for (const std::size_t threads : {1, 2, 3, 7}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    g.push_back(pairCorrelation(frame, {}).g.series[0].y);
  }
  for (const auto& other : g)
    CHECK(other == g[0]);
}
