#include "app/cli/sweep_plot.h"

#include "analysis/sweep/phase_diagram.h"
#include "sim/base/error.h"
#include "sim/base/version.h"
#include "sim/io/atomic_file.h"
#include "vis/chart.h"
#include "vis/phase_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sandglass::cli {

using namespace analysis;

namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  DiagramOptions diagram;
  bool pictures = false;
};

PlotOptions readPlot(const std::vector<std::string>& words) {
  PlotOptions options;
  for (const auto& word : words) {
    const auto equals = word.find('=');
    const std::string key = word.substr(0, equals),
                      value = equals == std::string::npos ? "" : word.substr(equals + 1);
    const auto colon = value.find(':');
    if (key == "x")
      options.diagram.x = value;
    else if (key == "y")
      options.diagram.y = value;
    else if (key == "colour" || key == "color")
      options.diagram.colour = value;
    else if (key == "line")
      options.diagram.line = value == "none" ? "" : value;
    else if (key == "pictures" && (value == "yes" || value == "no"))
      options.pictures = value == "yes";
    else if (key == "where" && colon != std::string::npos)
      options.diagram.where.emplace_back(value.substr(0, colon), value.substr(colon + 1));
    else if (key == "classes" &&
             std::from_chars(value.data(), value.data() + value.size(), options.diagram.classes).ec ==
                 std::errc() &&
             options.diagram.classes >= 1 && options.diagram.classes <= 6)
      continue;
    else
      throw InputError(
          fmt::format("--plot has '{}', but takes x=COLUMN, y=COLUMN, colour=COLUMN, line=COLUMN (or "
                      "none), where=COLUMN:VALUE, classes=N up to 6, pictures=yes",
                      word));
  }
  if (options.diagram.x.empty() || options.diagram.y.empty())
    throw InputError("--plot needs x=COLUMN and y=COLUMN");
  return options;
}

/// The far half of the grains from the front and a little above, without walls: what the bed is like inside.
vis::View exampleView(const Frame& frame, const std::string& title) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : frame.position)
    box.extend(x);
  const Vec3 middle = box.center(), size = box.sizes();
  vis::View view;
  view.title = title;
  view.width = 600;
  view.height = 430;
  view.walls = view.axes = view.box = view.timeStamp = view.scaleBar = view.legend = false;
  const double high = std::max(1.4 * size.z(), std::max(size.x(), size.y()) * view.height / view.width);
  view.camera.preset.clear();
  view.camera.orthographic = true;
  view.camera.orthographicHeight = 1.3 * high;
  view.camera.target = middle;
  view.camera.position = middle + 10 * high * Vec3(0, -1, 0.5);
  view.clips = {{middle, Vec3::UnitY()}};
  return view;
}

} // namespace

int plotSweep(const SweepArguments& a) {
  if (a.folder.empty()) throw InputError("--plot needs -o, the picture to write");
  const PlotOptions options = readPlot(a.plot);
  const SweepTable table(a.source);
  PhaseDiagram diagram = phaseDiagram(table, options.diagram);
  const std::map<std::string, std::string> provenance{
      {"version", programVersion()},
      {"sweep", fs::absolute(a.source).lexically_normal().string()},
      {"sweep version", table.info("version")}};
  diagram.chart.provenance = diagram.table.provenance = provenance;
  fs::path picture = a.folder;
  if (picture.extension() != ".png") picture += ".png";
  if (picture.has_parent_path()) fs::create_directories(picture.parent_path());
  vis::Renderer renderer;
  std::vector<vis::PhaseExample> examples;
  if (options.pictures)
    for (const auto& example : diagram.examples) {
      const FramePtr frame = table.lastFrame(example.run);
      if (frame && frame->size() > 0)
        examples.push_back({frame, exampleView(*frame, fmt::format("{}: {}", example.name, example.label))});
    }
  if (examples.empty())
    vis::writeChart(renderer, diagram.chart, picture);
  else
    vis::writePhasePicture(renderer, diagram.chart, examples, picture);
  writeAtomically(fs::path(picture).replace_extension(".csv"), toCsv(diagram.table));
  fmt::print("{} places of the plane in {} and {}\n", diagram.table.rows.size(), picture.string(),
             fs::path(picture).replace_extension(".csv").string());
  return 0;
}

} // namespace sandglass::cli
