// Spheres have their true size, depth and colour.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/colour_map.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

Frame grainsAt(const std::vector<Vec3>& centres, double radius) {
  Frame f;
  f.position = centres;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    f.id.push_back(static_cast<std::int64_t>(i));
    f.scalars["value"].push_back(static_cast<double>(i));
    f.scalars[quantity::radius].push_back(radius);
  }
  return f;
}

View coloured(View view, const std::string& map, double low, double high) {
  view.colouring.quantity = "value";
  view.colouring.map = map;
  view.colouring.range = ColourRange::fixed;
  view.colouring.low = low;
  view.colouring.high = high;
  return view;
}

View plain(View view, double grey) {
  view.colouring.quantity.clear();
  view.colouring.plain = {grey, grey, grey};
  return view;
}

/// Dark grey on white: the share of cover of a pixel is how far it is from white.
double silhouette(const Image& image) {
  double covered = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    covered += image.rgba[i] < 128;
  return covered;
}

} // namespace

TEST_CASE("the drawn area of a sphere is that of its disc") {
  Renderer renderer;
  for (const double radius : {0.1, 0.25, 0.4}) {
    const Image image = renderer.draw(grainsAt({Vec3::Zero()}, radius), plain(flatView(1.0), 0));
    // A disc of radius * 360 pixels; its radius, taken back from the area, is right to a quarter of a pixel.
    CHECK(std::sqrt(silhouette(image) / std::numbers::pi) == Approx(radius * 360).margin(0.25));
  }
}

TEST_CASE("a sphere under perspective has the outline of its tangent cone") {
  Renderer renderer;
  View view = plain(bareView(), 0);
  view.camera.preset.clear();
  view.camera.position = Vec3(0, -4, 0);
  const double radius = 0.8;
  const Image image = renderer.draw(grainsAt({Vec3::Zero()}, radius), view);
  // Half angle asin(R / d); on the picture plane tan of it in units of tan(15 deg) per half height (180
  // pixels).
  const double pixels = std::tan(std::asin(radius / 4)) / std::tan(15 * std::numbers::pi / 180) * 180;
  CHECK(std::sqrt(silhouette(image) / std::numbers::pi) == Approx(pixels).margin(0.25));
}

TEST_CASE("the nearer of two overlapping spheres is seen, whatever their order in the frame") {
  Renderer renderer;
  const View view = coloured(flatView(1.0), "discrete", 0, 8);
  const Image first = renderer.draw(grainsAt({Vec3(0, -0.5, 0), Vec3(0.1, 0.5, 0)}, 0.2), view);
  const Image second = renderer.draw(grainsAt({Vec3(0, 0.5, 0), Vec3(0.1, -0.5, 0)}, 0.2), view);
  const auto isBlue = [](const std::array<int, 3>& c) { return c[2] > c[0] + 50; };   // grain 0
  const auto isOrange = [](const std::array<int, 3>& c) { return c[0] > c[2] + 50; }; // grain 1
  const int x = 320 + 18, y = 180;                                                    // inside both discs
  CHECK(isBlue(at(first, x, y)));
  CHECK(isOrange(at(second, x, y)));
}

TEST_CASE("two spheres that cut each other meet in the plane between them") {
  Renderer renderer;
  const double r = 0.3, half = 0.1;
  const Image image = renderer.draw(grainsAt({Vec3(-half, 0, 0), Vec3(half, 0, 0)}, r),
                                    coloured(flatView(1.0), "discrete", 0, 8));
  for (const int y : {120, 180, 240}) {
    CHECK(at(image, 316, y)[2] > at(image, 316, y)[0]); // blue on the left
    CHECK(at(image, 324, y)[0] > at(image, 324, y)[2]); // orange on the right
  }
}

TEST_CASE("grains have the colours of the map, times light that does not depend on the colour") {
  Renderer renderer;
  const Frame frame = grainsAt({Vec3(-0.5, 0, 0), Vec3(0, 0, 0), Vec3(0.5, 0, 0)}, 0.2);
  const Image black = renderer.draw(frame, plain(flatView(1.0), 0)),
              white = renderer.draw(frame, plain(flatView(1.0), 1));
  for (const auto& map : {"viridis", "cividis", "coolwarm", "dune"}) {
    const Image image = renderer.draw(frame, coloured(flatView(1.0), map, 0, 2));
    const ColourMap colours(map);
    for (int grain = 0; grain < 3; ++grain)
      for (const int dx : {-40, 0, 30}) {
        const int x = 320 + 180 * (grain - 1) + dx, y = 175;
        const Rgb c = colours.at(grain / 2.0);
        for (int k = 0; k < 3; ++k) {
          const double lit = at(black, x, y)[k] + (at(white, x, y)[k] - at(black, x, y)[k]) * c[k] / 255.0;
          CHECK(at(image, x, y)[k] == Approx(lit).margin(2)); // two roundings to 8 bits
        }
      }
  }
}

TEST_CASE("an even subset keeps the asked number, the whole range and its order") {
  Renderer renderer;
  View view = plain(flatView(1.0), 0);
  std::vector<Vec3> row;
  for (int i = 0; i < 30; ++i)
    row.emplace_back(-0.725 + 0.05 * i, 0, 0);
  const Frame frame = grainsAt(row, 0.02);
  const double all = silhouette(renderer.draw(frame, view));
  view.maximumGrains = 10;
  CHECK(silhouette(renderer.draw(frame, view)) == Approx(all / 3).epsilon(0.01));
}
