// Contacts, arrows and tracks have the place, length and thickness that they should.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/arrows.h"
#include "vis/force_chains.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

/// Three grains in a row along x, 1 m apart; contacts 0-1 (2 N), 1-2 (1 N), 2-0 through the periodic face
/// (4 N), 0-floor (0.1 N).
Frame row() {
  Frame f;
  f.domain = {Vec3(0, -1, -1), Vec3(3, 1, 1), {true, false, false}};
  f.id = {5, 7, 9};
  f.position = {Vec3(0.5, 0, 0), Vec3(1.5, 0, 0), Vec3(2.5, 0, 0)};
  f.scalars[quantity::radius] = {0.5, 0.5, 0.5};
  f.vectors[quantity::velocity] = {Vec3(0, 0, 0.4), Vec3::Zero(), Vec3(0, 0, -0.8)};
  f.contacts.push_back({5, 7, -1, {0, 0, 0}, Vec3(1, 0, 0), -Vec3::UnitX(), Vec3(-2, 0, 0), 0});
  f.contacts.push_back({7, 9, -1, {0, 0, 0}, Vec3(2, 0, 0), -Vec3::UnitX(), Vec3(-1, 0, 0), 0});
  f.contacts.push_back({9, 5, -1, {1, 0, 0}, Vec3(3, 0, 0), -Vec3::UnitX(), Vec3(-4, 0, 0), 0});
  f.contacts.push_back({5, -1, 0, {0, 0, 0}, Vec3(0.5, 0, -0.5), Vec3::UnitZ(), Vec3(0, 0, 0.1), 0});
  return f;
}

View chainView() {
  View view = flatView(2);
  view.camera.position.x() = view.camera.target.x() = 1.5;
  view.grains = view.box = false;
  view.forceChains.shown = true;
  view.forceChains.width = 0.4;
  return view;
}

/// How many pixels of a column are not white.
int inked(const Image& image, int x) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    count += at(image, x, y)[0] + at(image, x, y)[1] + at(image, x, y)[2] < 700;
  return count;
}

} // namespace

TEST_CASE("tubes run from centre to centre, through periodic faces too, and to walls") {
  std::vector<Solid> solids;
  const Frame frame = row();
  const auto legend = addForceChains(solids, frame, chainView());
  REQUIRE(solids.size() == 4);
  const Vec3 middles[] = {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(0.5, 0, -0.25)};
  const double forces[] = {2, 1, 4, 0.1}, lengths[] = {1, 1, 1, 0.5};
  for (int k = 0; k < 4; ++k) {
    const Solid& s = solids[static_cast<std::size_t>(k)];
    CHECK((s.position - middles[k]).norm() < 1e-12);
    CHECK(s.shape.semiAxes.z() == Approx(lengths[k] / 2));
    CHECK(s.shape.semiAxes.x() == Approx(0.2 * std::max(forces[k] / 4, 0.03)));
    CHECK(s.colour == ColourMap("inferno").at(forces[k] / 4));
    CHECK((s.turn * Vec3::UnitZ()).cross(k < 3 ? Vec3::UnitX() : Vec3::UnitZ()).norm() < 1e-12);
  }
  REQUIRE(legend);
  CHECK(legend->high == 4);
  CHECK(legend->unit == "N");
}

TEST_CASE(
    "weak contacts are left out, a fixed highest force caps thickness, clips cut by the contact point") {
  const Frame frame = row();
  const auto count = [&](const View& view) {
    std::vector<Solid> solids;
    addForceChains(solids, frame, view);
    return solids.size();
  };
  View view = chainView();
  view.forceChains.minimum = 0.8; // of the mean, 7.1 / 4 N
  CHECK(count(view) == 2);
  view = chainView();
  view.clips = {{Vec3(1.5, 0, 0), Vec3::UnitX()}};
  CHECK(count(view) == 2);
  view = chainView();
  view.periodicImages = {1, 0, 0};
  CHECK(count(view) == 12);
  view = chainView();
  view.forceChains.highest = 1;
  std::vector<Solid> solids;
  addForceChains(solids, frame, view);
  for (int k = 0; k < 3; ++k)
    CHECK(solids[static_cast<std::size_t>(k)].shape.semiAxes.x() == Approx(0.2));
  view.forceChains.shown = false;
  CHECK(count(view) == 0);
}

TEST_CASE("a drawn tube is as thick as its force") {
  Renderer renderer;
  const Image image = renderer.draw(row(), chainView());
  // 180 pixels for a metre; x = 1 is 90 pixels left of the middle. Thickness 0.4 m at 4 N.
  CHECK(inked(image, 320 - 90) == Approx(36).margin(1));  // 2 N
  CHECK(inked(image, 320 + 90) == Approx(18).margin(1));  // 1 N
  CHECK(inked(image, 320 + 250) == Approx(72).margin(1)); // 4 N, x = 2.89
}

TEST_CASE("arrows point along the vector, the longest four radii long or as long as the scale says") {
  const Frame frame = row();
  View view = flatView(2);
  view.arrows.vector = "velocity";
  const auto top = [](const std::vector<Solid>& solids) { // tips are every second solid
    std::vector<Vec3> tips;
    for (std::size_t k = 1; k < solids.size(); k += 2)
      tips.push_back(solids[k].position + solids[k].turn * Vec3(0, 0, solids[k].shape.semiAxes.z()));
    return tips;
  };
  std::vector<Solid> solids;
  addArrows(solids, frame, view, nullptr);
  REQUIRE(solids.size() == 4); // the middle grain is at rest
  CHECK((top(solids)[0] - Vec3(0.5, 0, 1)).norm() < 1e-9);
  CHECK((top(solids)[1] - Vec3(2.5, 0, -2)).norm() < 1e-9);
  view.arrows.scale = 0.5;
  solids.clear();
  addArrows(solids, frame, view, nullptr);
  CHECK((top(solids)[1] - Vec3(2.5, 0, -0.4)).norm() < 1e-9);
  view.arrows.maximum = 1;
  solids.clear();
  addArrows(solids, frame, view, nullptr);
  CHECK(solids.size() == 2);
  view.arrows.vector = "torque";
  CHECK_THROWS_WITH(addArrows(solids, frame, view, nullptr), Catch::Contains("no vector 'torque'"));
}

TEST_CASE("a track ends at the picture's time, goes back as far as asked, and breaks at periodic jumps") {
  History history;
  Frame frame = row();
  for (int k = 0; k < 6; ++k) {
    frame.time = k;
    frame.position[0].x() =
        k < 4 ? 0.5 - 0.1 * k : 2.9 - 0.1 * (k - 4); // leaves on the left, 3 m further right
    history.addTracks(frame, {5});
  }
  View view = flatView(2);
  view.tracks.grains = {5};
  const auto tubes = [&](double time, double duration) {
    std::vector<Solid> solids;
    frame.time = time;
    view.tracks.duration = duration;
    addTracks(solids, frame, view, &history);
    int count = 0;
    for (const Solid& s : solids)
      count += s.shape.e1 < 1; // the others are balls at bends
    return count;
  };
  CHECK(tubes(0, 0) == 0);
  CHECK(tubes(2, 0) == 2);
  CHECK(tubes(5, 0) == 4); // 0-1-2-3, a break, 4-5
  CHECK(tubes(3, 1.5) == 1);
}
