// Views: what is written is read back; what is wrong is said.

#include "sim/base/error.h"
#include "vis/view.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace sandglass;
using namespace sandglass::vis;

TEST_CASE("a view that is written and read is the same view") {
  View view;
  view.title = "Quotes \" and\nlines, ü";
  view.camera.preset.clear();
  view.camera.position = Vec3(0.1, -1.0 / 3, 1e-17);
  view.camera.viewAngle = 20.5;
  view.colouring = {.quantity = "|spin|",
                    .map = "dune",
                    .reversed = true,
                    .bands = 9,
                    .range = ColourRange::fixed,
                    .low = -1e-3,
                    .high = 2.5};
  view.clipBoxes = {{Vec3(-1, 0, 1e-3), Vec3(0.1, 0.2, 0.3), false}};
  view.clipCylinders = {{Vec3(1, 2, 3), Vec3(0, 1, 1), 0.07, true}};
  view.selection = {"z > 0.05 && speed < 0.1", Selection::Use::highlight, {7, 1000000000001}};
  view.forceChains = {true, 2e-3, 0.5, 1e-2, "grey"};
  view.arrows = {"velocity", 0.02, 77, {0.5, 0.25, 0.125}};
  view.tracks = {{3, 1000000000001}, 0.25};
  view.slice = {true, "mean", "velocity.z", Vec3(1, 2, 3), Vec3(0, 0, 2), "cividis", ColourRange::fixed,
                -1,   3,      0.5,          "velocity"};
  view.periodicImages = {1, 0, 2};
  view.grainScale = 0.3;
  view.wallEdges = view.box = false;
  view.meshes = true;
  view.supersampling = 3;
  view.clips = {{Vec3(0, 0.003, 0), Vec3(0, -1, 0)}, {Vec3(1, 2, 3), Vec3(0.5, 0.5, 0)}};
  view.legend = false;
  view.wallOpacity = 0.3;
  view.background = {0.1, 0.1, 0.12};
  view.width = 641;
  view.maximumGrains = 5000;
  const std::string text = writeView(view);
  const View back = parseView(text, "view.toml");
  CHECK(writeView(back) == text);
  CHECK(back.title == view.title);
  CHECK(back.camera.position == view.camera.position);
  CHECK(back.colouring.low == view.colouring.low);
  CHECK(back.colouring.range == ColourRange::fixed);
  REQUIRE(back.clips.size() == 2);
  CHECK(back.clips[1].normal == view.clips[1].normal);
  CHECK_FALSE(back.legend);
  CHECK(back.width == 641);
  CHECK(back.colouring.bands == 9);
  REQUIRE(back.clipBoxes.size() == 1);
  CHECK(back.clipBoxes[0].upper == Vec3(0.1, 0.2, 0.3));
  CHECK_FALSE(back.clipBoxes[0].inside);
  REQUIRE(back.clipCylinders.size() == 1);
  CHECK(back.clipCylinders[0].radius == 0.07);
  CHECK(back.selection.expression == view.selection.expression);
  CHECK(back.selection.use == Selection::Use::highlight);
  CHECK(back.selection.grains == view.selection.grains);
  CHECK(back.forceChains.highest == 1e-2);
  CHECK(back.arrows.maximum == 77);
  CHECK(back.tracks.grains == view.tracks.grains);
  CHECK(back.slice.quantity == "velocity.z");
  CHECK(back.slice.streamlines == "velocity");
  CHECK(back.periodicImages == view.periodicImages);
  CHECK(back.supersampling == 3);
}

TEST_CASE("lengths of a view may carry units") {
  const View view = parseView(
      "[camera]\npreset = \"\"\ntarget = [\"1 cm\", 0, \"-2.5 mm\"]\northographic_height = \"4 dm\"\n"
      "[[clip]]\npoint = [0, \"3 mm\", 0]",
      "v.toml");
  CHECK((view.camera.target - Vec3(0.01, 0, -0.0025)).norm() < 1e-15);
  CHECK(view.camera.orthographicHeight == Approx(0.4));
  REQUIRE(view.clips.size() == 1);
  CHECK(view.clips[0].point.y() == Approx(0.003));
}

TEST_CASE("an empty view file is the default view") {
  CHECK(writeView(parseView("", "view.toml")) == writeView(View{}));
}

TEST_CASE("each fault of a view is a sentence") {
  struct Fault {
    const char* toml;
    const char* sentence;
  };
  const Fault faults[] = {
      {"widht = 3", "v.toml:1: widht is not a known key; known are: arrows, axes, background"},
      {"\nwidth = 3.5", "v.toml:2: width is 3.5; it must be a whole number from 16 to 16384."},
      {"height = 8", "v.toml:1: height is 8; it must be a whole number from 16 to 16384."},
      {"legend = \"yes\"", "v.toml:1: legend is 'yes'; it must be true or false."},
      {"wall_opacity = 2", "v.toml:1: wall_opacity is 2; it must be a number from 0 to 1."},
      {"background = [1, 2, 3]", "it must be three numbers from 0 to 1, [red, green, blue]."},
      {"[camera]\npreset = \"side\"",
       "v.toml:2: camera.preset is 'side'; it must be one of: \"fit\", \"front\""},
      {"[camera]\nposition = [0, 1]", "v.toml:2: camera.position is [ 0, 1 ]; it must be three lengths, [x, "
                                      "y, z], in metres or such as \"2 cm\"."},
      {"[camera]\npreset = \"\"\nposition = [0, 0, 0]", "v.toml:3: camera.position equals the target"},
      {"[[clip]]\npoint = [0, \"3 kg\", 0]",
       "v.toml:2: clip.point is [ 0, '3 kg', 0 ]; it must be three lengths"},
      {"[camera]\northographic_height = 0",
       "v.toml:2: camera.orthographic_height is 0; it must be a length above 0"},
      {"[camera]\nup = [0, 0, 0]", "v.toml:2: camera.up is the zero vector; give a direction."},
      {"[camera]\nview_angle = nan", "camera.view_angle is nan; it must be a number from 0.01 to 170."},
      {"[colouring]\nmap = \"jet\"", "v.toml:2: colouring.map is 'jet'; it must be one of: \"viridis\""},
      {"[colouring]\nrange = \"fixed\"\nlow = 2\nhigh = 2",
       "v.toml:4: colouring.high is 2; it must be above low, 2."},
      {"[[clip]]\nnormal = [0, 0, 0]", "v.toml:2: clip.normal is the zero vector"},
      {"[[clip_box]]\nlower = [0, 0, 0]\nupper = [1, 0, 1]", "v.toml:3: clip_box.upper lies below lower"},
      {"[[clip_cylinder]]\nradius = -1", "v.toml:2: clip_cylinder.radius is -1; it must be a length above 0"},
      {"[selection]\nuse = \"keep\"",
       "v.toml:2: selection.use is 'keep'; it must be one of: \"only\", \"hide\""},
      {"[arrows]\nscale = -1", "v.toml:2: arrows.scale is -1; it must be a number of at least 0."},
      {"[tracks]\ngrains = [1, 2.5]", "it must be a list of whole numbers, such as [3, 17]."},
      {"periodic_images = [1, 99, 0]", "it must be three whole numbers from 0 to 20, [x, y, z]."},
      {"clip = 3", "v.toml:1: clip is 3; it must be a list of tables, [[clip]]."},
      {"camera = 1", "v.toml:1: camera is 1; it must be a table, [camera]."},
      {"width = ", "v.toml:1: this is not TOML"},
  };
  for (const auto& [toml, sentence] : faults) {
    INFO(toml);
    CHECK_THROWS_WITH(parseView(toml, "v.toml"), Catch::Contains(sentence));
  }
}

TEST_CASE("the view file of the documentation is the default view and a clip plane") {
  std::ifstream in(SANDGLASS_SOURCE_DIR "/docs/pictures.md");
  const std::string page((std::istreambuf_iterator<char>(in)), {});
  const auto begin = page.find("```toml\n"), end = page.find("```\n", begin + 8);
  REQUIRE(end != std::string::npos);
  View view = parseView(page.substr(begin + 8, end - begin - 8), "docs/pictures.md");
  CHECK(view.clips.size() == 1);
  view.clips.clear();
  CHECK(writeView(view) == writeView(View{}));
}

TEST_CASE("all faults of a view come at once") {
  try {
    parseView("widht = 3\nlegend = 1\n[camera]\npreset = \"side\"", "v.toml");
    FAIL("no error");
  } catch (const InputError& e) {
    CHECK(e.sentences().size() == 3);
  }
}

TEST_CASE("a view file that is not there is named") {
  CHECK_THROWS_WITH(readView("no/such.toml"), Catch::Contains("no/such.toml"));
}
