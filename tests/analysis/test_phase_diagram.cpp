// Phase diagrams from a made-up table: commonest states, rings where seeds disagree, the critical line,
// classes.

#include "analysis/sweep/phase_diagram.h"
#include "sim/base/error.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace sandglass;
using namespace sandglass::analysis;

namespace {

/// Radius 1, 2, 3 mm, rotation 10, 20 rad/s, three seeds. Fluid below 15 rad/s, pinned above; at 2 mm and 20
/// rad/s one seed says large spout; at 3 mm and 10 rad/s all runs fail.
SweepTable madeUp(const test::TemporaryFolder& folder) {
  const SweepPlan plan =
      parseSweep("scene = \"s\"\nseeds = 3\n[[axis]]\nname = \"r\"\nunit = \"mm\"\nvalues = [1, 2, 3]\n"
                 "[[axis]]\nname = \"omega\"\nunit = \"rad/s\"\nvalues = [10, 20]\n",
                 "S.toml", ".", std::string("seed = 1"));
  SweepTable table = SweepTable::create(folder / SweepTable::fileName, plan);
  for (const auto& row : table.rows()) {
    const double r = row.number(0), omega = row.number(1);
    SweepOutcome outcome;
    if (r == 3 && omega == 10) {
      outcome.status = SweepStatus::failed;
      outcome.fault = "it would not, \"really\"";
    } else {
      const std::string state = omega < 15                     ? "fluid"
                                : r == 2 && row.replicate == 3 ? "large spout"
                                                               : "pinned";
      const auto result = [&](const char* name, const char* unit, bool text, SweepValue value) {
        outcome.results.emplace_back(SweepColumn{name, unit, SweepRole::result, text, "made up"},
                                     std::move(value));
      };
      result("state", "", true, state);
      result("critical_rotation", "rad/s", false, 7 * r);
      result("settle_time", "s", false, r + 0.01 * row.replicate);
    }
    table.record(row.run, outcome);
  }
  return table;
}

const Series& named(const Curve& chart, const std::string& name) {
  for (const auto& series : chart.series)
    if (series.name == name) return series;
  FAIL("no series " << name);
  return chart.series.front();
}

} // namespace

TEST_CASE("a phase diagram of states", "[sweep]") {
  const test::TemporaryFolder folder("diagram");
  const SweepTable table = madeUp(folder);
  DiagramOptions options;
  options.x = "r";
  options.y = "omega";
  const PhaseDiagram diagram = phaseDiagram(table, options);
  CHECK(named(diagram.chart, "fluid").x == std::vector<double>{1, 2});
  CHECK(named(diagram.chart, "pinned").x == std::vector<double>{1, 2, 3});
  CHECK(named(diagram.chart, "large spout").x.empty()); // one of three seeds
  CHECK(named(diagram.chart, "failed").x == std::vector<double>{3});
  CHECK(named(diagram.chart, "seeds disagree").x == std::vector<double>{2});
  CHECK(named(diagram.chart, "seeds disagree").ring);
  const Series& line = diagram.chart.series.front(); // the critical rotation, found by itself
  CHECK(line.name == "critical rotation");
  CHECK(line.y == std::vector<double>{7, 14, 21});
  CHECK_FALSE(line.scatter);
  REQUIRE(diagram.table.rows.size() == 6);
  CHECK(diagram.table.rowNames[3] == "pinned"); // by x, then y: 1/10, 1/20, 2/10, 2/20
  CHECK(diagram.table.rows[3][3] == Approx(2.0 / 3));
  CHECK(diagram.table.rows[4][6] == 3);
  CHECK(diagram.examples.size() == 2); // fluid and pinned

  options.where = {{"r", "1"}};
  CHECK(phaseDiagram(table, options).table.rows.size() == 2);
  options.where = {{"r", "17"}};
  CHECK_THROWS_AS(phaseDiagram(table, options), InputError);
  options.where = {};
  options.x = "state";
  CHECK_THROWS_AS(phaseDiagram(table, options), InputError);
  options.x = "radius";
  CHECK_THROWS_WITH(phaseDiagram(table, options), Catch::Contains("there is no column 'radius'"));
}

TEST_CASE("a phase diagram of numbers has classes", "[sweep]") {
  const test::TemporaryFolder folder("diagram-numbers");
  const SweepTable table = madeUp(folder);
  DiagramOptions options;
  options.x = "r";
  options.y = "omega";
  options.colour = "settle_time";
  options.classes = 4;
  const PhaseDiagram diagram = phaseDiagram(table, options);
  // 1.02 and 2.02 twice, 3.02 once.
  CHECK(named(diagram.chart, "1.02 to 1.52").x == std::vector<double>{1, 1});
  CHECK(named(diagram.chart, "to 2.02").x.size() + named(diagram.chart, "to 2.52").x.size() ==
        2); // on the border
  CHECK(named(diagram.chart, "to 3.02").x == std::vector<double>{3});
  CHECK(named(diagram.chart, "none").x == std::vector<double>{3});
  CHECK(diagram.table.rows[0][4] == Approx(0.01)); // spread over the seeds
}

TEST_CASE("a table keeps what it was given, and merges only its like", "[sweep]") {
  const test::TemporaryFolder folder("table"), other("table-other");
  SweepTable table = madeUp(folder);
  CHECK(SweepTable(folder.path()).csv(true) == table.csv(true));
  CHECK_THAT(table.csv(), Catch::Contains("failed,\"it would not, \"\"really\"\"\""));
  const SweepTable again = madeUp(other);
  CHECK(table.merge(again) == 0); // nothing new
  CHECK(table.info("title").empty());
  CHECK_THROWS_AS(SweepTable(folder / "nothing"), InputError);
  std::ofstream(folder / "text.sqlite") << "this is no database, but it is long enough to be taken for one";
  CHECK_THROWS_AS(SweepTable(folder / "text.sqlite"), InputError);
}
