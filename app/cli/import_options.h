#pragma once
// What every command that opens frames may be told about files of other programs.

#include "sim/io/import/import_settings.h"
#include "sim/io/run_folder.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace sandglass::cli {

struct ImportArguments {
  std::string columns, saveColumns, radius, timeStep, frameInterval, units, box, periodic;
  std::vector<std::string> walls;
};

void addImportOptions(CLI::App& command, ImportArguments& arguments);

/// The file of --columns, or the one beside `path`, with the options laid over it. Throws InputError.
ImportSettings importSettingsOf(const ImportArguments& arguments, const std::string& path);

/// Opens frames and looks through the whole source, with a progress bar where that takes long; what had to be
/// taken for granted goes to standard error. Writes the file of --save-columns. Throws InputError.
std::unique_ptr<FrameSource> openForCommand(const std::string& path, const ImportArguments& arguments);

/// Tells on standard error what sources say that they had not said before; to be called at the end as well,
/// since some is known only when a frame has been read.
void printRemarks(const FrameSource& source);

} // namespace sandglass::cli
