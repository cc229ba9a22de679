// Whole pictures against references in tests/baselines. Planted faults show that the threshold can fail.
// SANDGLASS_NEW_REFERENCES=1 writes the references anew: look at them before committing.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_fields.h"
#include "tests/vis/sample_frames.h"
#include "vis/chart.h"
#include "vis/difference_picture.h"
#include "vis/history.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;
namespace fs = std::filesystem;

namespace {

// Two Mesa versions or processors may round a few edge pixels differently; one per mille is 230 pixels.
constexpr double threshold = 0.001;

double fromReference(const Image& image, const std::string& name) {
  const fs::path file = fs::path(SANDGLASS_SOURCE_DIR) / "tests" / "baselines" / (name + ".png");
  if (std::getenv("SANDGLASS_NEW_REFERENCES")) writePng(image, file, {});
  const Image reference = readPng(file);
  const double share = difference(image, reference);
  if (share > threshold) {
    const fs::path seen = fs::path(SANDGLASS_BINARY_DIR) / "pictures";
    fs::create_directories(seen);
    writePng(image, seen / (name + ".png"), {});
    writePng(differencePicture(image, reference), seen / (name + "_difference.png"), {});
  }
  return share;
}

View small() {
  View view;
  view.width = 640;
  view.height = 360;
  return view;
}

View hopperView() {
  View view = small();
  view.title = "Slot hopper";
  return view;
}

Frame sparseHopper() {
  return hopper(3.2e-3);
}

/// The six shapes of a table, turned so that their faces are seen.
Frame shapeTable() {
  Frame f;
  f.shapes = {{Vec3(1.0, 0.6, 0.4), 1, 1},    {Vec3(0.9, 0.7, 0.5), 0.2, 0.2},
              {Vec3(0.6, 0.6, 1.0), 0.15, 1}, {Vec3(0.8, 0.8, 0.5), 1, 0.3},
              {Vec3(1, 0.8, 0.9), 2, 2},      {Vec3(0.9, 0.5, 0.7), 1.6, 0.5}};
  RandomStream random(21, RandomPurpose::test, 0);
  for (int k = 0; k < 24; ++k) {
    f.id.push_back(k);
    f.position.emplace_back(2.1 * (k % 6), 0, 2.1 * (k / 6));
    f.orientation.push_back(
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized());
    f.scalars[quantity::shape].push_back(k % 6);
  }
  return f;
}

View shapesView() {
  View view = small();
  view.colouring = {.quantity = "shape", .map = "discrete"};
  view.camera.preset = "front";
  view.box = false;
  return view;
}

View clippedView() {
  View view = small();
  view.camera.preset = "iso";
  view.wallOpacity = 0.5;
  view.colouring.quantity = "species";
  view.clipBoxes = {{Vec3(-1, -1, 0.005), Vec3(0.03, 1, 0.07), true}};
  view.clipCylinders = {{Vec3(0, 0, 0.04), Vec3::UnitY(), 0.015, false}};
  return view;
}

/// A cube of touching grains, forces growing downwards.
Frame pressedBlock() {
  constexpr int side = 7;
  constexpr double spacing = 1e-2;
  Frame f = cube(side, spacing, spacing / 2);
  RandomStream random(5, RandomPurpose::test, 0);
  for (std::int64_t a = 0; a < side * side * side; ++a) {
    const std::array<std::int64_t, 3> place{a / (side * side), a / side % side, a % side}; // x, y, z
    const std::array<std::int64_t, 3> stride{side * side, side, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      if (place[k] + 1 == side) continue;
      const Vec3 normal = -Vec3::Unit(static_cast<Eigen::Index>(k));
      const double force =
          1e-3 * static_cast<double>(side - place[2]) * std::pow(random.uniform(), 4.0) * (k == 2 ? 2 : 1);
      f.contacts.push_back({a,
                            a + stride[k],
                            -1,
                            {0, 0, 0},
                            f.position[static_cast<std::size_t>(a)] - spacing / 2 * normal,
                            normal,
                            force * normal,
                            0});
    }
  }
  return f;
}

View chainsView() {
  View view = small();
  view.colouring.quantity = "";
  view.grainScale = 0.3;
  view.forceChains = {.shown = true, .width = 8e-3, .minimum = 0.1};
  view.arrows.vector = "velocity";
  view.arrows.maximum = 40;
  view.arrows.colour = {0.1, 0.3, 0.7};
  view.tracks.grains = {3};
  return view;
}

/// Grain 3 comes in a spiral.
std::shared_ptr<const History> wander(Frame frame) {
  auto history = std::make_shared<History>();
  const Vec3 end = frame.position[3];
  for (int k = 0; k <= 40; ++k) {
    frame.time = 0.01 * (k - 40);
    const double r = 1e-3 * (40 - k);
    frame.position[3] = end + Vec3(-r, r * std::cos(0.4 * k), r * std::sin(0.4 * k));
    history->addTracks(frame, {3});
  }
  return history;
}

View fieldView() {
  View view = small();
  view.slice.shown = true;
  view.slice.quantity = "velocity";
  view.slice.streamlines = "velocity";
  view.camera.preset = "front";
  return view;
}

} // namespace

TEST_CASE("picture: a slice of a hopper from the front") {
  const Frame frame = sparseHopper();
  REQUIRE(frame.size() < 2000);
  CHECK(fromReference(Renderer().draw(frame, hopperView()), "hopper_front") <= threshold);
}

TEST_CASE("picture: a clipped cube at three quarters, diverging map, fixed range") {
  View view = small();
  view.colouring = {
      .quantity = "velocity.x", .map = "coolwarm", .range = ColourRange::fixed, .low = 0, .high = 8};
  view.clips = {{Vec3::Constant(0.045), Vec3(1, 1, -1).normalized()}};
  CHECK(fromReference(Renderer().draw(cube(9), view), "cube_clipped") <= threshold);
}

TEST_CASE("picture: species on dark ground, without perspective, from the top") {
  View view = small();
  view.colouring.quantity = "species";
  view.camera.preset = "top";
  view.camera.orthographic = true;
  view.background = {0.10, 0.11, 0.13};
  CHECK(fromReference(Renderer().draw(sparseHopper(), view), "species_top_dark") <= threshold);
}

TEST_CASE("picture: superellipsoids of six shapes") {
  CHECK(fromReference(Renderer().draw(shapeTable(), shapesView()), "superellipsoids") <= threshold);
}

TEST_CASE("picture: walls with edges, cut by a box and a cylinder together with the grains") {
  CHECK(fromReference(Renderer().draw(sparseHopper(), clippedView()), "hopper_cut") <= threshold);
}

TEST_CASE("picture: force chains, arrows and a track") {
  Renderer renderer;
  const Frame frame = pressedBlock();
  renderer.setHistory(wander(frame));
  CHECK(fromReference(renderer.draw(frame, chainsView()), "force_chains") <= threshold);
}

TEST_CASE("picture: a slice of a field with streamlines") {
  Frame frame;
  frame.fields = {swirl(25, 1)};
  CHECK(fromReference(Renderer().draw(frame, fieldView()), "field_slice") <= threshold);
}

TEST_CASE("picture: legends of the three range modes, of bands and of classes") {
  Renderer renderer;
  // One frame; its speeds lie between 0 and 0.59 m/s, the run's between 0 and 1.2, the fixed range is 0.1 to
  // 0.3: the grains and the numbers at the bar differ.
  View view = hopperView();
  view.colouring.range = ColourRange::frame;
  CHECK(fromReference(renderer.draw(sparseHopper(), view), "legend_frame") <= threshold);
  view.colouring.range = ColourRange::run;
  view.colouring.low = 0;
  view.colouring.high = 1.2;
  CHECK(fromReference(renderer.draw(sparseHopper(), view), "legend_run") <= threshold);
  view.colouring.range = ColourRange::fixed;
  view.colouring.low = 0.1;
  view.colouring.high = 0.3;
  CHECK(fromReference(renderer.draw(sparseHopper(), view), "legend_fixed") <= threshold);
  view = hopperView();
  view.colouring.quantity = "z";
  view.colouring.bands = 6;
  view.colouring.map = "viridis";
  CHECK(fromReference(renderer.draw(sparseHopper(), view), "legend_bands") <= threshold);
  view = hopperView();
  view.colouring.quantity = "layer";
  view.colouring.map = "discrete";
  Frame frame = sparseHopper();
  for (const Vec3& p : frame.position)
    frame.scalars["layer"].push_back(std::floor(p.z() / 0.02));
  CHECK(fromReference(renderer.draw(frame, view), "legend_classes") <= threshold);
}

TEST_CASE("picture: a chart with error bars, a band and marks") {
  analysis::Curve curve;
  curve.title = "Two estimates";
  curve.definition = "Seventeen measured points with standard errors, and a model with its band.";
  curve.x = {"time", "s"};
  curve.y = {"energy", "J"};
  analysis::Series points{"measured", {}, {}, {}}, model{"model", {}, {}, {}};
  for (int i = 0; i < 17; ++i) {
    points.x.push_back(0.1 * i);
    points.y.push_back(2e-6 * std::exp(-0.2 * i));
    points.error.push_back(1e-7);
  }
  for (int i = 0; i < 161; ++i) {
    model.x.push_back(0.01 * i);
    model.y.push_back(2.1e-6 * std::exp(-0.021 * i));
    model.error.push_back(6e-8);
  }
  curve.series = {points, model};
  curve.marks = {{"half life", 0.33, true}, {"start", 2e-6, false}};
  CHECK(fromReference(Renderer().draw(curve, 640, 400), "chart") <= threshold);
}

namespace {

struct Fault {
  const char* what;
  Frame frame;
  View view;
};

void checkFaults(const std::string& reference, const std::vector<Fault>& faults,
                 const std::shared_ptr<const History>& history = nullptr) {
  Renderer renderer;
  const Image right = readPng(fs::path(SANDGLASS_SOURCE_DIR) / "tests" / "baselines" / (reference + ".png"));
  renderer.setHistory(history);
  for (const auto& [what, frame, view] : faults) {
    INFO(reference << ": " << what);
    CHECK(difference(renderer.draw(frame, view), right) > 3 * threshold);
  }
}

/// The view with something else about it.
template <class Change> View with(View view, Change change) {
  change(view);
  return view;
}
template <class Change> Frame with(Frame frame, Change change) {
  change(frame);
  return frame;
}

} // namespace

TEST_CASE("planted faults in a hopper are seen") {
  const Frame right = sparseHopper();
  const auto larger = [](Frame& f) {
    for (double& r : f.scalars[quantity::radius])
      r *= 1.05;
  };
  const auto open = [](Frame& f) { f.walls.clear(); };
  checkFaults("hopper_front",
              {{"radii 5 % larger", with(right, larger), hopperView()},
               {"a missing wall", with(right, open), hopperView()},
               {"another map", right, with(hopperView(), [](View& v) { v.colouring.map = "viridis"; })},
               {"no edges", right, with(hopperView(), [](View& v) { v.wallEdges = false; })},
               {"no legend", right, with(hopperView(), [](View& v) { v.legend = false; })},
               {"another angle", right, with(hopperView(), [](View& v) { v.camera.viewAngle = 29; })}});
  checkFaults("hopper_cut",
              {{"radii 5 % larger", with(right, larger), clippedView()},
               {"a missing wall", with(right, open), clippedView()},
               {"no cylinder", right, with(clippedView(), [](View& v) { v.clipCylinders.clear(); })},
               {"a box 5 % larger", right,
                with(clippedView(), [](View& v) { v.clipBoxes[0].upper.z() += 0.0035; })}});
}

TEST_CASE("planted faults in shapes, chains and slices are seen") {
  const Frame shapes = shapeTable();
  checkFaults(
      "superellipsoids",
      {{"axes 5 % larger",
        with(shapes,
             [](Frame& f) {
               for (GrainShape& s : f.shapes)
                 s.semiAxes *= 1.05;
             }),
        shapesView()},
       {"rounder", with(shapes, [](Frame& f) { f.shapes[1].e1 = f.shapes[1].e2 = 0.4; }), shapesView()},
       {"not turned", with(shapes, [](Frame& f) { f.orientation.clear(); }), shapesView()}});
  const Frame block = pressedBlock();
  checkFaults("force_chains",
              {{"no chains", block, with(chainsView(), [](View& v) { v.forceChains.shown = false; })},
               {"thicker", block, with(chainsView(), [](View& v) { v.forceChains.width *= 1.25; })},
               {"no arrows", block, with(chainsView(), [](View& v) { v.arrows.vector = ""; })},
               {"no track", block, with(chainsView(), [](View& v) { v.tracks.grains = {}; })},
               {"another map", block, with(chainsView(), [](View& v) { v.forceChains.map = "viridis"; })}},
              wander(block));
  Frame field;
  field.fields = {swirl(25, 1)};
  checkFaults("field_slice",
              {{"another array", field, with(fieldView(), [](View& v) { v.slice.quantity = "ramp"; })},
               {"no lines", field, with(fieldView(), [](View& v) { v.slice.streamlines = ""; })},
               {"another map", field, with(fieldView(), [](View& v) { v.slice.map = "cividis"; })}});
  const Frame hopper = sparseHopper();
  checkFaults("legend_fixed", {{"range of the frame", hopper, hopperView()}});
  checkFaults("legend_run", {{"range of the frame", hopper, hopperView()}});
}

TEST_CASE("OSMesa and EGL draw the same chart") {
  analysis::Curve curve;
  curve.x = {"x", "m"};
  curve.y = {"y", ""};
  curve.series = {{"line", {0, 1, 2, 3}, {1, 3, 2, std::nan("")}, {}}, {"nothing", {}, {}, {}}};
  const Image a = Renderer(GlBackend::osmesa).draw(curve, 400, 300),
              b = Renderer(GlBackend::egl).draw(curve, 400, 300);
  CHECK(a.rgba == b.rgba);
  int blue = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4)
    blue += a.rgba[i] < 60 && a.rgba[i + 2] > 150;
  CHECK(blue > 200); // the line is there
}
