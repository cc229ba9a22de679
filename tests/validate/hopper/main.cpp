// The dry hopper of Anand (PhD thesis, University of Florida, 2009) on a reduced bed, three seeds a bed, each
// bed run once for all cases that need it. Usage: validate_hopper FOLDER [--case V14]... [--seeds 1 2 3]
// [--quick] Writes FOLDER/hopper.csv, hopper.md, hopper/*.png with their numbers, and hopper/runs.csv.

#include "tests/validate/hopper/cases.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>

using namespace sandglass;
using namespace sandglass::validate;

namespace sandglass::validate {

std::vector<HopperCase> allHopperCases() {
  std::vector<HopperCase> all;
  for (const auto& family :
       {pairCases(), rateCases(), frictionCases(), shapeCases(), courseCases(), mixtureCases()})
    all.insert(all.end(), family.begin(), family.end());
  std::sort(all.begin(), all.end(), [](const HopperCase& a, const HopperCase& b) {
    return std::stoi(a.name.substr(1)) < std::stoi(b.name.substr(1));
  });
  return all;
}

} // namespace sandglass::validate

int main(int argc, char** argv) {
  CLI::App app{"the dry hopper against its source"};
  std::string folder;
  std::vector<std::string> names;
  std::vector<std::uint64_t> seeds{1, 2, 3};
  bool quick = false;
  app.add_option("folder", folder, "where results go")->required();
  app.add_option("--case", names, "only these cases: V1, V5, ...");
  app.add_option("--seeds", seeds, "of the random fillings");
  app.add_flag("--quick", quick, "a fifth of the grains, one seed, long steps: shows that everything works");
  CLI11_PARSE(app, argc, argv);
  if (quick) seeds = {1};
  try {
    std::vector<HopperCase> cases;
    for (const HopperCase& c : allHopperCases())
      if (names.empty() || std::find(names.begin(), names.end(), c.name) != names.end()) cases.push_back(c);
    if (cases.empty() || (!names.empty() && cases.size() != names.size())) {
      std::vector<std::string> known;
      for (const HopperCase& c : allHopperCases())
        known.push_back(c.name);
      std::cerr << fmt::format("validate_hopper: not all of '{}' are cases; there are: {}\n",
                               fmt::join(names, " "), fmt::join(known, " "));
      return 2;
    }
    const auto start = std::chrono::steady_clock::now();
    HopperRuns runs(seeds, quick);
    for (const HopperCase& c : cases)
      for (const HopperBed& bed : c.beds)
        runs.ask(bed);
    runs.execute();
    Report report;
    for (const HopperCase& c : cases)
      c.judge(runs, report);
    if (quick)
      for (Row& r : report.rows)
        if (!r.testCase.starts_with("V1 ") && !r.testCase.starts_with("V28 ")) r.skipped = "a quick look";
    const double minutes =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / 60;
    const std::string preamble = "The dry cases of Anand (PhD thesis, University of Florida, 2009) on a "
                                 "reduced bed: 3500 glass beads of 2.24 mm\n"
                                 "in a flat-bottomed bin 7.5 cm wide with an outlet of 2.5 cm, 2.5 diameters "
                                 "deep and periodic, unless a case\n"
                                 "varies it. The rate is the slope of discharged mass between 10 and 50 %, "
                                 "per depth. Uncertainties are half\n"
                                 "widths of 95 % intervals over the seeds (Student's t). \"An independent "
                                 "small program\" is a separate minimal\n"
                                 "code for the same model: tolerances of V6 to V8, V11 to V14 and V16 were "
                                 "set knowing its results, so that\n"
                                 "agreement there guards against change rather than proves the model.";
    writeReport(report, folder, "hopper", "Dry slot hopper", preamble,
                fmt::format("seeds {}; {:.0f} minutes", fmt::join(seeds, ", "), minutes));
    std::ofstream(std::filesystem::path(folder) / "hopper" / "runs.csv") << runs.csv();
    std::cout << csv(report.rows);
    return allOk(report.rows) ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << "validate_hopper: " << e.what() << "\n";
    return 1;
  }
}
