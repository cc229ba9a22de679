// Uniform random points have g = 1 in any container: the ideal gas is the test of the walls' correction.

#include "analysis/pair_correlation.h"
#include "analysis/statistics.h"
#include "tests/analysis/containers.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

struct Verdict {
  double worst = 0;       ///< largest deviation from 1 in standard errors of the mean
  double limit = 0;       ///< for one bin: Student's, one chance in 10^5
  double probability = 0; ///< of a chi-squared this large or larger
};

/// n independent replicates give each bin its mean and the standard error of it. Each deviation is a Student
/// variable of n - 1 degrees of freedom; its square is scaled by (n - 3) / (n - 1) to have mean 1 before the
/// sum is compared with chi-squared.
Verdict judge(const std::vector<std::vector<double>>& replicates) {
  const std::size_t bins = replicates.front().size();
  Verdict verdict;
  double chiSquared = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    std::vector<double> values;
    for (const auto& g : replicates)
      values.push_back(g[b]);
    const double z = (mean(values) - 1) / std::sqrt(variance(values) / static_cast<double>(values.size()));
    verdict.worst = std::max(verdict.worst, std::abs(z));
    chiSquared +=
        z * z * (static_cast<double>(replicates.size()) - 3) / (static_cast<double>(replicates.size()) - 1);
  }
  verdict.limit = studentFactor(1 - 1e-5, static_cast<double>(replicates.size()) - 1);
  verdict.probability = chiSquaredProbability(chiSquared, static_cast<double>(bins));
  return verdict;
}

Verdict uniformVerdict(const Vec3& size, std::array<bool, 3> periodic, double radius,
                       const std::vector<FrameWall>& walls, double rMax, Estimator estimator,
                       std::uint64_t count = 50) {
  std::vector<std::vector<double>> replicates;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const Frame frame = uniformFrame(1500, size, periodic, radius, walls, 100 + seed);
    PairCorrelationOptions options;
    options.estimator = estimator;
    options.rMax = rMax;
    options.bins = 20;
    options.directions = 16;
    options.seed = 1 + seed;
    replicates.push_back(pairCorrelation(frame, options).g.series[0].y);
  }
  return judge(replicates);
}

} // namespace

TEST_CASE("uniform points in walled containers give 1", "[gr][uniform]") {
  const double radius = 0.05;
  const Vec3 size(1, 1, 1.2);
  // The walls of scenes: their distances are tested together with the estimator.
  const auto [name, wall] = GENERATE(table<std::string, FrameWall>({
      {"box", sceneWall("box", {{"lower", Vec3(0, 0, 0)}, {"upper", Vec3(1, 1, 1.2)}})},
      {"cylinder",
       sceneWall(
           "cylinder",
           {{"base", Vec3(0.5, 0.5, 0)}, {"radius", 0.5}, {"height", 1.2}, {"ends", std::string("both")}})},
      {"cone", sceneWall("frustum", {{"base", Vec3(0.5, 0.5, 0)},
                                     {"lower_radius", 0.0},
                                     {"upper_radius", 0.5},
                                     {"height", 1.2},
                                     {"ends", std::string("both")}})},
  }));
  const Estimator estimator =
      GENERATE(Estimator::localShell, Estimator::translation, Estimator::inhomogeneous);
  // E2 and E4 take longer. Few replicates make Student's limit wide and chi-squared, whose bins are
  // correlated near walls, unreliable.
  const bool many = estimator == Estimator::localShell;
  const Verdict verdict =
      uniformVerdict(size, {false, false, false}, radius, {wall}, 0.5, estimator, many ? 50 : 16);
  INFO(name << " " << nameOf(estimator) << ": worst bin " << verdict.worst
            << " sigma, chi-squared probability " << verdict.probability);
  CHECK(verdict.worst < verdict.limit);
  if (!many) return;
  CHECK(verdict.probability > 0.001);
  CHECK(verdict.probability < 0.999);
}

TEST_CASE("without correction the same points fall below 1", "[gr][uniform]") {
  const Verdict verdict = uniformVerdict(Vec3(1, 1, 1.2), {false, false, false}, 0.05,
                                         {boxWall(Vec3(1, 1, 1.2))}, 0.5, Estimator::uncorrected);
  CHECK(verdict.worst > 100);
}

TEST_CASE("a periodic slab 2.5 diameters deep gives 1 beyond its depth", "[gr][uniform]") {
  // d = 0.1, depth 0.25, reach 0.5: every shell beyond 0.125 wraps round the slab.
  const Vec3 size(1.2, 1.2, 0.25);
  const FrameWall sides = wall("sides", [](const Vec3& x) {
    return std::min({x.x(), x.y(), 1.2 - x.x(), 1.2 - x.y()});
  });
  const Verdict verdict =
      uniformVerdict(size, {false, false, true}, 0.05, {sides}, 0.5, Estimator::localShell);
  INFO("worst bin " << verdict.worst << " sigma, chi-squared probability " << verdict.probability);
  CHECK(verdict.worst < verdict.limit);
  CHECK(verdict.probability > 0.001);
  CHECK(verdict.probability < 0.999);
}

TEST_CASE("the guard zone gives 1 as well", "[gr][uniform]") {
  const Verdict verdict = uniformVerdict(Vec3(1, 1, 1.2), {false, false, false}, 0.05,
                                         {boxWall(Vec3(1, 1, 1.2))}, 0.25, Estimator::guardZone);
  INFO("worst bin " << verdict.worst << " sigma, chi-squared probability " << verdict.probability);
  CHECK(verdict.worst < verdict.limit);
  CHECK(verdict.probability > 0.001);
  CHECK(verdict.probability < 0.999);
}

TEST_CASE("uniform points under a free surface give 1", "[gr][uniform]") {
  // An open box: the height field is found from the points themselves, and W ends two diameters below it.
  const Vec3 size(1, 1, 1.2);
  const FrameWall box = sceneWall(
      "box", {{"lower", Vec3(0, 0, 0)}, {"upper", Vec3(1, 1, 3)}, {"open", std::vector<std::string>{"z+"}}});
  std::vector<std::vector<double>> replicates;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Frame frame = uniformFrame(1500, size, {false, false, false}, 0.05, {box}, 300 + seed);
    frame.domain.upper.z() = 3;
    PairCorrelationOptions options;
    options.region.up = Vec3::UnitZ();
    options.rMax = 0.5;
    options.bins = 20;
    options.directions = 16;
    options.seed = 1 + seed;
    replicates.push_back(pairCorrelation(frame, options).g.series[0].y);
  }
  const Verdict verdict = judge(replicates);
  INFO("worst bin " << verdict.worst << " sigma, chi-squared probability " << verdict.probability);
  CHECK(verdict.worst < verdict.limit);
  CHECK(verdict.probability > 0.001);
  CHECK(verdict.probability < 0.999);
}

TEST_CASE("quoted errors are as large as the scatter", "[gr][uniform]") {
  // Pairs of uniform points in a periodic box are uncorrelated, so that the counting error is exact for them.
  // 40 frames: (g - 1) / error has mean square 1; over 20 bins and 40 frames its standard deviation is sqrt(2
  // / 800) = 5 %. (Near walls counts are correlated, and the error is the lower bound that it says.)
  PairCorrelationOptions options;
  options.rMax = 0.5;
  options.bins = 20;
  options.directions = 16;
  PairCorrelation all(options);
  double square = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Frame frame = uniformFrame(800, Vec3(1, 1, 1), {true, true, true}, 0.05, {}, 500 + seed);
    all.add(frame);
    options.seed = 1 + seed;
    const auto one = pairCorrelation(frame, options).g.series[0];
    for (std::size_t b = 0; b < 20; ++b)
      if (one.error[b] > 0) square += std::pow((one.y[b] - 1) / one.error[b], 2) / 800;
  }
  CHECK(square > 0.85);
  CHECK(square < 1.15);
  // The same frames together: blocks of frames give the error; 20 bins: standard deviation 32 % of the mean
  // square.
  const auto together = all.result();
  CHECK(together.g.frames == 40);
  double mean40 = 0;
  for (std::size_t b = 0; b < 20; ++b)
    mean40 += std::pow((together.g.series[0].y[b] - 1) / together.g.series[0].error[b], 2) / 20;
  INFO("mean squares " << square << " and " << mean40);
  CHECK(mean40 > 0.2);
  CHECK(mean40 < 2.2);
}

TEST_CASE("two species of uniform points, each in the space open to it, give 1", "[gr][uniform]") {
  // Radii 0.03 and 0.08 in a closed box: the regions differ, and so must the volumes that normalise.
  const Vec3 size(1, 1, 1.2);
  const FrameWall box = boxWall(size);
  const auto [a, b, estimator] = GENERATE(table<int, int, Estimator>(
      {{0, 1, Estimator::localShell}, {1, 1, Estimator::localShell}, {0, 1, Estimator::translation}}));
  std::vector<std::vector<double>> replicates;
  for (std::uint64_t seed = 0; seed < (estimator == Estimator::translation ? 8u : 20u); ++seed) {
    Frame frame = uniformFrame(500, size, {false, false, false}, 0.03, {box}, 700 + seed);
    const Frame large = uniformFrame(700, size, {false, false, false}, 0.08, {box}, 900 + seed);
    frame.position.insert(frame.position.end(), large.position.begin(), large.position.end());
    auto& radius = frame.scalars[quantity::radius];
    radius.resize(1200, 0.08);
    frame.scalars[quantity::species] = std::vector<double>(500, 0.0);
    frame.scalars[quantity::species].resize(1200, 1.0);
    frame.speciesNames = {"small", "large"};
    PairCorrelationOptions options;
    options.rMax = 0.5;
    options.bins = 15;
    options.directions = 16;
    options.seed = 1 + seed;
    options.species = std::pair{a, b};
    options.estimator = estimator;
    replicates.push_back(pairCorrelation(frame, options).g.series[0].y);
  }
  const Verdict verdict = judge(replicates);
  INFO(nameOf(estimator) << " " << a << b << ": worst bin " << verdict.worst
                         << " sigma, chi-squared probability " << verdict.probability);
  CHECK(verdict.worst < verdict.limit);
}

TEST_CASE("points thinning out upwards: E4 gives 1, E3 does not", "[gr][uniform]") {
  // Density falling linearly to a fifth over the height of the box, by rejection.
  const Vec3 size(1, 1, 1.2);
  std::vector<std::vector<double>> e3, e4;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(1100 + seed, RandomPurpose::test, 3);
    std::vector<Vec3> points;
    while (points.size() < 3000) {
      const Vec3 x(random.uniform(0.05, 0.95), random.uniform(0.05, 0.95), random.uniform(0.05, 1.15));
      if (random.uniform() < 1 - 0.8 * (x.z() - 0.05) / 1.1) points.push_back(x);
    }
    Frame frame = frameOf(std::move(points), size, {false, false, false}, 0.05);
    frame.walls = {boxWall(size)};
    PairCorrelationOptions options;
    options.rMax = 0.5;
    options.bins = 10;
    options.directions = 16;
    options.seed = 1 + seed;
    e3.push_back(pairCorrelation(frame, options).g.series[0].y);
    options.estimator = Estimator::inhomogeneous;
    e4.push_back(pairCorrelation(frame, options).g.series[0].y);
  }
  // The mean of rho^2 over that of rho, squared: 1.145 at small distance.
  CHECK(judge(e3).worst > 30);
  // rho from balls of two diameters is a little smoothed beside the walls: within 1 % everywhere.
  for (std::size_t b = 0; b < 10; ++b) {
    double sum = 0;
    for (const auto& g : e4)
      sum += g[b] / 20;
    INFO("bin " << b);
    CHECK(sum == Approx(1).margin(0.01));
  }
}
