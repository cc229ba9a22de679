// E3 and E1 inside a walled packing of hard spheres: two estimators of one function.

#include "analysis/neighbours.h"
#include "analysis/pair_correlation.h"
#include "analysis/statistics.h"
#include "tests/analysis/containers.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

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

TEST_CASE("E3 equals the guard zone inside a settled bed", "[gr][packing]") {
  // tests/data says where the bed comes from. Eight windows of 25 mm x 36 mm, through the whole periodic
  // depth of 2.5 diameters, two diameters or more from all walls and the free surface, give the error of the
  // difference.
  std::ifstream file(SANDGLASS_SOURCE_DIR "/tests/data/settled_slot_bed.txt");
  std::vector<Vec3> points;
  for (std::string line; std::getline(file, line);) {
    Vec3 x;
    if (line[0] != '#' && std::istringstream(line) >> x.x() >> x.y() >> x.z()) points.push_back(1e-6 * x);
  }
  REQUIRE(points.size() == 6790);
  Frame frame = frameOf(points, Vec3(0.0625, 0.1, 0.0028), {false, false, true}, 0.00112);
  frame.domain.lower = Vec3(-0.0625, 0, -0.0028);

  constexpr int bins = 30, windows = 8;
  std::vector<std::vector<double>> difference(bins), g(bins);
  std::vector<double> contacts;
  for (int w = 0; w < windows; ++w) {
    PairCorrelationOptions options;
    options.rMax = 3 * 0.00224;
    options.bins = bins;
    options.region.lower = Vec3(-0.05 + 0.025 * (w % 4), 0.008 + 0.036 * (w / 4), -1);
    options.region.upper = options.region.lower + Vec3(0.025, 0.036, 2);
    const auto local = pairCorrelation(frame, options);
    const Curve& e3 = local.g;
    contacts.push_back(local.coordination.series[0].y[9]);
    options.estimator = Estimator::guardZone;
    const auto e1 = pairCorrelation(frame, options).g;
    REQUIRE(e1.numbers.at("references") > 150);
    for (int b = 0; b < bins; ++b) {
      difference[b].push_back(e3.series[0].y[b] - e1.series[0].y[b]);
      g[b].push_back(e3.series[0].y[b]);
    }
  }
  for (int b = 0; b < 9; ++b)
    CHECK(mean(g[b]) == 0); // no overlap reaches a tenth of a diameter
  // Contacts, all in the bin below one diameter: between the isostatic numbers of rough and smooth spheres.
  CHECK(mean(contacts) > 4);
  CHECK(mean(contacts) < 6);
  for (int b = 9; b < bins; ++b) {
    const double t = mean(difference[b]) / std::sqrt(variance(difference[b]) / windows);
    INFO("bin " << b << ": g = " << mean(g[b]) << ", difference " << mean(difference[b]) << ", t = " << t);
    CHECK(std::abs(t) < studentFactor(0.999, windows - 1));
    CHECK(std::sqrt(variance(difference[b]) / windows) <
          0.1 * std::max(1.0, mean(g[b]))); // a test with teeth
  }
}
