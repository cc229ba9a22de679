// sandglass run --replicates: folders, going on, summary, exit codes.

#include "tests/app/program.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

using namespace sandglass::test;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::string brief = " --set 'stage.settle.until.duration=\"15 ms\"' --set "
                          "'stage.discharge.until.duration=\"45 ms\"' ";

} // namespace

TEST_CASE("replicates are single runs with seeds of their own", "[replicates]") {
  const TemporaryFolder folder("replicates");
  const std::string scene = (folder / "s.toml").string(), all = (folder / "all").string();
  std::ofstream(scene) << smallHopper;
  const std::string command = "run " + scene + brief + "--set seed=4 --replicates 3 -o " + all;
  const Result first = program(command);
  INFO(first.text);
  REQUIRE(first.code == 0);
  CHECK_THAT(first.text, Contains("3 of 3 runs are finished") && Contains("outflow.mass [kg]"));
  for (const char* name : {"replicates.csv", "summary.csv", "summary.json", "discharge_mean.csv"})
    CHECK(fs::exists(folder / "all" / name));
  REQUIRE(program("run " + scene + brief + "--set seed=5 -o " + (folder / "single").string()).code == 0);
  CHECK(content(folder / "all" / "seed_5" / "series.csv") == content(folder / "single" / "series.csv"));

  const auto summary = nlohmann::json::parse(content(folder / "all" / "summary.json"));
  const auto& names = summary["row_names"];
  const auto row = std::find(names.begin(), names.end(), "mass_discharged [kg]") - names.begin();
  REQUIRE(row < static_cast<long>(names.size()));
  CHECK(summary["rows"][row][3] == 3);
  CHECK(summary["provenance"]["seeds"] == "4 5 6");

  // One run is gone, one lacks its end: the first is made again, the second goes on, the third stays.
  const std::string series = content(folder / "all" / "seed_5" / "series.csv"),
                    before = content(folder / "all" / "summary.csv");
  fs::remove_all(folder / "all" / "seed_4");
  fs::path newest;
  for (const auto& entry : fs::directory_iterator(folder / "all" / "seed_5" / "checkpoints"))
    newest = std::max(newest, entry.path());
  fs::remove(newest);
  const Result again = program(command);
  INFO(again.text);
  CHECK(again.code == 0);
  CHECK_THAT(again.text, Contains("3 of 3 runs are finished (1 were before)"));
  CHECK(content(folder / "all" / "seed_5" / "series.csv") == series);
  CHECK(content(folder / "all" / "summary.csv") == before);
}

TEST_CASE("replicates of a scene without chance are told to be equal", "[replicates]") {
  const TemporaryFolder folder("replicates-equal");
  const std::string scene = (folder / "s.toml").string();
  std::string text = smallHopper;
  const auto fills = text.find("[[fill]]"), stages = text.find("[[stage]]");
  text.replace(fills, stages - fills, R"([[fill]]
kind = "list"
grains = [{ position = ["0", "1 cm", "0"], diameter = "2 mm" }]

)");
  std::ofstream(scene) << text;
  const std::string to = "--replicates 2 -o " + (folder / "all").string();
  const Result equal = program("run " + scene + brief + to);
  CHECK(equal.code == 0);
  CHECK_THAT(equal.text, Contains("all 2 runs ended with equal numbers"));
  std::ofstream(scene) << smallHopper;
  const Result chance = program("run " + scene + brief + to + "_of_chance");
  CHECK(chance.code == 0);
  CHECK_THAT(chance.text, !Contains("equal numbers"));
}

TEST_CASE("what replicates refuse, and how they fail", "[replicates]") {
  const TemporaryFolder folder("replicates-wrong");
  const std::string scene = (folder / "s.toml").string(), all = (folder / "all").string();
  std::ofstream(scene) << smallHopper;
  CHECK(program("run " + scene + " --replicates 0").code == 2);
  const Result large = program("run " + scene + " --set seed=9223372036854775807 --replicates 2 -o " + all);
  CHECK(large.code == 2);
  CHECK_THAT(large.text, Contains("seed is 9223372036854775807, but 2 replicates"));

  const Result failed =
      program("run " + scene + brief + "--set accuracy.maximum_overlap=1e-7 --replicates 2 -o " + all);
  CHECK(failed.code == 1);
  CHECK_THAT(failed.text, Contains("seed_1: ") && Contains("maximum_overlap") && Contains("0 of 2 runs"));
  const Result other = program("run " + scene + brief + "--replicates 2 -o " + all);
  CHECK(other.code == 2); // the folders hold runs of another scene
  CHECK_THAT(other.text, Contains("made from another scene"));
}
