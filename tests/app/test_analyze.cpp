// sandglass analyze from a run on the disk: files, key numbers, what is left out, refusals.

#include "tests/app/program.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <sys/wait.h>

using namespace sandglass::test;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

/// 250 grains through a small slot hopper.
const fs::path& run() {
  static const TemporaryFolder folder("analyze-run");
  static const fs::path path = [] {
    std::ofstream(folder / "scene.toml") << smallHopper;
    const Result made =
        program("run " + (folder / "scene.toml").string() + " -o " + (folder / "run").string());
    INFO(made.text);
    REQUIRE(made.code == 0);
    return folder / "run";
  }();
  return path;
}

std::string content(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

} // namespace

TEST_CASE("analyze does what the run allows and says what it leaves out", "[analyze]") {
  const TemporaryFolder out("analyze-all");
  const Result result =
      program("analyze " + run().string() + " --r-max 3d --margin 1d -o " + (out / "all").string());
  INFO(result.text);
  CHECK(result.code == 0);
  CHECK_THAT(result.text, Contains("packing fraction"));
  CHECK_THAT(result.text, Contains("g(r) (E3"));
  for (const char* name : {"packing", "gr", "gr_coordination"})
    for (const char* ending : {".csv", ".json"})
      CHECK(fs::exists(out / "all" / (std::string(name) + ending)));
  const auto g = nlohmann::json::parse(content(out / "all" / "gr.json"));
  CHECK_THAT(g["definition"].get<std::string>(), Contains("E3 (local shell volume)"));
  CHECK(g["numbers"]["diameter"].get<double>() > 2.0e-3); // 2 to 2.6 mm
  CHECK(g["numbers"]["diameter"].get<double>() < 2.6e-3);
  CHECK(g["provenance"].contains("scene"));
  CHECK_THAT(content(out / "all" / "packing.csv"), Contains("\nheight [m],packing,packing error\n"));
}

TEST_CASE("contacts, residence times and an impact map of a run that has them", "[analyze]") {
  const TemporaryFolder folder("analyze-contacts");
  const std::string scene = (folder / "s.toml").string(), made = (folder / "r").string();
  std::ofstream(scene) << smallHopper;
  REQUIRE(program("run " + scene + " -o " + made +
                  " --set output.contacts=true --set outlet.below.record=true --set "
                  "stage.discharge.until.duration=90ms")
              .code == 0);
  const Result result = program("analyze " + made + " --contacts --residence --impact-map " + scene + " -o " +
                                (folder / "out").string());
  INFO(result.text);
  CHECK(result.code == 0);
  CHECK_THAT(result.text, Contains("overlaps with a grain: mean") && Contains("residence time: mean 0.") &&
                              Contains("impacts of bead on bead restitution: 0.89"));
  for (const char* name : {"overlaps", "contact_forces", "residence_times", "impact_map"})
    CHECK(fs::exists(folder / "out" / (std::string(name) + ".csv")));
}

TEST_CASE("one analysis, CSV alone", "[analyze]") {
  const TemporaryFolder out("analyze-one");
  const Result result =
      program("analyze " + run().string() + " --packing --csv-only -o " + (out / "one").string());
  INFO(result.text);
  CHECK(result.code == 0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(out / "one"))
    names.push_back(entry.path().filename().string());
  CHECK(names == std::vector<std::string>{"packing.csv"});
}

TEST_CASE("what analyze refuses, it refuses with a sentence", "[analyze]") {
  const TemporaryFolder out("analyze-refusals");
  const std::vector<std::pair<std::string, std::string>> cases{
      {"--gr --estimator E9", "there is no g(r) estimator 'E9': choose E0"},
      {"--gr --frames 9999:10000", "leaves none of the"},
      {"--gr --frames a:b", "--frames is 'a:b', but must be two indices"},
      {"--gr --r-max -3", "--r-max is '-3', but must be above 0"},
      {"--gr --r-max '3 kg'", "--r-max is '3 kg', but must be a length"},
      {"--gr --limit q'<'1", "--limit is 'q<1', but must read like"},
      {"--gr --limit 'y>1 m'", "no frame with enough grains in its region"},
      {"--discharge --range 0.5:0.1", "--range is '0.5:0.1', but must be two ascending shares"},
      {"--discharge --probe nosuch", "nosuch"},
      {"--beverloo --range 0.05:0.95", "at least two different outlets"},
      {"--contacts", "has no contacts: set contacts = true"},
      {"--residence", "there is no discharged.csv: give an outlet of the scene record = true"},
      {"--outflow", "there is no discharged.csv: give an outlet of the scene record = true"},
      {"--heap", "but a heap angle needs 8 on each side"},
      {"--impact-map nosuch.toml", "nosuch.toml: there is no such scene file"},
  };
  for (const auto& [options, sentence] : cases) {
    const Result result =
        program("analyze " + run().string() + " " + options + " -o " + (out / "x").string());
    INFO(options << "\n" << result.text);
    CHECK(result.code == 2);
    CHECK_THAT(result.text, Contains(sentence));
  }
  const Result none = program("analyze " + (out / "nowhere").string() + " -o " + (out / "x").string());
  CHECK(none.code == 2);
  CHECK_THAT(none.text, Contains("nowhere"));
}

TEST_CASE("analyses of the registry are options with knobs, and wrong knobs are sentences", "[analyze]") {
  const TemporaryFolder out("analyze-knobs");
  const std::string folder = " -o " + (out / "o").string();
  CHECK_THAT(program("analyze --list").text, Contains("--bond-angles") && Contains("voids.probes = 200000"));
  const Result good =
      program("analyze " + run().string() + folder +
              " --bond-angles --coordination --knob bond_angles.bins=45 --knob bond_angles.cutoff=2");
  INFO(good.text);
  CHECK(good.code == 0);
  CHECK_THAT(content(out / "o" / "bond_angles.csv"), Contains("# provenance knob bins: 45"));
  CHECK(fs::exists(out / "o" / "coordination_grains.csv"));
  const auto refused = [&](const std::string& options, const std::string& sentence) {
    const Result result = program("analyze " + run().string() + folder + options);
    INFO(result.text);
    CHECK(result.code == 2);
    CHECK_THAT(result.text, Contains(sentence));
  };
  refused(" --order --knob order.bins=many", "order.bins is 'many', but must be a whole number");
  refused(" --order --knob order.colour=1", "no knob 'colour'");
  refused(" --order --knob colour", "must read like gr.bins=400");
  refused(" --forces", "needs contacts");
}
