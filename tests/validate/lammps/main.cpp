// Agreement with LAMMPS, an independent program, on the same scenes with the same laws.
// Usage: validate_lammps FOLDER [--case pairs|beds|hopper]... [--seeds 1 2 3] [--beds 50] [--quick]

#include "tests/validate/lammps/cases.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <numeric>

using namespace sandglass;
using namespace sandglass::validate;

int main(int argc, char** argv) {
  CLI::App app{"agreement with LAMMPS"};
  std::string folder;
  std::vector<std::string> names;
  std::vector<std::uint64_t> seeds{1, 2, 3};
  int beds = 50;
  bool quick = false;
  app.add_option("folder", folder, "where results go")->required();
  app.add_option("--case", names, "only these")->check(CLI::IsMember({"pairs", "beds", "hopper"}));
  app.add_option("--seeds", seeds, "of the hoppers' beds");
  app.add_option("--beds", beds, "how many settled beds; five seconds of computing each")
      ->check(CLI::Range(2, 10000));
  app.add_flag("--quick", quick, "small beds, one of each: shows that everything works");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    seeds = {1};
    beds = 2;
  }
  std::vector<std::uint64_t> bedSeeds(static_cast<std::size_t>(beds));
  std::iota(bedSeeds.begin(), bedSeeds.end(), 1);
  const auto wanted = [&](const char* name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  try {
    Report report;
    const std::string version = peers::lammpsVersion();
    if (version.empty()) {
      report.recorded("all", "agreement with LAMMPS", 0, 0, "", "", "LAMMPS (lmp) is not installed");
    } else {
      if (wanted("pairs")) comparePairs(report);
      if (wanted("beds")) compareBeds(report, bedSeeds, quick);
      if (wanted("hopper")) compareHoppers(report, seeds, quick);
    }
    if (quick)
      for (Row& r : report.rows)
        if (!r.testCase.starts_with("trajectory")) r.skipped = "a quick look";
    writeReport(
        report, folder, "lammps", "Agreement with an independent program",
        "The same grains, laws, walls and step in LAMMPS: trajectories through one collision, beds "
        "that settle\n"
        "in each program by itself, and slot hoppers that start from common settled beds.",
        fmt::format("{}; {} settled beds, hoppers with seeds {}", version, beds, fmt::join(seeds, ", ")));
    std::cout << csv(report.rows);
    return allOk(report.rows) ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << "validate_lammps: " << e.what() << "\n";
    return 1;
  }
}
