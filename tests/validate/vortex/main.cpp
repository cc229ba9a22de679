// Usage: validate_vortex FOLDER [--case grid]... [--quick] [--judge] [--work DIR]. Runs the sweeps beside
// this file into DIR (out/validation/vortex_sweeps by default; run again, it goes on), then writes
// FOLDER/vortex.csv, vortex.md and vortex/ with diagrams and their numbers.

#include "analysis/sweep/phase_diagram.h"
#include "analysis/sweep/sweep_runner.h"
#include "sim/run/folder_lock.h"
#include "tests/validate/vortex/cases.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <fstream>
#include <iostream>

using namespace sandglass;
using namespace sandglass::validate;
namespace fs = std::filesystem;

namespace {

const std::vector<VortexCase>& allCases() {
  static const std::vector<VortexCase> cases{
      {"speeds", "Speeds relative to the fluid", judgeSpeeds},
      {"grid", "The realistic grid", judgeGrid},
      {"coupled", "A bed that follows the fluid", judgeCoupled},
      {"drags", "Drag laws", judgeDrags},
      {"bare", "Drag laws without wind and friction", judgeBare},
      {"settling", "Settling in a drag on all of the motion", judgeSettling},
      {"volume", "Constant volume of the bed", judgeVolume},
  };
  return cases;
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs what is missing of a sweep.
analysis::SweepTable sweep(const VortexCase& c, const fs::path& work, bool quick, bool run) {
  const fs::path source = SANDGLASS_SOURCE_DIR "/tests/validate/vortex";
  std::string text = contentOf(source / (c.name + ".toml"));
  if (quick) { // runs of a second, one seed
    const std::string brief = "'stage.stir.until.duration=\"1 s\"'";
    if (const auto set = text.find("set = ["); set != std::string::npos)
      text.insert(set + 7, brief + ", ");
    else
      text.insert(text.find("scene = "), "set = [" + brief + "]\n");
    if (const auto seeds = text.find("seeds = 3"); seeds != std::string::npos)
      text.replace(seeds, 9, "seeds = 1");
  }
  const auto plan = analysis::parseSweep(text, (source / (c.name + ".toml")).string(), source);
  const fs::path folder = work / (quick ? c.name + "_quick" : c.name);
  fs::create_directories(folder);
  const FolderLock lock(folder);
  const fs::path file = folder / analysis::SweepTable::fileName;
  if (fs::exists(file)) {
    const analysis::SweepTable there(file);
    if (there.info("sweep") != plan.text || there.info("scene") != plan.sceneText) fs::remove(file);
  }
  if (!fs::exists(file)) analysis::SweepTable::create(file, plan);
  analysis::SweepTable table(file, analysis::SweepTable::Access::write);
  analysis::SweepRunnerOptions options;
  double told = -1;
  options.onProgress = [&](const analysis::SweepProgress& p) {
    if (p.fraction < told + 0.1) return;
    told = p.fraction;
    std::cerr << fmt::format("{}: {} of {} runs, {} failed, {:.0f} s left\n", c.name, p.done, p.runs,
                             p.failed, p.secondsLeft);
  };
  if (run) analysis::SweepRunner(table, options).execute();
  return table;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"the vortex tank against its source"};
  std::string folder, work = "out/validation/vortex_sweeps";
  std::vector<std::string> names;
  bool quick = false, judgeOnly = false;
  app.add_option("folder", folder, "where results go")->required();
  app.add_option("--case", names,
                 "only these cases: speeds, grid, coupled, drags, bare, settling, volume, contacts, samples, "
                 "paraboloid");
  app.add_option("--work", work, "where the tables of the sweeps are kept");
  app.add_flag("--quick", quick, "runs of a second: shows that everything works");
  app.add_flag("--judge", judgeOnly, "run nothing, judge the runs that are there");
  CLI11_PARSE(app, argc, argv);
  try {
    Report report;
    std::string pages;
    for (const VortexCase& c : allCases()) {
      if (!names.empty() && std::find(names.begin(), names.end(), c.name) == names.end()) continue;
      const auto table = sweep(c, work, quick, !judgeOnly);
      pages += fmt::format("\n## {}\n\n{}\n", c.title, c.judge(table, report));
      const fs::path csv = fs::path(folder) / "vortex" / (c.name + "_runs.csv");
      fs::create_directories(csv.parent_path());
      std::ofstream(csv) << table.csv();
    }
    const auto wanted = [&](const char* name) {
      return !quick && !judgeOnly &&
             (names.empty() || std::find(names.begin(), names.end(), name) != names.end());
    };
    if (wanted("contacts")) pages += fmt::format("\n## Contacts\n\n{}\n", judgeContacts(report));
    if (wanted("samples")) pages += fmt::format("\n## Samples\n\n{}\n", judgeSamples(report));
    if (wanted("paraboloid")) pages += fmt::format("\n## A turning bed\n\n{}\n", judgeParaboloid(report));
    if (quick)
      for (Row& row : report.rows)
        row.skipped = "a quick look";
    writeReport(
        report, folder, "vortex", "Grains in a vortex",
        "256 grains in the tank of Rice (M.S. thesis, University of Mississippi, 2012). \"Re-run\" is an "
        "independent small\nprogram that runs the listing of the thesis with other random numbers; the "
        "grids of states are its results. Each case is a\nsweep, `tests/validate/vortex/*.toml`; the table "
        "of "
        "its runs is beside the pictures.",
        "5 s of each run, states as listed unless it says otherwise");
    std::ofstream(fs::path(folder) / "vortex.md", std::ios::app) << pages;
    std::cout << csv(report.rows);
    return allOk(report.rows) ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << "validate_vortex: " << e.what() << "\n";
    return 1;
  }
}
