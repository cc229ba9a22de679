// Planes, boxes and cylinders cut grains, walls and picks alike.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/clip.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

/// A square wall in the plane y = 0.
class Sheet : public WallShape {
public:
  void touches(const Vec3&, double, Touches&) const override {}
  double signedDistance(const Vec3&) const override { return 1; }
  Eigen::AlignedBox3d bounds() const override { return {Vec3(-1, 0, -1), Vec3(1, 0, 1)}; }
  TriangleMesh mesh(const Eigen::AlignedBox3d&) const override {
    TriangleMesh m;
    m.points = {Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 0, 1), Vec3(-1, 0, 1)};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    return m;
  }
};

Frame sheet() {
  Frame f;
  f.walls.push_back({"sheet", std::make_shared<Sheet>()});
  return f;
}

/// 360 pixels for 3 m: a pixel's place in the plane y = 0.
Vec3 placeOf(int x, int y) {
  return {(x + 0.5 - 320) / 120, 0, (180 - y - 0.5) / 120};
}

View sheetView() {
  View view = flatView(3);
  view.walls = true;
  view.box = false;
  view.wallOpacity = 1;
  return view;
}

std::vector<View> clippedViews() {
  std::vector<View> views(7, sheetView());
  views[0].clips = {{Vec3(0.25, 0, 0), Vec3(1, 0, 2)}};
  views[1].clipBoxes = {{Vec3(-0.5, -1, -0.25), Vec3(0.75, 1, 0.5), true}};
  views[2].clipBoxes = {{Vec3(-0.5, -1, -0.25), Vec3(0.75, 1, 0.5), false}};
  views[3].clipCylinders = {{Vec3(0.2, 5, 0.1), Vec3(0, 2, 0), 0.6, true}};
  views[4].clipCylinders = {{Vec3(0.2, 5, 0.1), Vec3(0, 1, 0.3), 0.6, false}};
  views[5].clips = {{Vec3::Zero(), Vec3::UnitZ()}};
  views[5].clipBoxes = {{Vec3(-0.7, -1, -0.7), Vec3(0.7, 1, 0.7), true}};
  views[5].clipCylinders = {{Vec3::Zero(), Vec3::UnitY(), 0.3, false}};
  views[6].clips = std::vector<ClipPlane>(9, {Vec3(0.1, 0, 0), Vec3::UnitX()}); // more than VTK's own six
  return views;
}

} // namespace

TEST_CASE("a wall is cut pixel by pixel, by the rule that cuts grains") {
  Renderer renderer;
  for (const View& view : clippedViews()) {
    const Image image = renderer.draw(sheet(), view);
    int wall = 0, cut = 0, wrong = 0;
    for (int y = 2; y < 358; y += 3)
      for (int x = 2; x < 638; x += 3) {
        const Vec3 place = placeOf(x, y);
        if (place.cwiseAbs().maxCoeff() > 0.97) continue;
        // Within a pixel of an edge either answer will do.
        const double pixel = 1.5 / 120;
        const bool clipped = isClipped(view, place);
        bool edge = false;
        for (const auto& [dx, dz] :
             {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}})
          edge = edge || isClipped(view, place + pixel * Vec3(dx, 0, dz)) != clipped;
        if (edge) continue;
        const bool white = at(image, x, y)[0] == 255;
        (clipped ? cut : wall) += 1;
        wrong += white != clipped;
      }
    CHECK(wall > 100);
    CHECK(cut > 100);
    CHECK(wrong == 0);
  }
}

TEST_CASE("grains are seen and picked where the clips leave their centres") {
  Renderer renderer;
  Frame frame;
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) {
      frame.id.push_back(static_cast<std::int64_t>(frame.id.size()));
      frame.position.emplace_back(0.23 * i, 0, 0.23 * k);
    }
  frame.scalars[quantity::radius] = std::vector<double>(frame.size(), 0.1);
  for (View view : clippedViews()) {
    view.colouring.quantity = "";
    const Image image = renderer.draw(frame, view);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const Vec3& p = frame.position[i];
      const int x = static_cast<int>(320 + 120 * p.x()), y = static_cast<int>(180 - 120 * p.z());
      CHECK((at(image, x, y)[0] == 255) == isClipped(view, p));
      CHECK(renderer.pick(x, y).grain == (isClipped(view, p) ? -1 : frame.id[i]));
    }
  }
}

TEST_CASE("clips that come and go leave nothing behind") {
  Renderer renderer;
  const Image whole = renderer.draw(sheet(), sheetView());
  for (const View& view : clippedViews())
    CHECK((renderer.draw(sheet(), view).rgba != whole.rgba));
  CHECK((renderer.draw(sheet(), sheetView()).rgba == whole.rgba));
}
