// sandglass info: what is in a run or a file, and how each column of a foreign file is understood.

#include "app/cli/commands.h"
#include "app/cli/import_options.h"
#include "sim/base/error.h"
#include "sim/io/import/foreign_facts.h"
#include "sim/io/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace sandglass::cli {

namespace {

struct InfoArguments {
  std::string path;
  ImportArguments import;
};

void printColumns(const ForeignFacts& facts) {
  fmt::print("  {:<24} {:<20} {}\n", "column", "understood as", "values");
  for (const auto& column : facts.columns) {
    const std::string values =
        !column.words.empty()
            ? fmt::format("words: {}", fmt::join(column.words, " "))
            : fmt::format("{:.6g} to {:.6g}{}", column.smallest, column.largest,
                          column.notFinite == 0 ? ""
                                                : fmt::format(", {} no finite numbers", column.notFinite));
    fmt::print("  {:<24} {:<20} {}\n", column.name, column.quantity.empty() ? "(left out)" : column.quantity,
               facts.grains == 0 ? "" : values);
  }
}

void printFrame(const Frame& frame) {
  const Domain& d = frame.domain;
  fmt::print("  grains of the last frame: {}\n", frame.size());
  for (int k = 0; k < 3; ++k)
    fmt::print("  {} from {:.6g} to {:.6g} m, {}\n", "xyz"[k], d.lower[k], d.upper[k],
               d.periodic[static_cast<std::size_t>(k)] ? "repeats" : "open");
  std::vector<std::string> names;
  for (const auto& [name, values] : frame.scalars)
    names.push_back(name);
  for (const auto& [name, values] : frame.vectors)
    names.push_back(name + " (vector)");
  if (!frame.orientation.empty()) names.emplace_back("orientation");
  fmt::print("  quantities: {}\n", fmt::join(names, ", "));
  if (!frame.walls.empty()) fmt::print("  walls: {}\n", frame.walls.size());
  if (!frame.contacts.empty()) fmt::print("  contacts: {}\n", frame.contacts.size());
}

int execute(const InfoArguments& arguments) {
  if (isForeign(arguments.path)) {
    const ImportSettings settings = importSettingsOf(arguments.import, arguments.path);
    const ForeignFacts facts = foreignFacts(arguments.path, &settings);
    fmt::print("{}: {}; frame {} with {} grains{}\n", facts.file, facts.format, facts.frame, facts.grains,
               facts.tilted ? " in a tilted box" : "");
    printColumns(facts);
  }
  const auto frames = openForCommand(arguments.path, arguments.import);
  if (frames->size() == 0) throw InputError(fmt::format("{}: there are no frames yet", arguments.path));
  fmt::print("{}: {} frames from {:.6g} to {:.6g} s\n", arguments.path, frames->size(), frames->time(0),
             frames->time(frames->size() - 1));
  printFrame(*frames->load(frames->size() - 1));
  printRemarks(*frames);
  return 0;
}

} // namespace

void addInfo(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command =
      app.add_subcommand("info", "What is in a run or a file, and how its columns are understood");
  command
      ->add_option("FILE", arguments->path,
                   "folder of a run, a .vtkhdf file, a file of another program, or a pattern of them")
      ->required();
  addImportOptions(*command, arguments->import);
  command->callback([arguments, &action] { action = [arguments] { return execute(*arguments); }; });
}

} // namespace sandglass::cli
