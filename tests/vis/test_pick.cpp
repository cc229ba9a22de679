// What is seen can be picked, what is clipped can neither be seen nor picked.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/colour_map.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

Frame randomGrains(int count) {
  Frame f;
  f.domain.upper = Vec3(1, 1, 1);
  RandomStream random(11, RandomPurpose::test, 0);
  for (int i = 0; i < count; ++i) {
    f.position.emplace_back(random.uniform(), random.uniform(), random.uniform());
    f.id.push_back(100 + i);
    f.scalars[quantity::radius].push_back(random.uniform(0.03, 0.08));
  }
  return f;
}

View plainView(double grey) {
  View view = bareView();
  view.colouring.quantity.clear();
  view.colouring.plain = {grey, grey, grey};
  return view;
}

/// Pixels whose surroundings are not all like them lie on an edge, where a pixel shows two things.
bool isInside(const Image& image, int x, int y, int reach = 2) {
  for (int dx = -reach; dx <= reach; ++dx)
    for (int dy = -reach; dy <= reach; ++dy)
      if ((at(image, x + dx, y + dy)[0] > 250) != (at(image, x, y)[0] > 250)) return false;
  return true;
}

} // namespace

TEST_CASE("a pixel shows a grain exactly where one is picked") {
  Renderer renderer;
  const Frame frame = randomGrains(60);
  for (const bool orthographic : {false, true})
    for (const bool clipped : {false, true}) {
      View view = plainView(0);
      view.camera.orthographic = orthographic;
      if (clipped) view.clips = {{Vec3(0.5, 0.5, 0.5), Vec3(1, 0.3, 0)}};
      const Image image = renderer.draw(frame, view);
      int hits = 0, wrong = 0;
      for (int y = 3; y < 357; y += 4)
        for (int x = 3; x < 637; x += 4) {
          if (!isInside(image, x, y)) continue;
          const bool seen = at(image, x, y)[0] < 250, picked = renderer.pick(x, y).grain >= 0;
          // A gap of one pixel between three grains is smoothed away in the picture.
          if (!picked && (renderer.pick(x - 1, y).grain >= 0 || renderer.pick(x + 1, y).grain >= 0)) continue;
          hits += picked;
          wrong += seen != picked;
        }
      CHECK(hits > 300);
      CHECK(wrong == 0);
    }
}

TEST_CASE("the grain that is picked is the one whose colour is seen") {
  Renderer renderer;
  const Frame frame = randomGrains(60);
  View view = bareView();
  view.colouring = {.quantity = "id", .map = "viridis", .range = ColourRange::fixed, .low = 100, .high = 159};
  const Image image = renderer.draw(frame, view);
  const Image white = renderer.draw(frame, plainView(1)), black = renderer.draw(frame, plainView(0));
  const ColourMap map("viridis");
  int compared = 0, wrong = 0;
  for (int y = 2; y < 358; y += 3)
    for (int x = 2; x < 638; x += 3) {
      const auto grain = renderer.pick(x, y).grain;
      bool alone = grain >= 0; // no other grain's edge nearby
      for (const auto& [dx, dy] :
           {std::pair{3, 0}, {-3, 0}, {0, 3}, {0, -3}, {3, 3}, {-3, 3}, {3, -3}, {-3, -3}})
        alone = alone && renderer.pick(x + dx, y + dy).grain == grain;
      if (!alone) continue;
      const double light = at(white, x, y)[1] - at(black, x, y)[1];
      if (light < 60) continue;
      // Viridis' green rises all along the map: it tells the id. Roundings to 8 bits and the smoothing of the
      // shaded rim lie in between; another grain would be off by 80 on average.
      const double green =
          at(black, x, y)[1] + light * map.at(static_cast<double>(grain - 100) / 59)[1] / 255;
      ++compared;
      wrong += std::abs(at(image, x, y)[1] - green) > 6;
    }
  CHECK(compared > 500);
  CHECK(wrong == 0);
}

TEST_CASE("a clipped grain can be neither seen nor picked, and the one behind it can") {
  Renderer renderer;
  Frame frame;
  frame.position = {Vec3(0, -1, 0), Vec3(0, 1, 0)};
  frame.id = {7, 8};
  frame.scalars[quantity::radius] = {0.3, 0.3};
  View view = flatView(2);
  view.colouring.quantity = "";
  renderer.draw(frame, view);
  const PickResult front = renderer.pick(320, 180);
  CHECK(front.grain == 7);
  CHECK(front.point.y() == Approx(-1.3).margin(1e-4)); // the surface towards the camera
  view.clips = {{Vec3::Zero(), Vec3::UnitY()}};
  renderer.draw(frame, view);
  CHECK(renderer.pick(320, 180).grain == 8);
  view.clips.push_back({Vec3::Zero(), -Vec3::UnitY()});
  const Image nothing = renderer.draw(frame, view);
  CHECK(renderer.pick(320, 180).grain == -1);
  CHECK(at(nothing, 320, 180) == std::array<int, 3>{255, 255, 255});
  CHECK(renderer.pick(-1, 0).grain == -1);
  CHECK(renderer.pick(0, 360).grain == -1);
}

TEST_CASE("a rectangle holds the grains whose centres are in it, hidden ones too, clipped ones not") {
  Renderer renderer;
  Frame frame;
  frame.id = {1, 2, 3, 4};
  frame.position = {Vec3(-0.5, 0, 0.5), Vec3(0.5, 0, 0.5), Vec3(0.5, 1, 0.5), Vec3(0.5, 0, -0.5)};
  frame.scalars[quantity::radius] = {0.2, 0.2, 0.2, 0.2};
  View view = flatView(2); // 180 pixels for a metre
  view.colouring.quantity = "";
  renderer.draw(frame, view);
  using Ids = std::vector<std::int64_t>;
  CHECK(renderer.grainsIn(0, 0, 639, 359) == Ids{1, 2, 3, 4});
  CHECK(renderer.grainsIn(420, 100, 400, 80) == Ids{2, 3}); // the pixel (410, 90)
  CHECK(renderer.grainsIn(410, 90, 410, 90) == Ids{2, 3});
  CHECK(renderer.grainsIn(411, 90, 430, 100).empty());
  view.clips = {{Vec3(0, 0.5, 0), Vec3::UnitY()}};
  renderer.draw(frame, view);
  CHECK(renderer.grainsIn(0, 0, 639, 359) == Ids{3});
  view.clips.clear();
  view.camera.orthographic = false;
  renderer.draw(frame, view); // from 20 m: the same but for the grain further back, nearer to the middle
  // 180 / tan(15 degrees) pixels for a metre at 1 m: grain 2 at 20 m lies 16.8 pixels off the middle, 3 at
  // 21 m 16.0.
  CHECK(renderer.grainsIn(336, 0, 336, 359) == Ids{2, 4});
  CHECK(renderer.grainsIn(335, 0, 335, 359) == Ids{3});
}
