// sandglass compare: two runs or files beside each other, frame by frame and as distributions.

#include "analysis/compare.h"
#include "app/cli/commands.h"
#include "app/cli/import_options.h"
#include "app/cli/result_files.h"
#include "sim/base/error.h"
#include "sim/io/run_folder.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace sandglass::cli {

namespace {

struct CompareArguments {
  std::string a, b, folder;
  double tolerance = -1, probability = -1;
  ImportArguments import;
};

int execute(const CompareArguments& arguments) {
  const auto a = openForCommand(arguments.a, arguments.import),
             b = openForCommand(arguments.b, arguments.import);
  if (a->size() == 0 || b->size() == 0)
    throw InputError(fmt::format("{}: there are no frames yet", a->size() == 0 ? arguments.a : arguments.b));
  // Frames are matched by their times: for each of A the nearest of B, within half of A's interval.
  analysis::Table frames;
  frames.name = "frames";
  frames.title = "Frame by frame";
  frames.definition =
      "grains of the same id, positions by the nearest image; frames of B that are nearest in time";
  frames.columns = {{"time of A", "s"},
                    {"time of B less that of A", "s"},
                    {"common grains", ""},
                    {"largest distance", "m"},
                    {"root mean square distance", "m"},
                    {"root mean square velocity difference", "m/s"}};
  const double interval = a->size() > 1
                              ? (a->time(a->size() - 1) - a->time(0)) / static_cast<double>(a->size() - 1)
                              : std::numeric_limits<double>::infinity();
  double largest = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < a->size(); ++i) {
    while (next + 1 < b->size() &&
           std::abs(b->time(next + 1) - a->time(i)) <= std::abs(b->time(next) - a->time(i)))
      ++next;
    if (std::abs(b->time(next) - a->time(i)) > 0.5 * interval) continue;
    const auto d = analysis::difference(*a->load(i), *b->load(next));
    frames.rows.push_back(
        {d.time, d.timeGap, static_cast<double>(d.common), d.largest, d.rms, d.velocityRms});
    if (d.common > 0) largest = std::max(largest, d.largest);
  }
  const analysis::Table distributions =
      analysis::compareDistributions(*a->load(a->size() - 1), *b->load(b->size() - 1));

  fmt::print("{} frames of {} ({} in A, {} in B) at common times; largest distance of a grain {:.4g} m\n",
             frames.rows.size(), arguments.a, a->size(), b->size(), largest);
  double least = 1;
  for (std::size_t r = 0; r < distributions.rows.size(); ++r) {
    const auto& row = distributions.rows[r];
    least = std::min(least, row[3]);
    fmt::print("  {:<24} A {:>12.5g}  B {:>12.5g}  distance {:.4f}  probability {:.3g}\n",
               distributions.rowNames[r], row[0], row[1], row[2], row[3]);
  }
  if (!arguments.folder.empty()) {
    ResultFiles files(arguments.folder, false);
    for (auto table : {frames, distributions}) {
      table.provenance = {{"a", arguments.a}, {"b", arguments.b}};
      files.write(table, "compare_");
    }
    fmt::print("results in {}\n", arguments.folder);
  }
  if (arguments.tolerance >= 0 && frames.rows.empty())
    throw RunError("the two have no common times, so nothing can be said about single grains");
  if (arguments.tolerance >= 0 && largest > arguments.tolerance)
    throw RunError(fmt::format("a grain is {:.4g} m away from itself, and {:.4g} m are allowed", largest,
                               arguments.tolerance));
  if (arguments.probability >= 0 && least < arguments.probability)
    throw RunError(fmt::format("a distribution differs: its probability is {:.3g}, and {:.3g} is asked for",
                               least, arguments.probability));
  return 0;
}

} // namespace

void addCompare(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command =
      app.add_subcommand("compare", "Two runs or files: differences grain by grain and as distributions");
  command->add_option("a", arguments->a, "run folder or file")->required()->type_name("A");
  command->add_option("b", arguments->b, "run folder or file")->required()->type_name("B");
  command->add_option("-o,--output", arguments->folder, "folder for the tables (default: printed only)")
      ->type_name("DIR");
  command
      ->add_option("--tolerance", arguments->tolerance,
                   "exit with 1 when a grain is farther from itself than this, in metres; 0: equal")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--probability", arguments->probability,
                   "exit with 1 when a distribution's probability of being the same is lower")
      ->check(CLI::Range(0.0, 1.0));
  addImportOptions(*command, arguments->import);
  command->callback([arguments, &action] { action = [arguments] { return execute(*arguments); }; });
}

} // namespace sandglass::cli
