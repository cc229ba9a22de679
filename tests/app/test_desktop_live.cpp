// What changes while a run goes on, branches, undo, tabs and sessions.

#include "desktop_harness.h"

#include "app/desktop/chart_panel.h"
#include "app/desktop/scene_panel.h"
#include "app/desktop/view_panel.h"
#include "sim/io/run_folder.h"
#include "tests/sim/frame_equality.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPointer>
#include <QPushButton>

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;

namespace {

bool settled(Desktop& desktop) {
  return waitFor([&] { return desktop.window->isSettled(); });
}

/// Waits until the run that goes on has gone on for so long [s].
bool runsFor(Desktop& desktop, double duration) {
  const auto time = [&] { return desktop.session().liveFrame() ? desktop.session().liveFrame()->time : 0; };
  const double from = time();
  return waitFor([&] { return time() > from + duration; });
}

void type(QLineEdit* line, const QString& text) {
  line->setFocus();
  line->selectAll();
  QTest::keyClicks(line, text);
}

} // namespace

TEST_CASE("Gravity set by the button while it runs is in the scene, which gives the same bits again",
          "[desktop]") {
  TemporaryFolder folder("desktop-live");
  {
    Desktop desktop(folder / "live");
    REQUIRE(desktop.open(writeBed(folder / "bed.toml", 8, 8, endless)));
    desktop.key(Qt::Key_F5);
    REQUIRE(runsFor(desktop, 0.01));
    desktop.child<QDoubleSpinBox>("gravity.x")->setValue(4);
    QTest::mouseClick(desktop.child<QPushButton>("applyGravity"), Qt::LeftButton);
    const auto& events = desktop.session().current().scene->events;
    REQUIRE(waitFor([&] { return events.size() == 1; }));
    REQUIRE(runsFor(desktop, 0.05));
    desktop.key(Qt::Key_E, Qt::ShiftModifier);
    REQUIRE(waitFor([&] { return desktop.session().progress() && !desktop.session().runs(); }));
    REQUIRE(events.size() == 2); // and the end of the stage
    REQUIRE(events[0].gravity->x() == 4);
    REQUIRE(desktop.child<QLabel>("events")->text().contains("gravity (4, "));
    REQUIRE(desktop.window->bannerText().toStdString() == "");
  }
  RunOptions options;
  options.folder = folder / "again";
  options.threads = 2;
  Run(readScene((folder / "live" / "scene.toml").string()), options).execute();
  const auto live = openFrames(folder / "live"), again = openFrames(folder / "again");
  REQUIRE(live->size() == again->size());
  for (std::size_t k = 0; k < live->size(); ++k) {
    Frame a = *live->load(k), b = *again->load(k);
    a.provenance.erase("scene"); // changed with the first event
    b.provenance.erase("scene");
    requireEqual(a, b);
  }
}

TEST_CASE("The strength of a wind set by keys and mouse is in the scene, which gives the same bits again",
          "[desktop]") {
  TemporaryFolder folder("desktop-wind");
  const auto scene = writeBed(folder / "bed.toml", 8, 8, endless);
  std::ofstream(scene, std::ios::app) << R"fields(
[[field]]
name = "breeze"
kind = "wind"
velocity = ["2 m/s", "0 m/s", "0 m/s"]
[[field]]
name = "drag"
kind = "drag"
law = "linear"
linear_coefficient = "1e-4 kg/(m*s)"
)fields";
  std::int64_t changed = 0;
  EventSpec end;
  {
    Desktop desktop(folder / "live");
    REQUIRE(desktop.open(scene));
    auto* apply = desktop.child<QPushButton>("applyField");
    REQUIRE_FALSE(apply->isEnabled()); // nothing runs
    desktop.key(Qt::Key_2, Qt::ControlModifier);
    desktop.key(Qt::Key_F5);
    REQUIRE(runsFor(desktop, 0.01));
    desktop.choose("fieldToChange", "breeze");
    desktop.type("fieldFactor", "-3");
    desktop.click("applyField");
    const auto& events = desktop.session().current().scene->events;
    REQUIRE(waitFor([&] { return events.size() == 1; }));
    REQUIRE(runsFor(desktop, 0.05));
    desktop.click("endStage");
    REQUIRE(waitFor([&] { return desktop.session().progress() && !desktop.session().runs(); }));
    REQUIRE(events.size() == 2);
    end = events[1];
    REQUIRE(end.endStage);
    REQUIRE(events[0].fields.size() == 1);
    CHECK(events[0].fields[0].field == "breeze");
    CHECK(events[0].fields[0].factor == -3);
    changed = events[0].step;
    CHECK(desktop.child<QLabel>("events")->text().contains("field breeze at -3 times its strength"));
    CHECK(desktop.child<QPlainTextEdit>("sceneText")->toPlainText().contains("breeze"));
    CHECK(desktop.window->bannerText().toStdString() == "");
  }
  RunOptions options;
  options.folder = folder / "again";
  options.threads = 2;
  Run(readScene((folder / "live" / "scene.toml").string()), options).execute();
  options.folder = folder / "calm";
  Scene unchanged = readScene(scene.string());
  unchanged.events = {end};
  Run(unchanged, options).execute();
  const auto live = openFrames(folder / "live"), again = openFrames(folder / "again"),
             calm = openFrames(folder / "calm");
  REQUIRE(live->size() == again->size());
  REQUIRE(live->size() == calm->size());
  double reverse = 0;
  for (std::size_t k = 0; k < live->size(); ++k) {
    Frame a = *live->load(k), b = *again->load(k);
    a.provenance.erase("scene"); // changed with the first event
    b.provenance.erase("scene");
    requireEqual(a, b);
    const FramePtr still = calm->load(k);
    if (a.step <= changed) CHECK(sameBits(a.position, still->position));
    for (std::size_t i = 0; i < a.size(); ++i)
      reverse += still->position[i].x() - a.position[i].x();
  }
  CHECK(reverse > 0); // blown the other way
}

TEST_CASE("A branch goes on from the frame shown, in a tab of its own, paused there", "[desktop]") {
  TemporaryFolder folder("desktop-branch");
  {
    RunOptions options;
    options.folder = folder / "run";
    options.threads = 1;
    Run(readScene(writeBed(folder / "bed.toml", 6, 6, 0.1).string()), options).execute();
  }
  Desktop desktop(folder / "unused");
  REQUIRE(desktop.open(folder / "run"));
  desktop.window->showTime(0.06);
  REQUIRE(waitFor([&] {
    return desktop.window->shownFrame() && desktop.window->shownFrame()->time > 0.059 &&
           desktop.window->shownFrame()->time < 0.061;
  }));
  const FramePtr from = desktop.window->shownFrame();
  desktop.key(Qt::Key_B);
  REQUIRE(desktop.window->tabs() == 2);
  REQUIRE(waitFor([&] {
    return desktop.session().runs() && desktop.session().isPaused() && desktop.session().liveFrame() &&
           desktop.session().liveFrame()->step == from->step;
  }));
  Frame live = *desktop.session().liveFrame();
  REQUIRE(sameBits(live.position, from->position));
  REQUIRE(waitFor([&] { return desktop.window->commands().action("run.start")->text() == "&Go on"; }));
  QTest::mouseClick(desktop.child<QPushButton>("applyGravity"), Qt::LeftButton);
  desktop.key(Qt::Key_Space);
  REQUIRE(waitFor([&] { return !desktop.session().runs(); }));
  REQUIRE(desktop.session().current().runFolder == folder / "run-branch");
  REQUIRE(openFrames(folder / "run-branch")->size() == 21);
  REQUIRE(openFrames(folder / "run")->size() == 21); // nothing of the source is gone
  desktop.key(Qt::Key_W, Qt::ControlModifier);
  REQUIRE(desktop.window->tabs() == 1);
  REQUIRE(desktop.session().current().runFolder == folder / "run");
}

TEST_CASE("A field edited in the form shows at once, is undone, and a fault stands at its field",
          "[desktop]") {
  TemporaryFolder folder("desktop-form");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 6, 6, 0.05)));
  REQUIRE(settled(desktop));
  REQUIRE(waitFor([&] { return desktop.window->shownFrame() != nullptr; }));
  const std::size_t grains = desktop.window->shownFrame()->size(); // of the preview
  REQUIRE(grains > 100);
  const auto text = [&] { return desktop.child<QPlainTextEdit>("sceneText")->toPlainText(); };
  const QString before = text();
  auto* spacing = desktop.child<QLineEdit>("field.fill.1.spacing");
  type(spacing, "4.04 mm");
  REQUIRE(text().contains("spacing = \"4.04 mm\""));
  REQUIRE(waitFor(
      [&] { return desktop.window->isSettled() && desktop.window->shownFrame()->size() < grains / 4; }));
  type(spacing, "fast");
  REQUIRE(settled(desktop));
  REQUIRE(desktop.child<desktop::ScenePanel>("scene")->faults().size() == 1);
  bool atField = false;
  for (auto* label : desktop.child<QWidget>("sceneForm")->findChildren<QLabel*>())
    atField = atField || (label->isVisibleTo(desktop.window.get()) &&
                          label->text().contains("fill.1.spacing is \"fast\""));
  REQUIRE(atField);
  desktop.window->setFocus();
  desktop.key(Qt::Key_F5); // nothing runs that is not what is written
  REQUIRE_FALSE(desktop.session().runs());
  REQUIRE(desktop.window->bannerText().contains("spacing"));
  REQUIRE(desktop.undoUntil([&] { return text() == before; }));
  REQUIRE(
      waitFor([&] { return desktop.window->isSettled() && desktop.window->shownFrame()->size() == grains; }));
  desktop.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  REQUIRE(text() != before);
}

TEST_CASE("A letter that gives the form another key ends before its field goes", "[desktop]") {
  TemporaryFolder folder("desktop-new-key");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 4, 4, 0.05)));
  REQUIRE(settled(desktop));
  desktop.click("allKeys");
  REQUIRE(settled(desktop));
  QLineEdit* left = nullptr; // of a key that is not given
  for (auto* line : desktop.child<QWidget>("sceneForm")->findChildren<QLineEdit*>())
    if (!left && line->text().isEmpty() && !line->placeholderText().isEmpty()) left = line;
  REQUIRE(left);
  const QString name = left->objectName();
  left->setFocus();
  const QPointer<QLineEdit> before = left;
  QTest::keyClick(left, Qt::Key_1);
  CHECK(before); // it still handles the key
  REQUIRE(settled(desktop));
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete); // as an event loop does
  CHECK_FALSE(before);
  CHECK(desktop.child<QLineEdit>(name.toUtf8().constData())->text() == "1");
}

TEST_CASE("Views are undone and redone", "[desktop]") {
  TemporaryFolder folder("desktop-undo");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 5, 5, 0.05)));
  REQUIRE(waitFor([&] { return desktop.window->isSettled() && desktop.window->shownFrame(); }));
  const QImage before = desktop.picture().image();
  QTest::mouseClick(desktop.child<QCheckBox>("clip"), Qt::LeftButton, {}, QPoint(8, 8));
  REQUIRE(settled(desktop));
  const QImage clipped = desktop.picture().image();
  REQUIRE(clipped != before);
  desktop.key(Qt::Key_Z, Qt::ControlModifier);
  REQUIRE(settled(desktop));
  REQUIRE_FALSE(desktop.child<QCheckBox>("clip")->isChecked());
  REQUIRE(desktop.picture().image() == before);
  desktop.key(Qt::Key_Y, Qt::ControlModifier);
  REQUIRE(settled(desktop));
  REQUIRE(desktop.picture().image() == clipped);
}

TEST_CASE("A session brings tabs, views, moments and edits back", "[desktop]") {
  TemporaryFolder folder("desktop-session");
  {
    RunOptions options;
    options.folder = folder / "run";
    options.threads = 1;
    Run(readScene(writeBed(folder / "bed.toml", 5, 5, 0.05).string()), options).execute();
  }
  const auto file = QString::fromStdString((folder / "work.sandglass").string());
  vis::View view;
  {
    Desktop desktop(folder / "unused");
    REQUIRE(desktop.open(folder / "run"));
    desktop.window->showTime(0.02);
    desktop.key(Qt::Key_Right, Qt::ControlModifier);
    REQUIRE(settled(desktop));
    desktop.key(Qt::Key_Right, Qt::ControlModifier);
    REQUIRE(settled(desktop));
    view = desktop.window->view();
    desktop.key(Qt::Key_T, Qt::ControlModifier);
    REQUIRE(desktop.window->tabs() == 2);
    REQUIRE(desktop.open(folder / "bed.toml"));
    REQUIRE(settled(desktop));
    type(desktop.child<QLineEdit>("field.seed"), "12");
    REQUIRE(settled(desktop));
    desktop.window->showTab(0);
    REQUIRE(settled(desktop));
    desktop.window->saveSession(file);
  }
  Desktop desktop(folder / "unused");
  desktop.window->open(file);
  REQUIRE(desktop.window->tabs() == 2);
  REQUIRE(waitFor([&] {
    return desktop.window->isSettled() && desktop.window->shownFrame() &&
           desktop.window->shownFrame()->time == Approx(0.02);
  }));
  REQUIRE((desktop.window->view().camera.position - view.camera.position).norm() < 1e-12);
  desktop.window->showTab(1);
  REQUIRE(waitFor([&] { return desktop.session().isOpen() && desktop.window->isSettled(); }));
  REQUIRE(desktop.child<QPlainTextEdit>("sceneText")->toPlainText().contains("seed = 12"));
}

TEST_CASE("A picture whose run is gone says which", "[desktop]") {
  TemporaryFolder folder("desktop-gone");
  vis::writePng({2, 2, std::vector<std::uint8_t>(16, 255)}, folder / "p.png",
                {{"source", (folder / "moved").string()}, {"view", vis::writeView({})}});
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(folder / "p.png"));
  REQUIRE(desktop.window->bannerText().contains(QString::fromStdString((folder / "moved").string())));
}

TEST_CASE("Closing with a run going asks, and keeps it when the answer is no", "[desktop]") {
  TemporaryFolder folder("desktop-asks");
  application();
  desktop::WindowOptions options;
  options.session.folder = folder / "run";
  options.session.threads = 1;
  desktop::MainWindow window(options);
  window.show();
  QApplication::setActiveWindow(&window);
  window.open(QString::fromStdString(writeBed(folder / "bed.toml", 6, 6, endless).string()));
  REQUIRE(waitFor([&] { return window.session().isOpen() && !window.session().isOpening(); }));
  QTest::keyClick(&window, Qt::Key_F5);
  REQUIRE(waitFor([&] { return window.session().liveFrame() != nullptr; }));
  int asked = 0;
  const auto answer = [&](QMessageBox::StandardButton button) {
    auto* look = new QTimer(&window); // again and again: a busy machine takes its time to show a box
    QObject::connect(look, &QTimer::timeout, look, [&asked, button, look] {
      for (auto* widget : QApplication::topLevelWidgets())
        if (auto* box = qobject_cast<QMessageBox*>(widget); box && box->isVisible()) {
          ++asked;
          look->deleteLater();
          look->stop();
          QTest::mouseClick(box->button(button), Qt::LeftButton);
          return;
        }
    });
    look->start(100);
  };
  answer(QMessageBox::Cancel);
  window.close();
  REQUIRE(asked == 1);
  REQUIRE(window.isVisible());
  REQUIRE(window.session().runs());
  answer(QMessageBox::Close);
  window.close();
  REQUIRE(asked == 2);
  REQUIRE_FALSE(window.session().runs());
  REQUIRE(desktop::hasCheckpoint(folder / "run"));
}
