// The dialog that maps the columns of other programs' files, with real keys and clicks.

#include "desktop_harness.h"

#include "app/desktop/import_dialog.h"

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace sandglass;
using namespace sandglass::test;

namespace {

desktop::ImportDialog* dialogOf(Desktop& desktop) {
  auto* dialog = desktop.window->findChild<desktop::ImportDialog*>();
  return dialog && dialog->isVisible() ? dialog : nullptr;
}

bool tried(Desktop& desktop) {
  return waitFor([&] { return dialogOf(desktop) && dialogOf(desktop)->isSettled(); });
}

} // namespace

TEST_CASE("A file whose columns nobody knows opens once they are chosen by hand, and again by itself",
          "[desktop][import]") {
  TemporaryFolder folder("desktop-import");
  const auto file = folder / "lab.csv";
  std::ofstream(file) << "px;py;pz;size;U0;U1;U2;spin rate\n"
                         "0;0;0;2;1;0;0;7\n"
                         "4;0;0;2;1;0;0;8\n"
                         "0;4;0;3;1;0;0;9\n";
  {
    Desktop desktop(folder / "unused");
    REQUIRE(desktop.open(file));
    // A sentence, and the way out beside it.
    REQUIRE(tried(desktop));
    CHECK(desktop.window->bannerText().contains("position along x"));
    CHECK(desktop.child<QLabel>("importReason")->text().contains("position along x"));
    CHECK(desktop.child<QTableWidget>("importColumns")->rowCount() == 8);
    CHECK(desktop.child<QTableWidget>("importColumns")->item(3, 1)->text() == "2 to 3");
    CHECK_FALSE(dialogOf(desktop)->isSound());
    CHECK_FALSE(desktop.child<QPushButton>("importSave")->isEnabled());

    desktop.choose("meaning.px", "position along x");
    desktop.choose("meaning.py", "position along y");
    desktop.choose("meaning.pz", "position along z");
    REQUIRE(tried(desktop));
    INFO(dialogOf(desktop)->verdict().toStdString());
    CHECK(dialogOf(desktop)->isSound());
    CHECK(dialogOf(desktop)->verdict().contains("Missing: radii"));
    desktop.choose("meaning.size", "diameter");
    desktop.choose("importLength", "mm");
    desktop.choose("meaning.U0", "velocity, x");
    desktop.choose("meaning.U1", "velocity, y");
    desktop.choose("meaning.U2", "velocity, z");
    REQUIRE(tried(desktop));
    CHECK(dialogOf(desktop)->verdict().contains("3 grains"));
    CHECK(dialogOf(desktop)->verdict().contains("radius 1 to 1.5 mm"));
    CHECK(dialogOf(desktop)->verdict().contains("velocity"));

    // Two columns for one quantity, and a box upside down, are sentences; nothing can be saved meanwhile.
    desktop.choose("meaning.U2", "velocity, y");
    REQUIRE(tried(desktop));
    CHECK(dialogOf(desktop)->verdict().contains("both 'U1' and 'U2'"));
    CHECK_FALSE(desktop.child<QPushButton>("importSave")->isEnabled());
    desktop.choose("meaning.U2", "velocity, z");
    auto* lower = desktop.child<QLineEdit>("importLower");
    lower->setFocus();
    QTest::keyClicks(lower, "0, 0, 0");
    REQUIRE(tried(desktop));
    CHECK(dialogOf(desktop)->verdict().contains("both corners"));
    auto* upper = desktop.child<QLineEdit>("importUpper");
    upper->setFocus();
    QTest::keyClicks(upper, "6 mm, 6 mm, 0.2 m");
    desktop.choose("importPeriodic", "xy");
    REQUIRE(tried(desktop));
    CHECK(dialogOf(desktop)->verdict().contains("6 by 6 by 200 mm"));
    if (const char* pictures = std::getenv("SANDGLASS_PICTURES")) {
      handleEvents(0.3);
      dialogOf(desktop)->grab().save(QString(pictures) + "/import_columns.png");
    }
    desktop.click("importSave");
    REQUIRE(waitFor([&] { return desktop.window->shownFrame() && desktop.window->isSettled(); }));
    CHECK(dialogOf(desktop) == nullptr);
    CHECK(desktop.window->bannerText().toStdString() == "");
    const FramePtr frame = desktop.window->shownFrame();
    REQUIRE(frame->size() == 3);
    CHECK(frame->position[1].x() == Approx(0.004));
    CHECK(frame->scalar(quantity::radius)[2] == Approx(0.0015));
    CHECK(frame->vector(quantity::velocity)[0].x() == Approx(1e-3)); // mm a second
    CHECK(frame->scalar("spin rate")[2] == 9);
    CHECK(frame->domain.periodic[1]);
  }
  REQUIRE(std::filesystem::exists(folder / "lab.csv.import.toml"));
  CHECK(openFrames(file)->load(0)->scalar(quantity::radius)[0] == Approx(1e-3));

  Desktop again(folder / "unused");
  REQUIRE(again.open(file));
  REQUIRE(waitFor([&] { return again.window->shownFrame() && again.window->isSettled(); }));
  CHECK(dialogOf(again) == nullptr);
  // By its command the dialog shows what was chosen, and takes a column out.
  again.key(Qt::Key_I, Qt::ControlModifier);
  REQUIRE(tried(again));
  CHECK(again.child<QComboBox>("meaning.size")->currentText() == "diameter");
  CHECK(again.child<QComboBox>("importLength")->currentText() == "mm");
  CHECK(again.child<QComboBox>("importPeriodic")->currentText() == "xy");
  again.choose("meaning.spin rate", "left out");
  REQUIRE(tried(again));
  QTest::keyClick(dialogOf(again), Qt::Key_Return);
  REQUIRE(waitFor([&] {
    return again.window->shownFrame() && again.window->isSettled() &&
           !again.window->shownFrame()->scalars.contains("spin rate");
  }));
}

TEST_CASE("A file without radii asks for one beside its picture", "[desktop][import]") {
  TemporaryFolder folder("desktop-radii");
  const auto file = folder / "beads.xyz";
  std::ofstream(file) << "2\nbeads\nA 0 0 0\nA 0.01 0 0\n";
  Desktop desktop(folder / "unused");
  REQUIRE(desktop.open(file));
  REQUIRE(waitFor([&] { return desktop.window->shownFrame() && desktop.window->isSettled(); }));
  REQUIRE(tried(desktop));
  CHECK(desktop.child<QLabel>("importReason")->text().contains("no radii"));
  auto* radius = desktop.child<QLineEdit>("importRadius");
  radius->setFocus();
  QTest::keyClicks(radius, "-3 mm");
  REQUIRE(tried(desktop));
  CHECK(dialogOf(desktop)->verdict().contains("must be above 0"));
  QTest::keyClick(radius, Qt::Key_Home);
  QTest::keyClick(radius, Qt::Key_Delete);
  REQUIRE(tried(desktop));
  CHECK(dialogOf(desktop)->verdict().contains("radius 3 mm"));
  desktop.click("importSave");
  REQUIRE(waitFor([&] {
    return desktop.window->shownFrame() && desktop.window->isSettled() &&
           desktop.window->shownFrame()->has(quantity::radius);
  }));
  CHECK(desktop.window->shownFrame()->scalar(quantity::radius)[1] == Approx(3e-3));
  CHECK(dialogOf(desktop) == nullptr);
}

TEST_CASE("What is no file of grains is refused without a dialog", "[desktop][import]") {
  TemporaryFolder folder("desktop-notes");
  std::ofstream(folder / "notes.txt") << "These are my notes.\n";
  Desktop desktop(folder / "unused");
  REQUIRE(desktop.open(folder / "notes.txt"));
  REQUIRE(waitFor([&] { return desktop.window->isSettled(); }));
  handleEvents(0.3);
  CHECK(desktop.window->bannerText().contains("none of the forms"));
  CHECK(dialogOf(desktop) == nullptr);
}
