// A million grains, and two runs side by side.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <unistd.h>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

} // namespace

TEST_CASE("a million grains are drawn, turned, cut and picked in bounded memory, up to the last corner") {
  Frame frame = cube(100, 1e-2, 5e-3);
  RandomStream random(8, RandomPurpose::test, 0);
  for (Vec3& p : frame.position) // a lattice seen along its axes has holes through and through
    p += 1e-3 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  Renderer renderer;
  View view = bareView();
  view.box = false;
  view.colouring = {.quantity = "", .plain = {0, 0, 0}};
  renderer.draw(cube(2), view); // what every renderer needs
  const double before = residentMegabytes();
  for (const char* preset : {"front", "right", "iso"}) {
    view.camera.preset = preset;
    view.camera.orthographic = true;
    const Image image = renderer.draw(frame, view);
    CHECK(renderer.drawnGrains() < 100000); // of a dense block only what faces the eye
    if (view.camera.preset == "iso") continue;
    // The block's face fills the free part of the picture: grain centres of its outermost rows are dark.
    int dark = 0;
    for (const double across : {0.005, 0.505, 0.995})
      for (const double up : {0.005, 0.505, 0.995}) {
        const Camera camera = renderer.resolvedCamera();
        const Vec3 p = view.camera.preset == "front" ? Vec3(across, 0, up) : Vec3(1, across, up);
        const Vec3 d = p - camera.position;
        const double scale = 360 / camera.orthographicHeight;
        const Vec3 right = (camera.target - camera.position).cross(camera.up).normalized();
        const int x = static_cast<int>(320 + scale * d.dot(right)),
                  y = static_cast<int>(180 - scale * d.dot(camera.up));
        dark += at(image, x, y)[0] < 128;
        CHECK(renderer.pick(x, y).grain >= 0);
      }
    CHECK(dark == 9);
  }
  view.clips = {{Vec3::Constant(0.5), Vec3(0, 1, 0)}};
  view.camera.preset = "front";
  renderer.draw(frame, view);
  CHECK(renderer.pick(320, 180).point.y() > 0.494); // half of the block is gone
  CHECK(renderer.pick(320, 180).point.y() < 0.53);
  // Lists of a million grains (48 MB of places and indices, 24 MB of order) and the rasteriser's buffers.
  CHECK(residentMegabytes() - before < 400);
}

TEST_CASE("a pair has one camera, and each half answers for its own grains") {
  Renderer renderer;
  View view = bareView(640, 180);
  view.colouring.quantity = "";
  const Frame left = cube(3);
  Frame right = cube(3);
  for (auto& id : right.id)
    id += 1000;
  for (double& r : right.scalars[quantity::radius])
    r *= 0.5;
  const Image both = renderer.drawPair(left, right, view, view);
  CHECK(both.width == 640);
  CHECK(both.height == 180);
  View half = view;
  half.width = 320;
  const Image alone = renderer.draw(left, half);
  half.camera = renderer.resolvedCamera();
  const Image other = renderer.draw(right, half);
  int unlike = 0;
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 640; ++x)
      if (x != 320) unlike += at(both, x, y) != (x < 320 ? at(alone, x, y) : at(other, x - 320, y));
  CHECK(unlike == 0);
  renderer.drawPair(left, right, view, view);
  int hits[2] = {0, 0};
  for (int y = 1; y < 180; y += 4)
    for (int x = 1; x < 640; x += 4) {
      const PickResult hit = renderer.pick(x, y);
      if (hit.grain < 0) continue;
      CHECK(hit.half == (x < 320 ? 0 : 1));
      CHECK((hit.grain >= 1000) == (x >= 320));
      ++hits[hit.half];
    }
  CHECK(hits[0] > 200);
  CHECK(hits[1] > 50);
  renderer.draw(left, half);
  CHECK(renderer.pick(480, 90).grain == -1); // beyond a single picture of 320
}
