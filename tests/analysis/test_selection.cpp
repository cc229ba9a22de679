// Expressions over the grains' quantities choose what they say.

#include "analysis/selection.h"
#include "sim/base/error.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sandglass;
using analysis::selectGrains;

namespace {

Frame five() {
  Frame f;
  for (int i = 0; i < 5; ++i) {
    f.id.push_back(10 + i);
    f.position.emplace_back(i, 0, 0.01 * i);
    f.scalars["charge"].push_back(i == 3 ? std::nan("") : i);
    f.vectors[quantity::velocity].emplace_back(0, 0, -i);
    f.vectors[quantity::spin].emplace_back(3.0 * i, 4.0 * i, 0);
  }
  return f;
}

} // namespace

TEST_CASE("an expression chooses the grains for which it holds") {
  const Frame frame = five();
  using Flags = std::vector<std::uint8_t>;
  CHECK(selectGrains(frame, "z > 0.015 && speed < 3.5") == Flags{0, 0, 1, 1, 0});
  CHECK(selectGrains(frame, "x<1||x>=4") == Flags{1, 0, 0, 0, 1});
  CHECK(selectGrains(frame, "|spin| == 5") == Flags{0, 1, 0, 0, 0}); // (3, 4, 0)
  CHECK(selectGrains(frame, "1>2||id==12||x==0") == Flags{1, 0, 1, 0, 0});
  CHECK(selectGrains(frame, "|spin|>7||charge==0") == Flags{1, 0, 1, 1, 1});
  CHECK(selectGrains(frame, "velocity.z < -2.5") == Flags{0, 0, 0, 1, 1});
  CHECK(selectGrains(frame, "!(id == 12)") == Flags{1, 1, 0, 1, 1});
  CHECK(selectGrains(frame, "sqrt(x) == 2 || abs(velocity.z + 1) < 1e-9") == Flags{0, 1, 0, 0, 1});
  CHECK(selectGrains(frame, "charge") == Flags{0, 1, 1, 0, 1}); // neither 0 nor NaN
  CHECK(selectGrains(frame, "1") == Flags{1, 1, 1, 1, 1});
  CHECK(selectGrains(frame, "x > 1 ? id < 14 : 0") == Flags{0, 0, 1, 1, 0});
  CHECK(selectGrains(Frame{}, "z > 1").empty());
}

TEST_CASE("what is no expression, or names what is not there, is a sentence") {
  const Frame frame = five();
  CHECK_THROWS_WITH(selectGrains(frame, "z > "), Catch::Contains("the selection \"z > \" is no expression"));
  CHECK_THROWS_WITH(selectGrains(frame, "height > 1"),
                    Catch::Contains("no quantity 'height'") && Catch::Contains("|spin|"));
  CHECK_THROWS_AS(selectGrains(frame, ""), InputError);
  CHECK_THROWS_AS(selectGrains(frame, "z = 0.1"), InputError);
  CHECK_THROWS_AS(selectGrains(frame, "(z > 1"), InputError);
}

TEST_CASE("further quantities come from the lookup") {
  const Frame frame = five();
  const auto chosen = selectGrains(frame, "original.z >= 2", [&](const std::string& name) {
    return name == "original.z" ? std::vector<double>{0, 1, 2, 3, 4} : grainScalar(frame, name);
  });
  CHECK(chosen == std::vector<std::uint8_t>{0, 0, 1, 1, 1});
}
