#include "app/cli/import_options.h"

#include "app/cli/console.h"
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/import/row_parser.h"

#include <fmt/format.h>

#include <cstdio>
#include <set>

namespace sandglass::cli {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> parts(const std::string& text, char separator) {
  std::vector<std::string> list;
  for (const auto& part : cellsOf(text, separator))
    list.emplace_back(part);
  return list;
}

double positive(const std::string& option, const std::string& text, const char* unit) {
  const double value = importQuantity(option, text, unit);
  if (!(value > 0)) throw InputError(fmt::format("{} is '{}', but must be above 0", option, text));
  return value;
}

void setUnits(const std::string& text, ImportSettings& settings) {
  const auto units = parts(text, ',');
  if (units.size() > 3)
    throw InputError(
        fmt::format("--units is '{}', but must be the file's units of length, time and mass: mm,ms,g", text));
  const auto size = [&](const std::string& unit, const char* si) {
    return positive("--units", "1 " + unit, si);
  };
  if (!units[0].empty()) settings.length = size(units[0], "m");
  if (units.size() > 1 && !units[1].empty()) settings.time = size(units[1], "s");
  if (units.size() > 2 && !units[2].empty()) settings.mass = size(units[2], "kg");
}

void setBox(const std::string& text, ImportSettings& settings) {
  const auto ranges = parts(text, ',');
  Vec3 lower, upper;
  bool good = ranges.size() == 3;
  for (std::size_t k = 0; good && k < 3; ++k) {
    const auto ends = parts(ranges[k], ':');
    good = ends.size() == 2;
    if (!good) break;
    lower[static_cast<int>(k)] = importQuantity("--box", ends[0], "m");
    upper[static_cast<int>(k)] = importQuantity("--box", ends[1], "m");
  }
  if (!good || !(lower.array() < upper.array()).all())
    throw InputError(fmt::format(
        "--box is '{}', but must be three ascending pairs of lengths: 0:0.1,0:0.1,\"0:20 cm\"", text));
  settings.lower = lower;
  settings.upper = upper;
}

} // namespace

void addImportOptions(CLI::App& command, ImportArguments& a) {
  const auto add = [&](const char* name, auto& value, const char* type, const char* help) {
    return command.add_option(name, value, help)->type_name(type)->group("Files of other programs");
  };
  add("--columns", a.columns, "TOML",
      "what columns, units, box, radii, times and walls are (default: FILE.import.toml or import.toml beside "
      "the frames)");
  add("--save-columns", a.saveColumns, "TOML", "write the settings in use to a file, for --columns");
  add("--radius", a.radius, "LENGTH", "of all grains, where the file has none: \"1.5 mm\"");
  add("--time-step", a.timeStep, "TIME", "time of one step, where the file counts steps: \"1e-5 s\"");
  add("--frame-interval", a.frameInterval, "TIME", "time from frame to frame, where the file says none");
  add("--units", a.units, "mm,ms,g", "the file's units of length, time and mass (default: m,s,kg)");
  add("--box", a.box, "X:X,Y:Y,Z:Z", "the box of the grains, in metres or with units");
  add("--periodic", a.periodic, "AXES", "directions in which the box repeats: xy, or none");
  add("--walls", a.walls, "FILE",
      "walls beside the grains: a scene (its gravity and outlets hold as well), STL or VTP; may be repeated")
      ->allow_extra_args(false);
}

ImportSettings importSettingsOf(const ImportArguments& a, const std::string& path) {
  ImportSettings settings = a.columns.empty() ? settingsBeside(path) : readImportSettings(a.columns);
  if (!a.radius.empty()) settings.radius = positive("--radius", a.radius, "m");
  if (!a.timeStep.empty()) settings.timeStep = positive("--time-step", a.timeStep, "s");
  if (!a.frameInterval.empty()) settings.frameInterval = positive("--frame-interval", a.frameInterval, "s");
  if (!a.units.empty()) setUnits(a.units, settings);
  if (!a.box.empty()) setBox(a.box, settings);
  if (!a.periodic.empty()) settings.periodic = periodicDirections("--periodic", a.periodic);
  for (const auto& wall : a.walls)
    settings.walls.emplace_back(wall);
  return settings;
}

std::unique_ptr<FrameSource> openForCommand(const std::string& path, const ImportArguments& arguments) {
  const ImportSettings settings = importSettingsOf(arguments, path);
  auto source = openFrames(path, &settings);
  if (!arguments.saveColumns.empty()) writeAtomically(arguments.saveColumns, writeImportSettings(settings));
  ProgressBar bar("looking through " + fs::path(path).filename().string());
  while (!source->complete()) {
    source->refresh();
    bar.update(0, -1, fmt::format("{} frames", source->size()));
  }
  bar.finish();
  printRemarks(*source);
  return source;
}

void printRemarks(const FrameSource& source) {
  static std::set<std::string> told;
  for (const auto& remark : source.remarks())
    if (told.insert(remark).second) std::fprintf(stderr, "sandglass: %s\n", remark.c_str());
}

} // namespace sandglass::cli
