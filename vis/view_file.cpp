// Views as TOML. Lengths are metres or texts such as "2 cm", angles are degrees.

#include "sim/base/error.h"
#include "vis/camera.h"
#include "vis/toml_fields.h"
#include "vis/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace sandglass::vis {

namespace {

const std::vector<std::string> rangeNames{"frame", "run", "fixed"}; // in the order of ColourRange

void readCamera(TomlFields& fields, Camera& camera) {
  std::vector<std::string> presets = cameraPresets();
  presets.emplace_back(); // "" means the numbers
  fields.choice("preset", camera.preset, presets);
  fields.point("position", camera.position);
  fields.point("target", camera.target);
  fields.vector("up", camera.up);
  fields.number("view_angle", camera.viewAngle, 0.01, 170);
  fields.boolean("orthographic", camera.orthographic);
  fields.length("orthographic_height", camera.orthographicHeight);
  if (camera.preset.empty() && (camera.position - camera.target).norm() == 0)
    fields.fault("position", "equals the target; the camera needs a distance");
  if (camera.up.norm() == 0) fields.fault("up", "is the zero vector; give a direction");
}

void readColouring(TomlFields& fields, Colouring& colouring) {
  fields.text("quantity", colouring.quantity);
  fields.choice("map", colouring.map, colourMaps());
  std::string range = rangeNames[static_cast<std::size_t>(colouring.range)];
  fields.choice("range", range, rangeNames);
  const auto at = std::find(rangeNames.begin(), rangeNames.end(), range);
  if (at != rangeNames.end()) colouring.range = static_cast<ColourRange>(at - rangeNames.begin());
  fields.number("low", colouring.low);
  fields.number("high", colouring.high);
  fields.colour("plain", colouring.plain);
  if (colouring.range == ColourRange::fixed && !(colouring.high > colouring.low))
    fields.fault("high", fmt::format("is {:g}; it must be above low, {:g}", colouring.high, colouring.low));
}

void readPicture(TomlFields& fields, View& view) {
  fields.text("title", view.title);
  fields.integer("width", view.width, 16, 16384);
  fields.integer("height", view.height, 16, 16384);
  fields.boolean("grains", view.grains);
  fields.boolean("walls", view.walls);
  fields.boolean("removed_walls", view.removedWalls);
  fields.boolean("axes", view.axes);
  fields.boolean("legend", view.legend);
  fields.boolean("time_stamp", view.timeStamp);
  fields.boolean("scale_bar", view.scaleBar);
  fields.number("wall_opacity", view.wallOpacity, 0, 1);
  fields.colour("background", view.background);
  fields.boolean("transparent_background", view.transparentBackground);
  fields.integer("maximum_grains", view.maximumGrains, 0, 2000000000);
}

toml::array array(const auto& v) {
  return toml::array{double(v[0]), double(v[1]), double(v[2])};
}

} // namespace

View parseView(const std::string& toml, const std::string& nameForMessages) {
  std::vector<std::string> faults;
  View view;
  toml::table table;
  try {
    table = toml::parse(toml);
  } catch (const toml::parse_error& e) {
    throw InputError(fmt::format("{}:{}: this is not TOML: {}", nameForMessages, e.source().begin.line,
                                 std::string(e.description())));
  }
  TomlFields top(table, nameForMessages, "", faults);
  readPicture(top, view);
  if (const auto* camera = top.table("camera")) {
    TomlFields fields(*camera, nameForMessages, "camera.", faults);
    readCamera(fields, view.camera);
    fields.refuseOthers();
  }
  if (const auto* colouring = top.table("colouring")) {
    TomlFields fields(*colouring, nameForMessages, "colouring.", faults);
    readColouring(fields, view.colouring);
    fields.refuseOthers();
  }
  for (const auto* clip : top.tables("clip")) {
    ClipPlane plane;
    TomlFields fields(*clip, nameForMessages, "clip.", faults);
    fields.point("point", plane.point);
    fields.vector("normal", plane.normal);
    fields.refuseOthers();
    if (plane.normal.norm() == 0)
      fields.fault("normal", "is the zero vector; give the direction of the side to keep");
    view.clips.push_back(plane);
  }
  top.refuseOthers();
  if (!faults.empty()) throw InputError(std::move(faults));
  return view;
}

View readView(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(fmt::format("{}: the view file cannot be read; check its name", file));
  std::ostringstream text;
  text << in.rdbuf();
  return parseView(text.str(), file);
}

std::string writeView(const View& view) {
  const Camera& c = view.camera;
  const Colouring& q = view.colouring;
  toml::table table{
      {"title", view.title},
      {"width", view.width},
      {"height", view.height},
      {"grains", view.grains},
      {"walls", view.walls},
      {"removed_walls", view.removedWalls},
      {"axes", view.axes},
      {"legend", view.legend},
      {"time_stamp", view.timeStamp},
      {"scale_bar", view.scaleBar},
      {"wall_opacity", view.wallOpacity},
      {"background", array(view.background)},
      {"transparent_background", view.transparentBackground},
      {"maximum_grains", view.maximumGrains},
      {"camera", toml::table{{"preset", c.preset},
                             {"position", array(c.position)},
                             {"target", array(c.target)},
                             {"up", array(c.up)},
                             {"view_angle", c.viewAngle},
                             {"orthographic", c.orthographic},
                             {"orthographic_height", c.orthographicHeight}}},
      {"colouring", toml::table{{"quantity", q.quantity},
                                {"map", q.map},
                                {"range", rangeNames[static_cast<std::size_t>(q.range)]},
                                {"low", q.low},
                                {"high", q.high},
                                {"plain", array(q.plain)}}},
  };
  toml::array clips;
  for (const auto& clip : view.clips)
    clips.push_back(toml::table{{"point", array(clip.point)}, {"normal", array(clip.normal)}});
  if (!clips.empty()) table.insert("clip", std::move(clips));
  std::ostringstream text;
  text << table << "\n";
  return text.str();
}

} // namespace sandglass::vis
