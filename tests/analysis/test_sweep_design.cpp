// Which points a sweep runs: grids, samples, what is derived, refinement.

#include "analysis/sweep/sweep_design.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace sandglass;
using namespace sandglass::analysis;

namespace {

SweepPlan planOf(const std::string& text) {
  return parseSweep("scene = \"s\"\n" + text, "S.toml", ".", std::string("seed = 5"));
}

double at(const SweepPoint& point, std::size_t column) {
  return std::get<double>(point.values.at(column));
}

} // namespace

TEST_CASE("grids cross linear, logarithmic, listed and text axes", "[sweep]") {
  const SweepPlan plan = planOf(R"(
seeds = 3
[[axis]]
name = "a"
from = 1
to = 100
count = 3
scale = "log"
[[axis]]
name = "b"
unit = "mm"
values = [4, "1 cm"]
[[axis]]
name = "c"
values = ["x", "y"]
[[derived]]
name = "n"
value = "rint(1000 / a) + b"
whole = true
)");
  CHECK(plan.seeds == std::vector<std::uint64_t>{5, 6, 7});
  const auto points = firstPoints(plan);
  REQUIRE(points.size() == 12);
  std::set<double> a, b;
  for (const auto& p : points) {
    a.insert(at(p, 0));
    b.insert(at(p, 1));
    CHECK(at(p, 3) == std::round(1000 / at(p, 0)) + at(p, 1));
  }
  REQUIRE(a.size() == 3);
  CHECK(*std::next(a.begin()) == Approx(10));
  CHECK(b == std::set<double>{4, 10});
  CHECK(points.front().id == 1);
  CHECK(points.back().id == 12);
  for (std::size_t k = 0; k < 8; ++k)
    CHECK(at(points[k], 0) != Approx(10));          // the middle comes last
  CHECK(overridesOf(plan, points.front()).empty()); // no axis has a key
}

TEST_CASE("overrides are what --set takes, to the last bit", "[sweep]") {
  const SweepPlan plan = planOf(R"(
set = ["output.contacts=true"]
[[axis]]
name = "d"
keys = ["species.a.size.diameter", "species.b.size.diameter"]
unit = "mm"
values = [0.1]
[[axis]]
name = "law"
key = "field.air.law"
values = ["lin\"ear"]
[[derived]]
name = "n"
key = "fill.1.number"
value = "2.6 / d"
whole = true
[[derived]]
name = "w"
key = "field.air.omega"
unit = "rad/s"
value = "d / 3"
)");
  CHECK(overridesOf(plan, firstPoints(plan).front()) ==
        std::vector<std::string>{"output.contacts=true", "species.a.size.diameter=\"0.1 mm\"",
                                 "species.b.size.diameter=\"0.1 mm\"", "field.air.law=\"lin\\\"ear\"",
                                 "fill.1.number=26", "field.air.omega=\"0.03333333333333333 rad/s\""});
}

TEST_CASE("a Latin hypercube has one sample in each part of each axis", "[sweep]") {
  const std::string axes =
      "[[axis]]\nname = \"a\"\nfrom = 2\nto = 4\n[[axis]]\nname = \"b\"\nfrom = 1\nto = 1e4\n"
      "scale = \"log\"\n";
  const auto points = firstPoints(planOf("sampling = \"latin_hypercube\"\npoints = 50\n" + axes));
  REQUIRE(points.size() == 50);
  std::set<int> a, b;
  for (const auto& p : points) {
    a.insert(static_cast<int>((at(p, 0) - 2) / 2 * 50));
    b.insert(static_cast<int>(std::log10(at(p, 1)) / 4 * 50));
  }
  CHECK(a.size() == 50);
  CHECK(b.size() == 50);
  // Random samples do not, follow their seed, and lie in their limits.
  const auto random = [&](int seed) {
    return firstPoints(
        planOf("sampling = \"random\"\npoints = 50\nsampling_seed = " + std::to_string(seed) + "\n" + axes));
  };
  a.clear();
  for (const auto& p : random(1)) {
    a.insert(static_cast<int>((at(p, 0) - 2) / 2 * 50));
    CHECK((at(p, 1) >= 1 && at(p, 1) <= 1e4));
  }
  CHECK(a.size() < 50);
  CHECK(random(1)[7].values == random(1)[7].values);
  CHECK(random(1)[7].values != random(2)[7].values);
}

TEST_CASE("refinement closes in on a border", "[sweep]") {
  const SweepPlan plan =
      planOf("[[axis]]\nname = \"a\"\nfrom = 0\nto = 1\ncount = 5\n[[axis]]\nname = \"b\"\nvalues = "
             "[0, 1]\n[refine]\nlevels = 4\n");
  // Two states with a border at a = 0.3 + 0.1 b.
  const auto differ = [](const SweepPoint& x, const SweepPoint& y) {
    return (at(x, 0) < 0.3 + 0.1 * at(x, 1)) != (at(y, 0) < 0.3 + 0.1 * at(y, 1));
  };
  auto points = firstPoints(plan);
  for (int level = 1; level <= 4; ++level) {
    const auto added = refinedPoints(plan, points, level, differ);
    CHECK(added.size() >= 2);
    CHECK(added.size() < 12); // near the border alone
    for (const auto& p : added) {
      CHECK(p.level == level);
      CHECK(p.id == static_cast<int>(points.size()) + 1);
      points.push_back(p);
    }
  }
  for (const double b : {0.0, 1.0}) { // the border lies between neighbours a sixty-fourth apart
    double below = 0, above = 1;
    for (const auto& p : points)
      if (at(p, 1) == b)
        (at(p, 0) < 0.3 + 0.1 * b ? below : above) =
            at(p, 0) < 0.3 + 0.1 * b ? std::max(below, at(p, 0)) : std::min(above, at(p, 0));
    CHECK(above - below == Approx(1.0 / 64));
  }
}
