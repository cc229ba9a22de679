// Two samples and two frames beside each other.

#include "analysis/compare.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

TEST_CASE("the Kolmogorov-Smirnov test keeps its promise", "[compare]") {
  // 400 pairs of samples of one distribution: probabilities below 0.1 in a tenth of the cases, standard
  // deviation 1.5 %.
  int small = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    RandomStream random(seed, RandomPurpose::test, 31);
    std::vector<double> a(80), b(120);
    for (double& x : a)
      x = random.normal();
    for (double& x : b)
      x = random.normal();
    small += compareSamples(a, b).probability < 0.1;
  }
  CHECK(small > 400 * (0.1 - 4 * 0.015));
  CHECK(small < 400 * (0.1 + 4 * 0.015));
  // Two step functions that are apart entirely, and tables: at the critical value 1.3581 / sqrt(n) the chance
  // is 0.05.
  CHECK(compareSamples({1, 2, 3}, {4, 5, 6}).distance == 1);
  std::vector<double> even, shifted;
  for (int k = 0; k < 20000; ++k) {
    even.push_back(k);
    shifted.push_back(k + 20000 * 0.013581);
  }
  CHECK(compareSamples(even, shifted).probability == Approx(0.05).epsilon(0.03));
  CHECK(compareSamples(even, even).probability == 1);
}

TEST_CASE("frames are compared grain by grain over periodic borders", "[compare]") {
  Frame a = simpleCubicFrame(3);
  a.vectors[quantity::velocity].assign(a.size(), Vec3::Zero());
  Frame b = a;
  b.time = 0.25;
  for (auto& x : b.position)
    x.x() = std::fmod(x.x() + 2.9, 3.0); // 0.1 back, the other way round
  b.vectors[quantity::velocity].assign(a.size(), Vec3(0, 3, 4));
  const FrameDifference d = difference(a, b);
  CHECK(d.common == 27);
  CHECK(d.largest == Approx(0.1));
  CHECK(d.rms == Approx(0.1));
  CHECK(d.velocityRms == Approx(5));
  CHECK(d.timeGap == Approx(0.25));
  Frame other = a;
  for (auto& id : other.id)
    id += 100;
  CHECK(difference(a, other).common == 0);
  CHECK(std::isnan(difference(a, other).rms));
}

TEST_CASE("distributions of equal frames are equal", "[compare]") {
  const Frame a = uniformFrame(500, Vec3::Ones(), {true, true, true}, 0.01, {}, 1);
  Frame b = a;
  for (auto& x : b.position)
    x.z() *= 0.8;
  const Table same = compareDistributions(a, a), changed = compareDistributions(a, b);
  REQUIRE(same.rows.size() == 3); // x, y, z; the radius is constant
  for (const auto& row : same.rows)
    CHECK(row[3] == 1);
  CHECK(changed.rows[0][3] == 1);
  CHECK(changed.rows[2][3] < 1e-3);
}
