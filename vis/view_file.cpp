// Views as TOML. Lengths are metres or texts such as "2 cm", angles are degrees.

#include "sim/base/error.h"
#include "vis/camera.h"
#include "vis/toml_fields.h"
#include "vis/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace sandglass::vis {

namespace {

const std::vector<std::string> rangeNames{"frame", "run", "fixed"}; // in the order of ColourRange

const std::vector<std::string> useNames{"only", "hide", "highlight"}; // in the order of Selection::Use
constexpr double most = std::numeric_limits<double>::max();

/// An enumerator by the place of its name in `names`.
template <class Enum>
void readChoice(TomlFields& fields, const std::string& key, Enum& value,
                const std::vector<std::string>& names) {
  std::string name = names[static_cast<std::size_t>(value)];
  fields.choice(key, name, names);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) value = static_cast<Enum>(at - names.begin());
}

void readRange(TomlFields& fields, ColourRange& range, double& low, double& high) {
  readChoice(fields, "range", range, rangeNames);
  fields.number("low", low);
  fields.number("high", high);
  if (range == ColourRange::fixed && !(high > low))
    fields.fault("high", fmt::format("is {:g}; it must be above low, {:g}", high, low));
}

void refuseZero(TomlFields& fields, const std::string& key, const Vec3& direction, const char* what) {
  if (direction.norm() == 0) fields.fault(key, fmt::format("is the zero vector; give {}", what));
}

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
  refuseZero(fields, "up", camera.up, "a direction");
}

void readColouring(TomlFields& fields, Colouring& colouring) {
  fields.text("quantity", colouring.quantity);
  fields.choice("map", colouring.map, colourMaps());
  fields.boolean("reversed", colouring.reversed);
  fields.integer("bands", colouring.bands, 0, 64);
  readRange(fields, colouring.range, colouring.low, colouring.high);
  fields.colour("plain", colouring.plain);
}

void readClip(TomlFields& fields, ClipPlane& plane) {
  fields.point("point", plane.point);
  fields.vector("normal", plane.normal);
  refuseZero(fields, "normal", plane.normal, "the direction of the side to keep");
}

void readClip(TomlFields& fields, ClipBox& box) {
  fields.point("lower", box.lower);
  fields.point("upper", box.upper);
  fields.boolean("inside", box.inside);
  if (!(box.upper.array() > box.lower.array()).all())
    fields.fault("upper", "lies below lower along some axis; every coordinate must be above that of lower");
}

void readClip(TomlFields& fields, ClipCylinder& cylinder) {
  fields.point("point", cylinder.point);
  fields.vector("axis", cylinder.axis);
  fields.length("radius", cylinder.radius);
  fields.boolean("inside", cylinder.inside);
  refuseZero(fields, "axis", cylinder.axis, "the direction of the axis");
}

void readSelection(TomlFields& fields, Selection& selection) {
  fields.text("expression", selection.expression);
  readChoice(fields, "use", selection.use, useNames);
  fields.wholeNumbers("grains", selection.grains);
}

void readForceChains(TomlFields& fields, ForceChains& chains) {
  fields.boolean("shown", chains.shown);
  fields.number("width", chains.width, 0, most);
  fields.number("minimum", chains.minimum, 0, most);
  fields.number("highest", chains.highest, 0, most);
  fields.choice("map", chains.map, colourMaps());
}

void readArrows(TomlFields& fields, Arrows& arrows) {
  fields.text("vector", arrows.vector);
  fields.number("scale", arrows.scale, 0, most);
  fields.integer("maximum", arrows.maximum, 1, 2000000000);
  fields.colour("colour", arrows.colour);
}

void readTracks(TomlFields& fields, Tracks& tracks) {
  fields.wholeNumbers("grains", tracks.grains);
  fields.number("duration", tracks.duration, 0, most);
}

void readSlice(TomlFields& fields, FieldSlice& slice) {
  fields.boolean("shown", slice.shown);
  fields.text("field", slice.field);
  fields.text("quantity", slice.quantity);
  fields.point("point", slice.point);
  fields.vector("normal", slice.normal);
  refuseZero(fields, "normal", slice.normal, "the direction across the slice");
  fields.choice("map", slice.map, colourMaps());
  readRange(fields, slice.range, slice.low, slice.high);
  fields.number("opacity", slice.opacity, 0, 1);
  fields.text("streamlines", slice.streamlines);
}

void readPicture(TomlFields& fields, View& view) {
  fields.text("title", view.title);
  fields.integer("width", view.width, 16, 16384);
  fields.integer("height", view.height, 16, 16384);
  fields.integer("supersampling", view.supersampling, 1, 4);
  fields.boolean("grains", view.grains);
  fields.boolean("walls", view.walls);
  fields.boolean("removed_walls", view.removedWalls);
  fields.boolean("axes", view.axes);
  fields.boolean("legend", view.legend);
  fields.boolean("time_stamp", view.timeStamp);
  fields.boolean("scale_bar", view.scaleBar);
  fields.boolean("wall_edges", view.wallEdges);
  fields.boolean("box", view.box);
  fields.number("wall_opacity", view.wallOpacity, 0, 1);
  fields.number("grain_scale", view.grainScale, 0.01, 100);
  fields.counts("periodic_images", view.periodicImages, 0, 20);
  fields.boolean("meshes", view.meshes);
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
  const auto section = [&](const char* name, auto read, auto& value) {
    const auto* inner = top.table(name);
    if (!inner) return;
    TomlFields fields(*inner, nameForMessages, fmt::format("{}.", name), faults);
    read(fields, value);
    fields.refuseOthers();
  };
  section("camera", readCamera, view.camera);
  section("colouring", readColouring, view.colouring);
  section("selection", readSelection, view.selection);
  section("force_chains", readForceChains, view.forceChains);
  section("arrows", readArrows, view.arrows);
  section("tracks", readTracks, view.tracks);
  section("slice", readSlice, view.slice);
  const auto list = [&](const char* name, auto& values) {
    for (const auto* entry : top.tables(name)) {
      TomlFields fields(*entry, nameForMessages, fmt::format("{}.", name), faults);
      readClip(fields, values.emplace_back());
      fields.refuseOthers();
    }
  };
  list("clip", view.clips);
  list("clip_box", view.clipBoxes);
  list("clip_cylinder", view.clipCylinders);
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
  const ForceChains& f = view.forceChains;
  const Arrows& a = view.arrows;
  const FieldSlice& s = view.slice;
  toml::array tracked, chosen;
  for (const std::int64_t id : view.tracks.grains)
    tracked.push_back(id);
  for (const std::int64_t id : view.selection.grains)
    chosen.push_back(id);
  toml::table table{
      {"title", view.title},
      {"width", view.width},
      {"height", view.height},
      {"supersampling", view.supersampling},
      {"grains", view.grains},
      {"walls", view.walls},
      {"removed_walls", view.removedWalls},
      {"axes", view.axes},
      {"legend", view.legend},
      {"time_stamp", view.timeStamp},
      {"scale_bar", view.scaleBar},
      {"wall_edges", view.wallEdges},
      {"box", view.box},
      {"wall_opacity", view.wallOpacity},
      {"grain_scale", view.grainScale},
      {"periodic_images",
       toml::array{view.periodicImages[0], view.periodicImages[1], view.periodicImages[2]}},
      {"meshes", view.meshes},
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
                                {"reversed", q.reversed},
                                {"bands", q.bands},
                                {"range", rangeNames[static_cast<std::size_t>(q.range)]},
                                {"low", q.low},
                                {"high", q.high},
                                {"plain", array(q.plain)}}},
      {"selection", toml::table{{"expression", view.selection.expression},
                                {"use", useNames[static_cast<std::size_t>(view.selection.use)]},
                                {"grains", std::move(chosen)}}},
      {"force_chains", toml::table{{"shown", f.shown},
                                   {"width", f.width},
                                   {"minimum", f.minimum},
                                   {"highest", f.highest},
                                   {"map", f.map}}},
      {"arrows",
       toml::table{
           {"vector", a.vector}, {"scale", a.scale}, {"maximum", a.maximum}, {"colour", array(a.colour)}}},
      {"tracks", toml::table{{"grains", std::move(tracked)}, {"duration", view.tracks.duration}}},
      {"slice", toml::table{{"shown", s.shown},
                            {"field", s.field},
                            {"quantity", s.quantity},
                            {"point", array(s.point)},
                            {"normal", array(s.normal)},
                            {"map", s.map},
                            {"range", rangeNames[static_cast<std::size_t>(s.range)]},
                            {"low", s.low},
                            {"high", s.high},
                            {"opacity", s.opacity},
                            {"streamlines", s.streamlines}}},
  };
  const auto put = [&](const char* name, toml::array list) {
    if (!list.empty()) table.insert(name, std::move(list));
  };
  toml::array planes, boxes, cylinders;
  for (const auto& clip : view.clips)
    planes.push_back(toml::table{{"point", array(clip.point)}, {"normal", array(clip.normal)}});
  for (const auto& clip : view.clipBoxes)
    boxes.push_back(
        toml::table{{"lower", array(clip.lower)}, {"upper", array(clip.upper)}, {"inside", clip.inside}});
  for (const auto& clip : view.clipCylinders)
    cylinders.push_back(toml::table{{"point", array(clip.point)},
                                    {"axis", array(clip.axis)},
                                    {"radius", clip.radius},
                                    {"inside", clip.inside}});
  put("clip", std::move(planes));
  put("clip_box", std::move(boxes));
  put("clip_cylinder", std::move(cylinders));
  std::ostringstream text;
  text << table << "\n";
  return text.str();
}

} // namespace sandglass::vis
