// One picture, whatever draws it: OSMesa or EGL, main thread or another, first renderer or fifth.

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
