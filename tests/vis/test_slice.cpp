// Slices of fields show their arrays where they are.

#include "sim/base/error.h"
#include "tests/vis/pixels.h"
#include "tests/vis/sample_fields.h"
#include "vis/colour_map.h"
#include "vis/readers/vti_field.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

View sliceView() {
  View view = flatView(2);
  view.box = false;
  view.slice.shown = true;
  view.slice.quantity = "ramp";
  view.slice.map = "viridis";
  view.slice.range = ColourRange::fixed;
  view.slice.low = -1;
  view.slice.high = 1;
  return view;
}

} // namespace

TEST_CASE("a slice has the colours of its array, flat fields and cuts through deep ones alike") {
  Renderer renderer;
  const ColourMap map("viridis");
  for (const int depth : {1, 5}) {
    Frame frame;
    frame.fields = {swirl(41, depth)};
    const Image image = renderer.draw(frame, sliceView());
    for (const int x : {200, 260, 320, 390, 450}) // 180 pixels for a metre; ramp = x
      for (const int y : {60, 180, 300}) {
        const Rgb c = map.at(((x + 0.5 - 320) / 180 + 1) / 2);
        CHECK(distance(at(image, x, y), {c[0], c[1], c[2]}) <= 3); // a 256th of the map
      }
    CHECK(at(image, 100, 180) == std::array<int, 3>{255, 255, 255}); // beyond x = -1
  }
}

TEST_CASE("a slice is empty where its array is no number, and clipped like everything") {
  Renderer renderer;
  Frame frame;
  frame.fields = {swirl(41, 1)};
  for (std::size_t k = 0; k < frame.fields[0].size(); ++k)
    if (static_cast<int>(k) % 41 > 30) frame.fields[0].scalars["ramp"][k] = std::nan(""); // x > 0.5
  View view = sliceView();
  view.clips = {{Vec3::Zero(), Vec3::UnitZ()}};
  const Image image = renderer.draw(frame, view);
  CHECK(at(image, 320 + 120, 90)[0] == 255); // x = 0.67
  CHECK(at(image, 320 + 80, 90)[1] < 255);   // x = 0.44
  CHECK(at(image, 320 + 80, 270)[0] == 255); // below z = 0
}

TEST_CASE("streamlines of a solid-body rotation are circles") {
  Renderer renderer;
  Frame frame;
  frame.fields = {swirl(41, 1)};
  View view = sliceView();
  view.slice.opacity = 0;
  view.slice.streamlines = "velocity";
  const Image image = renderer.draw(frame, view);
  // From a dark pixel one finds dark pixels all the way round at the same distance from the middle.
  int starts = 0, followed = 0;
  for (int r = 30; r < 110; ++r) { // lines further out leave the field or are not long enough to close
    if (at(image, 320 + r, 180)[0] > 100) continue;
    ++starts;
    bool everywhere = true;
    for (int k = 1; k < 5; ++k) { // a third of the field's extent to both sides: 0.94 m
      const double angle = 0.15 * k;
      bool any = false;
      for (int d = -2; d <= 2; ++d)
        any = any || at(image, static_cast<int>(320.5 + (r + d) * std::cos(angle)),
                        static_cast<int>(180.5 - (r + d) * std::sin(angle)))[0] < 160;
      everywhere = everywhere && any;
    }
    followed += everywhere;
  }
  CHECK(starts > 5);
  CHECK(followed >= starts * 9 / 10);
}

TEST_CASE("a field comes back from its VTI file with arrays, places and units") {
  analysis::Field field;
  field.name = "mean";
  field.origin = Vec3(1, 2, 3);
  field.spacing = Vec3(0.5, 0.25, 2);
  field.count = {3, 2, 2};
  for (int k = 0; k < 12; ++k) {
    field.scalars["density"].push_back(k == 5 ? std::nan("") : 0.1 * k);
    field.vectors["velocity"].emplace_back(k, -k, 0.5 * k);
  }
  field.units = {{"density", "kg/m^3"}, {"velocity", "m/s"}};
  std::string name = (std::filesystem::temp_directory_path() / "sandglass-vti-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(name.data());
  std::ofstream(folder / "mean.vti") << analysis::toVti(field);
  const FrameField back = readVtiField(folder / "mean.vti");
  CHECK(back.name == "mean");
  CHECK(back.points == field.count);
  CHECK((back.origin - field.origin).norm() < 1e-15);
  CHECK((back.spacing - field.spacing).norm() < 1e-15);
  CHECK(back.units == field.units);
  CHECK(back.vectors.at("velocity") == field.vectors.at("velocity"));
  CHECK(std::isnan(back.scalars.at("density")[5]));
  CHECK(back.scalars.at("density")[7] == field.scalars.at("density")[7]);
  CHECK(frameField(field).units == field.units);
  std::ofstream(folder / "bad.vti") << "<VTKFile type=\"PolyData\"></VTKFile>";
  CHECK_THROWS_WITH(readVtiField(folder / "bad.vti"), Catch::Contains("bad.vti"));
  CHECK_THROWS_WITH(readVtiField(folder / "none.vti"), Catch::Contains("cannot be opened"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("what a slice asks for and the frame does not have is named") {
  Renderer renderer;
  Frame frame;
  View view = sliceView();
  CHECK_THROWS_WITH(renderer.draw(frame, view), Catch::Contains("holds no field to slice"));
  frame.fields = {swirl(5, 1)};
  view.slice.field = "other";
  CHECK_THROWS_WITH(renderer.draw(frame, view), Catch::Contains("no field 'other'; it has: swirl"));
  view.slice.field = "";
  view.slice.quantity = "density";
  CHECK_THROWS_WITH(renderer.draw(frame, view), Catch::Contains("no array 'density'"));
  view.slice.quantity = "velocity.x";
  view.slice.streamlines = "force";
  CHECK_THROWS_WITH(renderer.draw(frame, view), Catch::Contains("no vector 'force'; it has: velocity"));
}
