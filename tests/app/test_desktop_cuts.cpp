// Cuts by box and cylinder and slices through fields, typed and clicked in the view panel.

#include "desktop_harness.h"

#include "sim/io/run_folder.h"

#include <QLabel>
#include <QLineEdit>
#include <QTreeWidget>

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace sandglass;
using namespace sandglass::test;

namespace {

/// A run of a bed of beads, opened, and whether what is done to it changes the picture.
class Opened {
public:
  Opened() : folder_("desktop-cuts") {
    RunOptions options;
    options.folder = folder_ / "run";
    options.threads = 1;
    Run(readScene(writeBed(folder_ / "bed.toml", 6, 6, 0.05).string()), options).execute();
    desktop = std::make_unique<Desktop>(folder_ / "unused");
    desktop->window->resize(1440, 900);
    REQUIRE(desktop->open(folder_ / "run"));
    settle();
    last_ = desktop->picture().image();
  }
  bool changed() {
    settle();
    const QImage before = std::exchange(last_, desktop->picture().image());
    return before != last_;
  }
  const vis::View& view() const { return desktop->window->view(); }
  QString fault(const char* name) {
    auto* label = desktop->child<QLabel>(name);
    return label->isVisibleTo(desktop->window.get()) ? label->text() : QString();
  }
  void keepPicture(const char* file) {
    const char* folder = std::getenv("SANDGLASS_PICTURES");
    const auto whole = folder ? std::filesystem::absolute(folder) / file : folder_ / file;
    handleEvents(0.3);
    REQUIRE(desktop->window->grab().save(QString::fromStdString(whole.string()), "PNG"));
  }

  std::unique_ptr<Desktop> desktop;

private:
  void settle() {
    REQUIRE(waitFor([&] { return desktop->window->isSettled() && desktop->window->shownFrame(); }));
    REQUIRE(desktop->window->bannerText().toStdString() == "");
  }
  TemporaryFolder folder_;
  QImage last_;
};

} // namespace

TEST_CASE("A box and a cylinder cut the picture as they are typed; what is wrong stands at its field",
          "[desktop][cuts]") {
  Opened opened;
  Desktop& desktop = *opened.desktop;
  desktop.click("clipBox");
  REQUIRE(opened.view().clipBoxes.size() == 1);
  REQUIRE(opened.view().clipBoxes[0].inside);
  REQUIRE(opened.changed());
  desktop.type("clipBoxLower", "-1 cm, 0, -1 cm");
  desktop.type("clipBoxUpper", "1 cm, 10 mm, 0.004");
  REQUIRE(opened.view().clipBoxes[0].lower == Vec3(-0.01, 0, -0.01));
  REQUIRE(opened.view().clipBoxes[0].upper == Vec3(0.01, 0.01, 0.004));
  REQUIRE(opened.changed());

  for (const auto& [text, part] : {std::pair{"1 cm, 1 cm, fast", "\"fast\" is no length"},
                                   {"1 cm, 1 cm", "3 numbers with commas are due"},
                                   {"1 cm, -1 cm, 1 cm", "above that of the lower corner"}}) {
    desktop.type("clipBoxUpper", text);
    INFO(opened.fault("clipBoxUpper.fault").toStdString());
    REQUIRE(opened.fault("clipBoxUpper.fault").contains(part));
    REQUIRE(opened.view().clipBoxes[0].upper == Vec3(0.01, 0.01, 0.004)); // the last sound one
    REQUIRE_FALSE(opened.changed());
  }
  desktop.type("clipBoxLower", "-1 cm, -2 cm, -1 cm"); // and the upper corner is above it again
  REQUIRE(opened.fault("clipBoxUpper.fault").isEmpty());
  REQUIRE(opened.view().clipBoxes[0].upper == Vec3(0.01, -0.01, 0.01));
  desktop.type("clipBoxUpper", "1 cm, 0, 1 cm");
  REQUIRE(opened.changed());
  desktop.click("clipBoxOutside");
  REQUIRE_FALSE(opened.view().clipBoxes[0].inside);
  REQUIRE(opened.changed());

  desktop.click("clipCylinder");
  desktop.type("clipCylinderAxis", "0, 0, 0");
  REQUIRE(opened.fault("clipCylinderAxis.fault").contains("direction"));
  desktop.type("clipCylinderAxis", "0, 0, 1");
  desktop.type("clipCylinderPoint", "0, 0, 0");
  desktop.type("clipCylinderRadius", "-1 mm");
  REQUIRE(opened.fault("clipCylinderRadius.fault").contains("above 0"));
  desktop.type("clipCylinderRadius", "4.5 mm");
  REQUIRE(opened.view().clipCylinders.size() == 1);
  REQUIRE(opened.view().clipCylinders[0].radius == 4.5e-3);
  REQUIRE(opened.changed());
  opened.keepPicture("cuts.png");

  desktop.window->setFocus();
  REQUIRE(desktop.undoUntil([&] { return opened.view().clipBoxes.empty(); }));
  REQUIRE(opened.view().clipCylinders.empty());
  REQUIRE_FALSE(desktop.child<QAbstractButton>("clipBox")->isChecked());
}

TEST_CASE("A slice through averages over the grains is chosen by keys and mouse", "[desktop][cuts]") {
  Opened opened;
  Desktop& desktop = *opened.desktop;
  desktop.click("slice");
  desktop.click("showGrains");
  REQUIRE(opened.view().slice.shown);
  REQUIRE_FALSE(opened.view().grains);
  REQUIRE(opened.changed());
  desktop.choose("sliceQuantity", "velocity.z");
  REQUIRE(opened.view().slice.quantity == "velocity.z");
  REQUIRE(opened.changed());
  desktop.slide("slicePlace", 150);
  REQUIRE(opened.changed());
  desktop.choose("sliceAxis", "across x");
  REQUIRE(opened.view().slice.normal == Vec3::UnitX());
  REQUIRE(opened.changed());
  desktop.type("sliceRange", "0.1, -0.1");
  REQUIRE(opened.fault("sliceRange.fault").contains("high must be above low"));
  REQUIRE(opened.view().slice.range == vis::ColourRange::frame);
  desktop.type("sliceRange", "-0.02, 0.02");
  REQUIRE(opened.view().slice.range == vis::ColourRange::fixed);
  REQUIRE(opened.view().slice.high == 0.02);
  REQUIRE(opened.changed());
  desktop.click("streamlines");
  REQUIRE(opened.changed());
  opened.keepPicture("slice.png");
  desktop.click("slice");
  desktop.click("showGrains");
  REQUIRE(opened.changed());
}

TEST_CASE("A rectangle drawn with the mouse chooses grains, by the clip too, and is undone",
          "[desktop][cuts]") {
  Opened opened;
  Desktop& desktop = *opened.desktop;
  auto& picture = desktop.picture();
  const auto rectangle = [&](QPoint from, QPoint to) {
    QTest::mousePress(&picture, Qt::LeftButton, Qt::ControlModifier, from);
    for (const QPoint at : {(from + to) / 2, to}) {
      QMouseEvent move(QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton, Qt::ControlModifier);
      QCoreApplication::sendEvent(&picture, &move);
    }
    QTest::mouseRelease(&picture, Qt::LeftButton, Qt::ControlModifier, to);
  };
  const QPoint corner(picture.width() - 1, picture.height() - 1),
      middle(picture.width() / 2, picture.height() - 1);
  const auto& chosen = opened.view().selection.grains;
  const vis::Camera before = opened.view().camera;
  const std::size_t all = desktop.window->shownFrame()->size();
  rectangle({1, 1}, corner);
  waitFor([&] { return chosen.size() == all; });
  INFO(desktop.window->bannerText().toStdString());
  REQUIRE(chosen.size() == all);                           // all of them, hidden ones too
  CHECK(opened.view().camera.position == before.position); // the camera stays
  rectangle({1, 1}, middle);
  REQUIRE(waitFor([&] { return chosen.size() < all; }));
  CHECK(chosen.size() > 20);
  CHECK(opened.changed()); // the others are pale
  const auto left = chosen;
  auto* values = desktop.child<QTreeWidget>("grainValues");
  CHECK(values->topLevelItem(0)->text(1) == QString::number(left.size()));
  desktop.click("clip");
  REQUIRE(opened.changed());
  rectangle({1, 1}, corner);
  REQUIRE(waitFor([&] { return chosen != left; }));
  const Frame& frame = *desktop.window->shownFrame();
  const auto& plane = opened.view().clips.front();
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const bool kept = (frame.position[k] - plane.point).dot(plane.normal) >= 0;
    CHECK(kept == std::binary_search(chosen.begin(), chosen.end(), frame.id[k]));
  }
  REQUIRE(waitFor([&] { return desktop.window->isSettled(); }));
  desktop.window->setFocus();
  desktop.key(Qt::Key_Escape);
  CHECK(chosen.empty());
  desktop.key(Qt::Key_Z, Qt::ControlModifier);
  CHECK_FALSE(chosen.empty());
}
