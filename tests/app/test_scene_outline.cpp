// The form of a scene: what it offers, and that it changes one value in the text and nothing else.

#include "app/desktop/chart_curves.h"
#include "app/desktop/scene_outline.h"
#include "sim/base/error.h"
#include "sim/scene/scene.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace sandglass;
using namespace sandglass::desktop;

namespace {

const std::string source = SANDGLASS_SOURCE_DIR;

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

SceneField field(const std::string& text, const std::string& path) {
  for (const auto& table : outlineScene(text))
    for (const auto& f : table.fields)
      if (f.path == path) return f;
  throw std::logic_error("no field " + path);
}

std::string set(const std::string& text, const std::string& path, const std::string& shown) {
  const SceneField f = field(text, path);
  return withValue(text, f, tomlValue(shown, f.spec));
}

} // namespace

TEST_CASE("A form shows values as they are written and changes them alone", "[desktop]") {
  const std::string text = "# a scene\ntitle = \"über\" # é\ngravity = [\"0\", \"-9.81 m/s^2\", \"0\"]\n\n"
                           "[domain] # space\nlower = [0, 0, 0]\nupper = [\"1 m\", \"1 m\", \"1 m\"]\n\n"
                           "[[species]]\nname = \"a\"\nmaterial = \"glass\"\n"
                           "size = { distribution = \"single\", diameter = \"2 mm\" } # beads\n";
  const auto gravity = field(text, "gravity");
  CHECK(shownValue(gravity.text, gravity.spec) == "0, -9.81 m/s^2, 0");
  CHECK(set(text, "gravity", "0, 0, 3 m/s^2") ==
        std::string(text).replace(text.find("[\"0\", \"-9.81 m/s^2\", \"0\"]"), 25, "[0, 0, \"3 m/s^2\"]"));
  CHECK(set(text, "title", "ü") == std::string(text).replace(text.find("über"), 5, "ü"));
  CHECK(set(text, "species.a.size.diameter", "3 mm") ==
        std::string(text).replace(text.find("2 mm"), 4, "3 mm"));
  // A key that is not there yet comes after the last of its table, or between the braces.
  CHECK(set(text, "domain.periodic", "x, z") ==
        std::string(text).insert(text.find("\n[[species"), "periodic = [\"x\", \"z\"]\n"));
  CHECK(set(text, "seed", "7") == std::string(text).insert(text.find("\n[domain"), "seed = 7\n"));
  // Nothing takes it out again.
  CHECK(set(set(text, "seed", "7"), "seed", "") == text);
  CHECK(set(set(text, "domain.periodic", "x"), "domain.periodic", "  ") == text);
  CHECK(set(text, "species.a.size.diameter", "").find("{ distribution = \"single\" }") != std::string::npos);
}

TEST_CASE("Another kind takes the keys of the one before along", "[desktop]") {
  const std::string text =
      "[[species]]\nname = \"a\"\nsize = { distribution = \"single\", diameter = \"2 mm\" }\n";
  const std::string uniform = withKind(text, "species.a.size.distribution", "uniform");
  CHECK(uniform == "[[species]]\nname = \"a\"\nsize = { distribution = \"uniform\" }\n");
  CHECK_NOTHROW(field(uniform, "species.a.size.smallest"));
  CHECK_THROWS(field(uniform, "species.a.size.diameter"));
}

TEST_CASE("Every sample scene can be written again field by field", "[desktop]") {
  for (const auto& entry : std::filesystem::directory_iterator(source + "/sample_runs")) {
    const auto file = entry.path() / "scene.toml";
    if (!std::filesystem::exists(file)) continue;
    INFO(file);
    std::string text = textOf(file);
    const Scene before = parseScene(text, "scene.toml", {}, entry.path().string());
    std::size_t written = 0;
    for (const auto& table : outlineScene(text))
      for (const auto& old : table.fields) {
        if (!old.given || old.text.starts_with("\"\"\"")) continue;
        const SceneField f = field(text, old.path); // places move
        text = withValue(text, f, tomlValue(shownValue(f.text, f.spec), f.spec));
        ++written;
      }
    CHECK(written > 15);
    const Scene after = parseScene(text, "scene.toml", {}, entry.path().string());
    CHECK(sceneHash(after) == sceneHash(before));
  }
}

TEST_CASE("Faults go to their fields, and text that is no TOML tells the line", "[desktop]") {
  const std::string text = textOf(source + "/sample_runs/hopper_glass/scene.toml");
  const std::string bad = set(text, "species.bead.size.diameter", "-2 mm");
  try {
    parseScene(bad, "scene.toml");
    FAIL("a negative diameter was taken");
  } catch (const InputError& e) {
    CHECK(pathOfFault(e.sentences().front(), outlineScene(bad)) == "species.bead.size.diameter");
  }
  CHECK(pathOfFault("scene.toml: there is no [[stage]]; add one", outlineScene(text)) == "");
  CHECK_THROWS_WITH(outlineScene("title = \"x\"\ngravity = [1,\n"), Catch::Contains("line"));
}

TEST_CASE("Curves are cut, made logarithmic and read out exactly", "[desktop]") {
  analysis::Curve curve;
  curve.x = {"time", "s"};
  curve.y = {"energy", "J"};
  curve.series = {{"e", {0, 1, 2, 3}, {1, 10, 100, 1000}, {}}};
  const auto log = logarithmic(curve, false);
  CHECK(log.series[0].y[3] == Approx(3));
  CHECK(log.y.name == "log10 of energy in J");
  const auto logX = logarithmic(curve, true);
  CHECK(logX.series[0].x.size() == 3);     // 0 has no logarithm
  const auto part = cutOut(log, 0.5, 2.5); // a straight line there
  REQUIRE(part.series[0].x.size() == 4);
  CHECK(part.series[0].y.front() == Approx(0.5));
  CHECK(part.series[0].y.back() == Approx(2.5));
  const vis::ChartPlace place{100, 400, 50, 350, 0, 3, 0, 3};
  const auto nearest = nearestPoint(log, place, 205, 248); // (1, 1) lies at pixel (200, 250)
  REQUIRE(nearest);
  CHECK(nearest->x == 1);
  CHECK(nearest->pixelX == Approx(200));
  CHECK(nearest->pixelY == Approx(250));
}
