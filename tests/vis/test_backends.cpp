// One picture, whatever draws it: OSMesa or EGL, main thread or another, first renderer or fifth.

#include "tests/vis/sample_fields.h"
#include "tests/vis/sample_frames.h"
#include "vis/renderer.h"

#include <catch2/catch.hpp>

#include <thread>

using namespace sandglass;
using namespace sandglass::vis;

namespace {

View smallView() {
  View view;
  view.width = 320;
  view.height = 180;
  view.title = "Back ends";
  return view;
}

Image drawnInThread(GlBackend backend) {
  Image image;
  std::thread([&] { image = Renderer(backend).draw(test::hopper(4e-3), smallView()); }).join();
  return image;
}

} // namespace

TEST_CASE("OSMesa and EGL draw the same pixels, on any thread, one renderer after another") {
  const Image first = Renderer(GlBackend::osmesa).draw(test::hopper(4e-3), smallView());
  REQUIRE(first.rgba.size() == 320u * 180u * 4u);
  std::size_t inked = 0; // an empty picture would equal an empty picture
  for (std::size_t i = 0; i < first.rgba.size(); i += 4)
    inked += first.rgba[i] < 250;
  REQUIRE(inked > 320u * 180u / 20u);
  for (const GlBackend backend : {GlBackend::egl, GlBackend::osmesa, GlBackend::egl, GlBackend::automatic}) {
    CHECK(Renderer(backend).draw(test::hopper(4e-3), smallView()).rgba == first.rgba);
    CHECK(drawnInThread(backend).rgba == first.rgba);
  }
}

TEST_CASE("OSMesa and EGL draw the same shapes, chains, arrows, slices and cuts") {
  Frame frame = test::cube(5);
  frame.shapes = {{Vec3(4e-3, 3e-3, 2e-3), 0.3, 0.7}};
  RandomStream random(2, RandomPurpose::test, 0);
  for (std::int64_t i = 0; i < 125; ++i) {
    frame.scalars[quantity::shape].push_back(static_cast<double>(i % 2 - 1)); // every other one a sphere
    frame.orientation.push_back(
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), 1).normalized());
    if (i > 0)
      frame.contacts.push_back({i - 1,
                                i,
                                -1,
                                {0, 0, 0},
                                frame.position[static_cast<std::size_t>(i)],
                                Vec3::UnitZ(),
                                random.uniform() * Vec3::UnitZ(),
                                0});
  }
  frame.walls = test::hopper(8e-3).walls;
  frame.fields = {test::swirl(9, 1)};
  View view = smallView();
  view.grainScale = 0.8;
  view.forceChains.shown = view.slice.shown = true;
  view.slice.streamlines = view.arrows.vector = "velocity";
  view.clipCylinders = {{Vec3(0.02, 0.02, 0), Vec3::UnitZ(), 0.01, false}};
  view.selection = {"x > 0.01", Selection::Use::highlight, {}};
  const Image a = Renderer(GlBackend::osmesa).draw(frame, view),
              b = Renderer(GlBackend::egl).draw(frame, view);
  CHECK((a.rgba == b.rgba));
  view.forceChains.shown = false;
  CHECK((Renderer(GlBackend::osmesa).draw(frame, view).rgba != a.rgba)); // what is compared is there
}

TEST_CASE("two renderers take turns on one thread") {
  Renderer osmesa(GlBackend::osmesa), egl(GlBackend::egl), another(GlBackend::osmesa);
  CHECK(osmesa.backendName().starts_with("osmesa"));
  CHECK(egl.backendName().starts_with("egl"));
  const Frame frame = test::hopper(4e-3);
  const Image a = osmesa.draw(frame, smallView()), b = egl.draw(frame, smallView());
  CHECK(another.draw(frame, smallView()).rgba == a.rgba);
  CHECK(b.rgba == a.rgba);
  CHECK(osmesa.draw(frame, smallView()).rgba == a.rgba);
}

TEST_CASE("a renderer that has drawn other frames, sizes and views draws the same again") {
  Renderer renderer;
  const Image before = renderer.draw(test::hopper(4e-3), smallView());
  View other = smallView();
  other.width = 500;
  other.walls = false;
  other.colouring.map = "coolwarm";
  renderer.draw(test::cube(5), other);
  CHECK(renderer.draw(test::hopper(4e-3), smallView()).rgba == before.rgba);
}

TEST_CASE("two drawing threads at a time do not disturb each other") {
  const Image expected = drawnInThread(GlBackend::osmesa);
  Image a, b;
  std::thread first([&] { a = Renderer(GlBackend::osmesa).draw(test::hopper(4e-3), smallView()); });
  std::thread second([&] { b = Renderer(GlBackend::egl).draw(test::hopper(4e-3), smallView()); });
  first.join();
  second.join();
  CHECK(a.rgba == expected.rgba);
  CHECK(b.rgba == expected.rgba);
}
