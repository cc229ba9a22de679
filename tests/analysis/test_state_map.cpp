// The state map on made-up states: rest, gas, shear; rearrangement; smoothing.

#include "analysis/registry.h"
#include "analysis/state_map.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

/// A touching lattice under the pressure of its contact forces, sheared with u_x = rate z.
Frame sheared(double rate, double force, double jitter, std::uint64_t seed) {
  Frame frame = faceCentredFrame(5);
  frame.domain.periodic = {true, true, false};
  RandomStream random(seed, RandomPurpose::test, 1);
  for (const auto& x : frame.position)
    frame.vectors[quantity::velocity].push_back(
        Vec3(rate * x.z(), 0, 0) + jitter * Vec3(random.normal(), random.normal(), random.normal()));
  const double L = frame.domain.upper.x();
  for (std::size_t i = 0; i < frame.size(); ++i)
    for (std::size_t j = i + 1; j < frame.size(); ++j) {
      Vec3 h = frame.position[i] - frame.position[j];
      FrameContact c;
      for (int k = 0; k < 2; ++k) {
        c.image[static_cast<std::size_t>(k)] = static_cast<int>(std::lround(h[k] / L));
        h[k] -= L * c.image[static_cast<std::size_t>(k)];
      }
      if (h.norm() > 1.001) continue;
      c.a = frame.id[i];
      c.b = frame.id[j];
      c.normal = h.normalized();
      c.force = force * c.normal;
      c.point = frame.position[i] - 0.5 * h;
      frame.contacts.push_back(c);
    }
  return frame;
}

std::array<double, 3> shares(const std::vector<Frame>& frames, StateOptions options = {}) {
  options.diameter = 1;
  options.density = 2500;
  StateMap map(options);
  for (const auto& f : frames)
    map.add(f);
  return map.shares().back().share;
}

} // namespace

TEST_CASE("the pressure and the inertial number of a lattice under force", "[state]") {
  // fcc: P = (number density) Z/2 f d / 3 = sqrt(2) 6 f / 3 for d = 1. Inner layers only: the kernel is cut
  // at the faces.
  StateOptions options;
  options.diameter = 1;
  options.density = 2500;
  StateMap map(options);
  const Frame frame =
      sheared(0.05, 100, 0, 1); // slow: the gradient across the kernel adds to the kinetic stress
  map.add(frame);
  const double pressure = std::sqrt(2.0) * 6 * 100 / 3, expected = 0.05 * std::sqrt(2500 / pressure);
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (std::abs(frame.position[i].z() - 3.5) < 0.3)
      CHECK(map.motion()[i].inertia == Approx(expected).epsilon(0.03));
}

TEST_CASE("rest is solid, shear is liquid, flight is gas", "[state]") {
  // The inertial number of the lattice above is rate sqrt(2500 / P), P = 282.8 for forces of 100: 2.97 rate.
  CHECK(shares({sheared(1e-5, 100, 0, 1)})[0] == 1);
  CHECK(shares({sheared(0.01, 100, 1e-4, 1)})[1] > 0.95);
  Frame gas = uniformFrame(400, Vec3::Constant(12), {true, true, true}, 0.5, {}, 2); // phi = 0.12
  RandomStream random(3, RandomPurpose::test, 1);
  for (std::size_t i = 0; i < gas.size(); ++i)
    gas.vectors[quantity::velocity].push_back(random.direction());
  CHECK(shares({gas})[2] > 0.9);
}

TEST_CASE("grains that change places are not solid", "[state]") {
  const Frame before = sheared(0, 100, 0, 1);
  Frame after = before;
  RandomStream random(3, RandomPurpose::test, 2);
  for (auto& x :
       after.position) // 0.2 in each direction: D2min about 2 x 3 x 0.04, less what an affine map takes
    x += 0.2 * Vec3(random.normal(), random.normal(), 0 * random.normal());
  StateOptions options;
  options.memory = 1;
  CHECK(shares({before, before}, options)[0] == 1);
  CHECK(shares({before, after}, options)[0] < 0.05);
  // An affine motion is no rearrangement.
  Frame stretched = before;
  for (auto& x : stretched.position)
    x.z() *= 1.02;
  CHECK(shares({before, stretched}, options)[0] == 1);
}

TEST_CASE("a state has to last", "[state]") {
  const Frame solid = sheared(1e-5, 100, 0, 1), liquid = sheared(0.01, 100, 0, 1);
  StateOptions options;
  options.memory = 3;
  options.limits.rearranged = 100;
  CHECK(shares({solid, solid, liquid}, options)[0] == 1); // two against one
  CHECK(shares({solid, liquid, liquid}, options)[1] == 1);
}

TEST_CASE("thresholds and units stand on the result", "[state]") {
  const AnalysisKind& kind = analysisKind("state");
  const Results r =
      analyze(kind, defaultKnobs(kind), {}, {std::make_shared<Frame>(sheared(0.01, 100, 0, 1))});
  CHECK_THAT(r.curves[0].definition, Catch::Contains("I > 0.1") && Catch::Contains("contact forces"));
  CHECK(r.grains[0].classes.at(2) == "gas");
  REQUIRE(r.tables[0].rows.size() == 11);
  for (const auto& row : r.tables[0].rows)
    CHECK(row[0] + row[1] + row[2] == Approx(1));
}
