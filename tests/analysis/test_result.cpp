#include "analysis/result.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace sandglass::analysis;

namespace {
Curve sample() {
  Curve curve;
  curve.name = "gr";
  curve.title = "Pair correlation";
  curve.definition = "E3";
  curve.x = {"r / d", ""};
  curve.y = {"mass", "kg"};
  curve.frames = 3;
  curve.numbers = {{"rate", 0.1}};
  curve.provenance = {{"scene", "ab12"}};
  curve.series = {{"one, two", {1, 2}, {0.1, 1.0 / 3.0}, {0.5, 0.25}}};
  return curve;
}
} // namespace

TEST_CASE("a curve as CSV reads back to the last digit", "[result]") {
  CHECK(toCsv(sample()) ==
        "# title: Pair correlation\n# definition: E3\n# frames: 3\n# values: mass [kg]\n# rate [kg/s]: 0.1\n"
        "# provenance scene: ab12\nr / d,\"one, two [kg]\",\"one, two error "
        "[kg]\"\n1,0.1,0.5\n2,0.3333333333333333,0.25\n");
  CHECK(std::stod("0.3333333333333333") == 1.0 / 3.0);
}

TEST_CASE("series of unequal x follow each other", "[result]") {
  Curve curve = sample();
  curve.series.push_back({"fit", {5}, {6}, {}});
  const std::string csv = toCsv(curve);
  CHECK(csv.find("series,r / d,mass [kg],error\n\"one, two\",1,0.1,0.5\n") != std::string::npos);
  CHECK(csv.find("\nfit,5,6,\n") != std::string::npos);
}

TEST_CASE("a curve as JSON", "[result]") {
  Curve curve = sample();
  curve.series[0].y[0] = std::nan("");
  const auto j = nlohmann::json::parse(toJson(curve));
  CHECK(j["series"][0]["y"][1].get<double>() == 1.0 / 3.0);
  CHECK(j["series"][0]["y"][0].is_null());
  CHECK(j["numbers"]["rate"] == 0.1);
  CHECK(j["number_units"]["rate"] == "kg/s");
  CHECK(j["y"]["unit"] == "kg");
}

TEST_CASE("a table as CSV and JSON", "[result]") {
  const Table table{"beverloo", "Rates", "slot", {{"width", "m"}, {"rate", "kg/s"}}, {{0.025, 1}, {0.03, 2}},
                    {}};
  CHECK(toCsv(table) == "# title: Rates\n# definition: slot\nwidth [m],rate [kg/s]\n0.025,1\n0.03,2\n");
  CHECK(nlohmann::json::parse(toJson(table))["rows"][1][0] == 0.03);
}
