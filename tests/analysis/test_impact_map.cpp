// Single impacts against the closed forms.

#include "analysis/impact_map.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::analysis;

namespace {

const char* const text = R"(
[domain]
lower = ["0", "0", "0"]
upper = ["1 m", "1 m", "1 m"]

[[material]]
name = "glass"
density = "2500 kg/m^3"

[[material]]
name = "steel"

[[contact]]
between = ["glass", "glass"]
normal = { law = "linear", collision_time = "0.5 ms", restitution = 0.9 }
tangential = { law = "spring", friction = 0.3, stiffness_ratio = 0.2857142857142857 }

[[contact]]
between = ["glass", "steel"]
normal = { law = "linear", collision_time = "0.5 ms", restitution = 0.6 }
tangential = { law = "spring", friction = 0.1, stiffness_ratio = 0.2857142857142857 }

[[species]]
name = "bead"
material = "glass"
size = { distribution = "single", diameter = "3 mm" }

[[wall]]
name = "floor"
kind = "plane"
material = "steel"
point = ["0", "0", "0"]
normal = [0, 0, 1]

[[fill]]
kind = "random"
species = "bead"
number = 10

[[stage]]
name = "run"
until = { duration = "1 s" }

[accuracy]
steps_per_contact = 100
)";

} // namespace

TEST_CASE("gross sliding takes (7/2) mu (1 + e) of slip away", "[impact]") {
  const Scene scene = parseScene(text, "impacts");
  const Curve curve = impactMap(scene);
  const auto seriesOf = [&](const std::string& name) -> const Series& {
    for (const auto& s : curve.series)
      if (s.name == name) return s;
    FAIL("no series " << name);
    return curve.series.front();
  };
  for (const auto& [name, friction, restitution] :
       {std::tuple{"bead on bead", 0.3, 0.9}, {"bead on steel", 0.1, 0.6}}) {
    INFO(name);
    // The dashpot's restitution is met to a per cent at a hundred steps a contact.
    const double e = curve.numbers.at(std::string(name) + " restitution");
    CHECK(e == Approx(restitution).epsilon(0.01));
    const Series& map = seriesOf(name);
    REQUIRE(map.x.size() == 41);
    CHECK(map.y.front() == Approx(0).margin(1e-9)); // head-on
    int sliding = 0;
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      CHECK(map.y[i] <= map.x[i]); // friction adds no slip
      // Well above 7/2 mu (1 + e) the contact slides from its first to its last step, but for the end of the
      // dashpot's collision, in which the contact pulls and friction has nothing to hold it: a per cent.
      if (map.x[i] < 1.15 * 3.5 * friction * (1 + e)) continue;
      ++sliding;
      CHECK(map.x[i] - map.y[i] == Approx(3.5 * friction * (1 + e)).epsilon(0.01));
    }
    CHECK(sliding > 10);
    // Equal periods of both springs (ratio 2/7): slow slip comes back reversed.
    CHECK(map.y[2] < 0);
  }
}

TEST_CASE("without friction slip stays as it is", "[impact]") {
  Scene scene =
      parseScene(text, "impacts",
                 {"contact.glass-glass.tangential.friction=0", "contact.glass-steel.tangential.friction=0"});
  for (const Series& map : impactMap(scene).series)
    for (std::size_t i = 0; i < map.x.size(); ++i)
      CHECK(map.y[i] == Approx(map.x[i]).margin(0.01)); // the normal turns by less than 1 % of a radian
}
