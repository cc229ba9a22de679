// sandglass convert: frames into forms that other programs read.

#include "app/cli/commands.h"
#include "app/cli/import_options.h"
#include "sim/base/error.h"
#include "sim/io/foreign_export.h"
#include "sim/io/run_folder.h"
#include "sim/io/table_export.h"

#include <fmt/format.h>

#include <memory>

namespace sandglass::cli {

namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string input, output, frame;
  ImportArguments import;
};

/// "last", or a number from 0; negative ones count from the end.
std::size_t frameNumber(const std::string& text, std::size_t count, const std::string& source) {
  if (count == 0) throw InputError(fmt::format("{}: there are no frames yet", source));
  if (text == "last") return count - 1;
  try {
    std::size_t used = 0;
    const long long number = std::stoll(text, &used);
    const long long index = number < 0 ? static_cast<long long>(count) + number : number;
    if (used == text.size() && index >= 0 && index < static_cast<long long>(count))
      return static_cast<std::size_t>(index);
  } catch (const std::logic_error&) { // not a number; the sentence below says so
  }
  throw InputError(
      fmt::format("--frame {}: {} has the frames 0 to {}; give one of them, -1 for the last, or 'last'", text,
                  source, count - 1));
}

int execute(const ConvertArguments& arguments) {
  const fs::path output(arguments.output);
  const std::string form = output.extension().string();
  const auto frames = openForCommand(arguments.input, arguments.import);
  if (const fs::path folder = output.parent_path(); !folder.empty()) fs::create_directories(folder);
  const bool one = !arguments.frame.empty();
  const std::size_t chosen =
      one || form == ".vtp" ? frameNumber(one ? arguments.frame : "last", frames->size(), frames->name()) : 0;
  if (one && (form == ".pvd" || form == ".vtkhdf"))
    throw InputError(fmt::format(
        "--frame {}: a single frame goes into .vtp, .csv, .dump or .xyz; leave --frame out for {}",
        arguments.frame, form));
  if (form == ".vtp")
    exportVtp(*frames->load(chosen), output);
  else if (form == ".csv")
    exportCsv(*frames, chosen, one ? chosen + 1 : frames->size(), output);
  else if (form == ".dump" || form == ".lammpstrj")
    exportLammpsDump(*frames, chosen, one ? chosen + 1 : frames->size(), output);
  else if (form == ".xyz")
    exportExtendedXyz(*frames, chosen, one ? chosen + 1 : frames->size(), output);
  else if (form == ".pvd")
    exportPvd(*frames, output);
  else if (form == ".vtkhdf") {
    const std::string scene = frames->sceneText();
    const bool single =
        !scene.empty() &&
        parseScene(scene, arguments.input + " (scene inside)").output.singlePrecisionPositions;
    exportVtkhdf(*frames, scene, single, output);
  } else
    throw InputError(
        fmt::format("{}: the ending '{}' names no form that is written; there are .vtp (one frame), .pvd "
                    "(all frames as .vtp), .vtkhdf (all frames in one file), .csv, .dump (LAMMPS) and .xyz "
                    "(extended XYZ)",
                    output.string(), form));
  fmt::print("{}: {}\n", output.string(),
             one || form == ".vtp" ? fmt::format("frame {} at {:.6g} s", chosen, frames->time(chosen))
                                   : fmt::format("{} frames", frames->size()));
  return 0;
}

} // namespace

void addConvert(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert", "Write frames as .vtp, .pvd, .csv, LAMMPS .dump, extended .xyz or one .vtkhdf");
  command
      ->add_option("RUN", arguments->input,
                   "folder of a run, a .vtkhdf file, a file of another program, or a pattern of them")
      ->required();
  command->add_option("OUT", arguments->output, "file to write; its ending names the form")->required();
  command->add_option("--frame", arguments->frame,
                      "only this frame: a number, negative from the end, or 'last'");
  addImportOptions(*command, arguments->import);
  command->callback([arguments, &action] { action = [arguments] { return execute(*arguments); }; });
}

} // namespace sandglass::cli
