// Legend, title, walls and ground.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/colour_map.h"
#include "vis/ticks.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

/// Pixels in a rectangle that are not white.
int inked(const Image& image, int x0, int y0, int x1, int y1) {
  int count = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      count += at(image, x, y) != std::array<int, 3>{255, 255, 255};
  return count;
}

} // namespace

TEST_CASE("the legend's bar shows the map, exactly") {
  Renderer renderer;
  View view;
  view.colouring.map = "cividis";
  const Image image = renderer.draw(hopper(8e-3), view);
  const ColourMap map("cividis");
  // At 1280 x 720 the bar is 360 pixels high, in the middle, 102 pixels from the right edge.
  for (int row = 0; row < 360; row += 7) {
    const Rgb c = map.at((row + 0.5) / 360);
    CHECK(at(image, 1280 - 102 + 8, 539 - row) == std::array<int, 3>{c[0], c[1], c[2]});
  }
}

TEST_CASE("every part of the writing is there when asked for, and its place is free when not") {
  Renderer renderer;
  const Frame frame = hopper(8e-3);
  View view;
  view.title = "Title";
  const Image with = renderer.draw(frame, view);
  view.title.clear();
  view.legend = view.timeStamp = view.axes = view.scaleBar = false;
  const Image without = renderer.draw(frame, view);
  struct Place {
    const char* what;
    int x0, y0, x1, y1;
  };
  for (const auto& [what, x0, y0, x1, y1] :
       {Place{"title", 20, 20, 200, 50}, Place{"time", 1150, 20, 1260, 50},
        Place{"legend", 1160, 140, 1280, 545}, Place{"axes", 20, 600, 130, 700},
        Place{"scale", 1100, 650, 1260, 700}}) {
    INFO(what);
    CHECK(inked(with, x0, y0, x1, y1) > 100);
    CHECK(inked(without, x0, y0, x1, y1) == 0);
  }
}

TEST_CASE("walls are seen unless switched off or removed") {
  Renderer renderer;
  Frame frame = hopper(8e-3);
  frame.domain.periodic = {false, false, false}; // no box around
  View view = bareView();
  view.grains = false;
  CHECK(inked(renderer.draw(frame, view), 0, 0, 640, 360) == 0);
  view.walls = true;
  const int seen = inked(renderer.draw(frame, view), 0, 0, 640, 360);
  CHECK(seen > 1000);
  frame.walls[0].active = false;
  CHECK(inked(renderer.draw(frame, view), 0, 0, 640, 360) == 0);
  view.removedWalls = true;
  CHECK(inked(renderer.draw(frame, view), 0, 0, 640, 360) > 1000);
  view.clips = {{Vec3::Zero(), Vec3::UnitX()}}; // the left half goes
  const Image half = renderer.draw(frame, view);
  CHECK(inked(half, 0, 0, 310, 360) == 0);
  CHECK(inked(half, 330, 0, 640, 360) > seen / 3);
}

TEST_CASE("a transparent ground shows whatever lies under the picture") {
  Renderer renderer;
  const Frame frame = cube(3);
  View view;
  view.width = 640;
  view.height = 360;
  const Image opaque = renderer.draw(frame, view);
  view.transparentBackground = true;
  const Image cut = renderer.draw(frame, view);
  CHECK(cut.rgba[3] == 0); // a corner
  // Edges are smoothed in another way; where the opaque picture is even, both must agree.
  int compared = 0, wrong = 0;
  for (int y = 1; y < 359; ++y)
    for (int x = 1; x < 639; ++x) {
      int uneven = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          uneven = std::max(uneven, distance(at(opaque, x, y), at(opaque, x + dx, y + dy)));
      if (uneven > 12) continue;
      const int alpha = cut.rgba[4 * static_cast<std::size_t>(y * 640 + x) + 3];
      std::array<int, 3> onWhite = at(cut, x, y);
      for (int& c : onWhite)
        c = (c * alpha + 255 * (255 - alpha)) / 255;
      compared += alpha > 0;
      wrong += distance(onWhite, at(opaque, x, y)) > 6;
    }
  CHECK(compared > 10000);
  CHECK(wrong < 0.002 * compared); // lines thinner than a pixel
}

TEST_CASE("ticks are round, inside the range, and their labels distinct") {
  const Ticks speed = niceTicks(0, 0.573, 6);
  CHECK(speed.labels == std::vector<std::string>{"0.0", "0.1", "0.2", "0.3", "0.4", "0.5"});
  CHECK(speed.exponent == 0);
  const Ticks tiny = niceTicks(0, 2e-5, 5);
  CHECK(tiny.exponent == -6);
  CHECK(tiny.labels == std::vector<std::string>{"0", "5", "10", "15", "20"});
  CHECK(niceTicks(3, 3, 5).labels == std::vector<std::string>{"3"});
  CHECK(axisTitle("energy", "J", -6) == "energy [µJ]");
  CHECK(axisTitle("speed", "m/s", -3) == "speed [10⁻³ m/s]");
  CHECK(axisTitle("count", "", 6) == "count [10⁶]");
  CHECK(axisTitle("g(r)", "", 0) == "g(r)");
  CHECK(roundBelow(0.37) == Approx(0.2));
  CHECK(roundBelow(1.0) == Approx(1.0));
  CHECK(lengthText(0.02) == "2 cm");
  CHECK(lengthText(5e-4) == "500 µm");
  CHECK(timeText(0.125) == "t = 0.125 s");
  CHECK(timeText(0.0125) == "t = 12.50 ms");
}
