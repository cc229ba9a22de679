// The explorer of a sweep: exact diagrams of known tables, and the window under real keys and clicks.

#include "desktop_harness.h"

#include "app/desktop/chart_panel.h"
#include "app/desktop/point_panel.h"
#include "app/desktop/state_panel.h"
#include "app/desktop/sweep_panel.h"
#include "sim/io/run_folder.h"
#include "tests/app/program.h"
#include "tests/sim/frame_equality.h"

#include <QPushButton>
#include <QTabWidget>
#include <QTreeWidget>

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace sandglass;
using namespace sandglass::test;
using desktop::SweepChoice;
using desktop::SweepData;

namespace {

/// Columns r [mm], omega [1/s], law, state, settle_time [s], critical_rotation [rad/s]; two seeds a point.
SweepData table() {
  using analysis::SweepRole;
  SweepData data;
  data.axes = 3;
  data.columns = {{"r", "mm", SweepRole::axis, false, ""},
                  {"omega", "1/s", SweepRole::axis, false, ""},
                  {"law", "", SweepRole::axis, true, ""},
                  {"state", "", SweepRole::result, true, ""},
                  {"settle_time", "s", SweepRole::result, false, ""},
                  {"critical_rotation", "rad/s", SweepRole::result, false, ""}};
  int run = 0, point = 0;
  const auto add = [&](double r, double omega, const char* law, const char* first, const char* second,
                       double t1, double t2) {
    ++point;
    for (int k = 0; k < 2; ++k) {
      analysis::SweepRow row;
      row.run = ++run;
      row.point = point;
      row.replicate = k;
      row.seed = static_cast<std::uint64_t>(k + 1);
      row.status = analysis::SweepStatus::done;
      row.values = {r,     omega, std::string(law), std::string(k == 0 ? first : second), k == 0 ? t1 : t2,
                    10 * r};
      data.rows.push_back(row);
    }
  };
  add(4, 20, "linear", "flat", "flat", 1, 1);
  add(6, 20, "linear", "flat", "fluid", 2, 3);
  add(4, 90, "linear", "large spout", "large spout", 5, 5);
  add(4, 90, "quadratic", "pinned", "pinned", 4, 4);
  data.rows[6].status = data.rows[7].status = analysis::SweepStatus::failed;
  data.rows[6].fault = "a grain left the domain";
  data.failed = 2;
  return data;
}

const desktop::SweepSpot& spotOf(const desktop::SweepDiagram& diagram, int point) {
  const auto at = std::find_if(diagram.spots.begin(), diagram.spots.end(),
                               [&](const auto& spot) { return spot.point == point; });
  REQUIRE(at != diagram.spots.end());
  return *at;
}

void keepPicture(Desktop& desktop, const std::filesystem::path& otherwise, const char* name) {
  const char* folder = std::getenv("SANDGLASS_PICTURES");
  const auto file = folder ? std::filesystem::absolute(folder) / name : otherwise;
  handleEvents(0.3);
  REQUIRE(desktop.window->grab().save(QString::fromStdString(file.string()), "PNG"));
}

} // namespace

TEST_CASE("A diagram of texts has the commonest state of each point and what share of the seeds disagrees",
          "[desktop][sweep]") {
  const SweepData data = table();
  const SweepChoice first = desktop::firstChoice(data);
  CHECK(first.x == 0);
  CHECK(first.y == 1);
  CHECK(first.colour == 3); // the state
  const auto diagram = desktop::diagramOf(data, {0, 1, 3, {{2, "linear"}}});
  REQUIRE(diagram.spots.size() == 3); // the law that is held leaves one point out
  REQUIRE(diagram.classes.size() == 6);
  CHECK(diagram.classes[static_cast<std::size_t>(spotOf(diagram, 1).shownClass)] == "flat");
  CHECK(spotOf(diagram, 1).disagreement == 0);
  CHECK(spotOf(diagram, 2).disagreement == 0.5);
  CHECK(spotOf(diagram, 2).classes.size() == 2);
  CHECK(diagram.classes[static_cast<std::size_t>(spotOf(diagram, 3).shownClass)] == "large spout");
  // Omega_c = 10 r here; omega is a rate.
  CHECK(diagram.critical == std::vector<std::pair<double, double>>{{4, 40}, {6, 60}});
  // Across and up exchanged, the curve is as well.
  CHECK(desktop::diagramOf(data, {1, 0, 3, {{2, "linear"}}}).critical ==
        std::vector<std::pair<double, double>>{{40, 4}, {60, 6}});
  CHECK(desktop::diagramOf(data, {0, 4, 3, {}}).critical.empty()); // a time is no rate
}

TEST_CASE("A diagram of numbers has means and deviations; failed runs are told apart", "[desktop][sweep]") {
  const SweepData data = table();
  const auto diagram = desktop::diagramOf(data, {0, 1, 4, {}});
  REQUIRE(diagram.spots.size() == 4);
  CHECK(diagram.classes.empty());
  CHECK(diagram.low == 1);
  CHECK(diagram.high == 5);
  CHECK(spotOf(diagram, 2).value == 2.5);
  CHECK(spotOf(diagram, 2).deviation == Approx(std::sqrt(0.5)));
  CHECK(spotOf(diagram, 2).disagreement == Approx(std::sqrt(0.5) / 4));
  CHECK(spotOf(diagram, 1).deviation == 0);
  CHECK(spotOf(diagram, 4).failed);
  CHECK_FALSE(spotOf(diagram, 4).done);
  CHECK(std::isnan(spotOf(diagram, 4).value));
}

TEST_CASE("A point of a sweep is clicked, shows what was kept, and opens as a run with the same bits",
          "[desktop][sweep]") {
  TemporaryFolder folder("desktop-sweep");
  writeBed(folder / "bed.toml", 4, 4, 0.05);
  std::ofstream(folder / "SWEEP.toml") << R"(
title = "Beds"
scene = "bed.toml"
seeds = 2
[[axis]]
name = "t"
key = "stage.settle.until.duration"
unit = "ms"
values = [10, 20, 30]
[[axis]]
name = "gap"
key = "fill.1.spacing"
unit = "mm"
values = [2.02, 3]
)";
  REQUIRE(std::system(fmt::format("'{}' sweep '{}' -o '{}' >'{}' 2>&1", SANDGLASS_PROGRAM,
                                  (folder / "SWEEP.toml").string(), (folder / "beds").string(),
                                  (folder / "out.txt").string())
                          .c_str()) == 0);
  Desktop desktop(folder / "unused");
  desktop.window->resize(1440, 900);
  REQUIRE(desktop.open(folder / "beds"));
  REQUIRE(desktop.window->bannerText().toStdString() == "");
  auto* panel = desktop.child<desktop::SweepPanel>("sweepPanel");
  REQUIRE(panel->isVisible());
  auto* diagram = panel->diagram();
  REQUIRE(diagram->diagram().spots.size() == 6);
  const auto settled = [&] { return waitFor([&] { return desktop.window->isSettled(); }); };

  // Columns are chosen with keys.
  desktop.choose("sweepX", "gap");
  desktop.choose("sweepY", "t");
  desktop.choose("sweepColour", "energy.translational");
  const auto choice = panel->choice();
  REQUIRE(panel->sweep()->columns[choice.x].name == "gap");
  REQUIRE(panel->sweep()->columns[choice.y].name == "t");
  REQUIRE(diagram->diagram().high > diagram->diagram().low);

  // A click on the mark of each point chooses that one.
  for (const auto& spot : diagram->diagram().spots) {
    QTest::mouseClick(diagram, Qt::LeftButton, {}, diagram->placeOf(spot.point));
    REQUIRE(diagram->chosen() == spot.point);
  }
  const int point = diagram->chosen();
  REQUIRE(settled());
  REQUIRE(waitFor([&] { return desktop.window->shownFrame() != nullptr && desktop.window->isSettled(); }));
  const analysis::SweepTable kept(folder / "beds");
  auto* values = desktop.child<QTreeWidget>("pointValues");
  REQUIRE(values->topLevelItemCount() == static_cast<int>(kept.columns().size()));
  auto* seeds = desktop.child<QComboBox>("pointSeed");
  REQUIRE(seeds->count() == 2);
  desktop.choose("pointSeed", seeds->itemText(1));
  REQUIRE(settled());
  const int run = desktop.child<desktop::PointPanel>("pointPanel")->run();
  REQUIRE(kept.row(run).point == point);
  REQUIRE(kept.row(run).replicate == 2);
  REQUIRE(waitFor([&] {
    return desktop.window->shownFrame() &&
           sameBits(desktop.window->shownFrame()->position, kept.lastFrame(run)->position);
  }));
  REQUIRE(desktop.child<desktop::ChartPanel>("point")->curve().has_value());
  keepPicture(desktop, folder / "sweep.png", "sweep_points.png");

  // Arrows go from mark to mark, and back.
  diagram->setFocus();
  const auto arrow = [&](Qt::Key key) {
    QTest::keyClick(diagram, key);
    return diagram->chosen();
  };
  const int before = diagram->chosen();
  const int left = arrow(Qt::Key_Left);
  REQUIRE(left != before);
  REQUIRE(arrow(Qt::Key_Right) == before);
  desktop.choose("pointSeed", seeds->itemText(1));
  REQUIRE(settled());

  // The run behind it is computed again, with its frames, in a tab of its own.
  QTest::mouseClick(desktop.child<QPushButton>("sweepOpen"), Qt::LeftButton);
  REQUIRE(desktop.window->tabs() == 2);
  REQUIRE(waitFor([&] { return desktop.session().progress() && !desktop.session().runs(); }));
  REQUIRE(desktop.window->bannerText().toStdString() == "");
  REQUIRE_FALSE(panel->isVisible());
  const auto frames = openFrames(desktop.session().current().runFolder);
  const FramePtr last = frames->load(frames->size() - 1), known = kept.lastFrame(run);
  REQUIRE(last->step == known->step);
  REQUIRE(last->id == known->id);
  REQUIRE(sameBits(last->position, known->position));
  REQUIRE(sameBits(last->vector(quantity::velocity), known->vector(quantity::velocity)));

  // The second time its frames are there.
  desktop.window->showTab(0);
  REQUIRE(settled());
  REQUIRE(panel->isVisible());
  const int again = point;
  QTest::mouseDClick(diagram, Qt::LeftButton, {}, diagram->placeOf(again));
  REQUIRE(desktop.window->tabs() == 3);
  REQUIRE(waitFor([&] { return desktop.session().isOpen() && !desktop.session().isOpening(); }));
}

TEST_CASE(
    "The panel of states tells the state of a vortex, its evidence and its thresholds, and the map beside it",
    "[desktop][states]") {
  TemporaryFolder folder("desktop-states");
  const std::string set = "--set 'stage.stir.until.duration=\"0.6 s\"'";
  REQUIRE(std::system(fmt::format("'{}' run '{}/sample_runs/vortex_tank' {} -o '{}' >'{}' 2>&1",
                                  SANDGLASS_PROGRAM, SANDGLASS_SOURCE_DIR, set, (folder / "run").string(),
                                  (folder / "out.txt").string())
                          .c_str()) == 0);
  Desktop desktop(folder / "unused");
  desktop.window->resize(1440, 900);
  REQUIRE(desktop.open(folder / "run"));
  REQUIRE(waitFor([&] { return desktop.window->isSettled() && desktop.window->shownFrame(); }));
  desktop.key(Qt::Key_0, Qt::AltModifier);
  auto* panel = desktop.child<desktop::StatePanel>("statePanel");
  REQUIRE(waitFor([&] { return panel->isVisible() && !panel->sentence().isEmpty(); }));
  INFO(panel->sentence().toStdString());
  CHECK(panel->sentence().contains("vortex: "));
  CHECK(panel->sentence().contains("confidence"));
  CHECK(panel->sentence().contains("% solid"));
  auto* evidence = desktop.child<QTreeWidget>("evidence");
  QStringList tables, rows;
  for (int k = 0; k < evidence->topLevelItemCount(); ++k) {
    tables << evidence->topLevelItem(k)->text(0);
    for (int r = 0; r < evidence->topLevelItem(k)->childCount(); ++r)
      rows << evidence->topLevelItem(k)->child(r)->text(0);
  }
  for (const char* rules :
       {"own", "text", "listed", "settled", "fluid", "pinned", "threshold settle_drift", "gas_inertia"}) {
    INFO(rules << " in " << rows.join(", ").toStdString());
    bool found = false;
    for (const auto& row : rows)
      found = found || row.contains(rules);
    CHECK(found);
  }
  keepPicture(desktop, folder / "evidence.png", "state_evidence.png");
  auto* pages = desktop.child<QTabWidget>("statePages");
  QTest::mouseClick(pages->tabBar(), Qt::LeftButton, {}, pages->tabBar()->tabRect(1).center());
  REQUIRE(panel->chart()->isVisible());
  REQUIRE(waitFor([&] { return panel->chart()->charts() > 0 && desktop.window->isSettled(); }));
  keepPicture(desktop, folder / "states.png", "states.png");
}
