// Maps rise evenly, and wrong names are named.

#include "sim/base/error.h"
#include "vis/colour_map.h"
#include "vis/view.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sandglass;
using namespace sandglass::vis;

namespace {

/// CIE L* of an sRGB colour (IEC 61966-2-1, CIE 15).
double lightness(const Rgb& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y =
      0.2126 * linear(c[0] / 255.0) + 0.7152 * linear(c[1] / 255.0) + 0.0722 * linear(c[2] / 255.0);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

} // namespace

TEST_CASE("sequential maps rise in lightness, each eighth by about an eighth") {
  for (const auto& name : {"viridis", "cividis", "inferno", "magma", "dune", "grey"}) {
    INFO(name);
    const ColourMap map(name);
    const double all = lightness(map.at(1)) - lightness(map.at(0));
    CHECK(all > 50);
    for (int k = 0; k < 8; ++k) {
      const double rise = lightness(map.at((k + 1) / 8.0)) - lightness(map.at(k / 8.0));
      CHECK(rise == Approx(all / 8).margin(0.25 * all / 8));
    }
  }
}

TEST_CASE("the diverging map is light and grey in the middle, and as dark at both ends") {
  const ColourMap map("coolwarm");
  const Rgb middle = map.at(0.5);
  CHECK(std::abs(middle[0] - middle[2]) < 6);
  CHECK(lightness(middle) > 85);
  CHECK(lightness(map.at(0)) == Approx(lightness(map.at(1))).margin(3));
}

TEST_CASE("what lies outside the range has the end's colour, what is no number is grey") {
  const ColourMap map("viridis");
  CHECK(map.at(-3) == map.at(0));
  CHECK(map.at(7) == map.at(1));
  CHECK(map.at(0) == Rgb{0x44, 0x01, 0x54});
  CHECK(map.at(1) == Rgb{0xfd, 0xe7, 0x25});
  CHECK(map.at(std::nan("")) == Rgb{150, 150, 150});
}

TEST_CASE("counted things get eight distinct colours, then the first again") {
  const ColourMap map("discrete");
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < a; ++b)
      CHECK(map.ofIndex(a) != map.ofIndex(b));
  CHECK(map.ofIndex(8) == map.ofIndex(0));
}

TEST_CASE("a map that does not exist is refused with the list of those that do") {
  CHECK_THROWS_WITH(ColourMap("jet"), Catch::Contains("'jet'") && Catch::Contains("viridis, cividis"));
}
