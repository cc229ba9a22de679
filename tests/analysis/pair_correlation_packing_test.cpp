// E3 and E1 inside a walled packing of hard spheres: two estimators of one function.

#include "analysis/neighbours.h"
#include "analysis/pair_correlation.h"
#include "analysis/statistics.h"
#include "tests/analysis/containers.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

/// Random sequential addition: centres one by one at random, rejected when nearer than a diameter to another.
Frame sequentialAddition(std::size_t count, double size, double radius, std::uint64_t seed) {
  RandomStream random(seed, RandomPurpose::test, 21);
  const int cells = static_cast<int>(size / (2 * radius));
  std::vector<std::vector<Vec3>> grid(static_cast<std::size_t>(cells * cells * cells));
  std::vector<Vec3> points;
  const auto cell = [&](double x) { return std::min(cells - 1, static_cast<int>(x / size * cells)); };
  while (points.size() < count) {
    const Vec3 x(random.uniform(radius, size - radius), random.uniform(radius, size - radius),
                 random.uniform(radius, size - radius));
    bool free = true;
    for (int a = std::max(0, cell(x.x()) - 1); a <= std::min(cells - 1, cell(x.x()) + 1) && free; ++a)
      for (int b = std::max(0, cell(x.y()) - 1); b <= std::min(cells - 1, cell(x.y()) + 1) && free; ++b)
        for (int c = std::max(0, cell(x.z()) - 1); c <= std::min(cells - 1, cell(x.z()) + 1) && free; ++c)
          for (const auto& y : grid[static_cast<std::size_t>((a * cells + b) * cells + c)])
            free = free && (x - y).squaredNorm() >= 4 * radius * radius;
    if (!free) continue;
    grid[static_cast<std::size_t>((cell(x.x()) * cells + cell(x.y())) * cells + cell(x.z()))].push_back(x);
    points.push_back(x);
  }
  Frame frame = frameOf(std::move(points), Vec3::Constant(size), {false, false, false}, radius);
  frame.walls = {boxWall(Vec3::Constant(size))};
  return frame;
}

} // namespace

TEST_CASE("E3 equals the guard zone inside a walled packing", "[gr][packing]") {
  // Solid fraction 0.3 in a box of 19 diameters; the window keeps 2.5 diameters from the walls, where the
  // density is uneven: there E1, which looks at the middle alone, would rightly differ from E3. Ten packings
  // give the error of the difference, bin by bin.
  const double radius = 0.5, size = 19;
  const auto count =
      static_cast<std::size_t>(0.3 * size * size * size / (4.0 / 3.0 * 3.14159265358979 * 0.125));
  constexpr int packings = 10, bins = 30;
  std::vector<std::vector<double>> difference(bins);
  std::vector<double> uncorrected(bins), corrected(bins);
  for (int p = 0; p < packings; ++p) {
    const Frame frame = sequentialAddition(count, size, radius, 50 + p);
    PairCorrelationOptions options;
    options.rMax = 3;
    options.bins = bins;
    options.seed = 7 + p;
    options.region.lower = Vec3::Constant(2.5);
    options.region.upper = Vec3::Constant(size - 2.5);
    const auto e3 = pairCorrelation(frame, options).g;
    options.estimator = Estimator::guardZone;
    const auto e1 = pairCorrelation(frame, options).g;
    options.estimator = Estimator::uncorrected;
    const auto e0 = pairCorrelation(frame, options).g;
    REQUIRE(e1.numbers.at("references") > 100);
    for (int b = 0; b < bins; ++b) {
      difference[b].push_back(e3.series[0].y[b] - e1.series[0].y[b]);
      uncorrected[b] += e0.series[0].y[b] / packings;
      corrected[b] += e3.series[0].y[b] / packings;
    }
  }
  for (int b = 0; b < 10; ++b)
    CHECK(corrected[b] == 0); // hard spheres
  for (int b = 10; b < bins; ++b) {
    const double t = mean(difference[b]) / std::sqrt(variance(difference[b]) / packings);
    INFO("bin " << b << ": difference " << mean(difference[b]) << ", t = " << t);
    // 20 bins, Student's t of 9 degrees of freedom: 4.78 has the two-sided probability 0.001.
    CHECK(std::abs(t) < studentFactor(0.999, packings - 1));
  }
  // Without correction the far end lies lower by the share of the shells outside: more than 20 % here.
  CHECK(uncorrected[bins - 1] < 0.8 * corrected[bins - 1]);
}
