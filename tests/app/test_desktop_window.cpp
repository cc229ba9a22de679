// The window under real key and mouse events, on the offscreen platform of Qt.

#include "desktop_harness.h"

#include "app/desktop/chart_panel.h"
#include "sim/io/run_folder.h"
#include "tests/sim/frame_equality.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QSlider>
#include <QWheelEvent>

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace sandglass;
using namespace sandglass::test;

namespace {

double timeShown(Desktop& desktop) {
  return desktop.window->shownFrame() ? desktop.window->shownFrame()->time : -1;
}

} // namespace

TEST_CASE("A scene is opened, run, paused, stepped, stopped and finished by keys", "[desktop]") {
  TemporaryFolder folder("desktop-keys");
  Desktop desktop(folder / "run");
  const auto scene = writeBed(folder / "bed.toml", 8, 8, endless);
  std::ofstream(scene, std::ios::app) << R"(
[[stage]]
name = "last"
until = { duration = "0.1 s" }
)";
  REQUIRE(desktop.open(scene));
  REQUIRE(desktop.window->bannerText().toStdString() == "");
  REQUIRE(desktop.window->windowTitle().startsWith("A bed of beads"));
  REQUIRE_FALSE(desktop.session().runs());

  desktop.key(Qt::Key_F5);
  REQUIRE(desktop.session().runs());
  REQUIRE(waitFor([&] { return timeShown(desktop) > 0; }));

  desktop.key(Qt::Key_Space);
  REQUIRE(desktop.session().isPaused());
  const auto paused = restingStep(desktop);
  REQUIRE(paused > 0);
  handleEvents(0.3);
  REQUIRE(desktop.session().liveFrame()->step == paused);

  desktop.key(Qt::Key_S);
  REQUIRE(waitFor([&] { return desktop.session().liveFrame()->step == paused + 1; }));
  desktop.key(Qt::Key_S, Qt::ShiftModifier);
  REQUIRE(waitFor([&] { return desktop.session().liveFrame()->step == paused + 101; }));
  handleEvents(0.3);
  REQUIRE(desktop.session().liveFrame()->step == paused + 101);

  desktop.key(Qt::Key_F5, Qt::ShiftModifier);
  REQUIRE(waitFor([&] { return !desktop.session().runs(); }));
  REQUIRE(desktop.session().current().canResume);
  REQUIRE(desktop.session().progress()->step == paused + 101);

  desktop.key(Qt::Key_F5); // goes on from the checkpoint
  REQUIRE(waitFor([&] { return desktop.session().liveFrame()->step > paused + 101; }));
  desktop.key(Qt::Key_E, Qt::ShiftModifier); // the last stage ends by itself
  REQUIRE(waitFor([&] { return !desktop.session().runs(); }));
  REQUIRE(desktop.session().progress()->fraction == 1);
  REQUIRE(desktop.window->bannerText().toStdString() == "");
  const double end = desktop.session().progress()->time;
  REQUIRE(waitFor([&] { return timeShown(desktop) == Approx(end).epsilon(1e-6); }));
  // A frame each 5 ms from the first step on, and one at the end.
  const auto frames = openFrames(folder / "run");
  REQUIRE(frames->size() == static_cast<std::size_t>(std::ceil(end / 5e-3 - 1e-6)) + 1);
  for (std::size_t k = 0; k + 1 < frames->size(); ++k)
    REQUIRE(std::abs(frames->time(k) - 5e-3 * static_cast<double>(k)) < 1e-4);
  REQUIRE(frames->time(frames->size() - 1) == Approx(end));
}

TEST_CASE("Mouse and keys move the camera, the slider moves in time", "[desktop]") {
  TemporaryFolder folder("desktop-mouse");
  {
    RunOptions options;
    options.folder = folder / "run";
    options.threads = 1;
    Run(readScene(writeBed(folder / "bed.toml", 6, 6, 0.05).string()), options).execute();
  }
  Desktop desktop(folder / "unused");
  REQUIRE(desktop.open(folder / "run"));
  auto& picture = desktop.picture();
  REQUIRE(waitFor([&] { return desktop.window->isSettled() && !picture.image().isNull(); }));
  REQUIRE(timeShown(desktop) == Approx(0.05).epsilon(1e-6)); // the last frame
  const QImage before = picture.image();
  const auto settle = [&] { return waitFor([&] { return desktop.window->isSettled(); }); };

  const QPoint middle = picture.rect().center();
  QTest::mousePress(&picture, Qt::LeftButton, {}, middle);
  for (int k = 1; k <= 10; ++k)
    QTest::mouseMove(&picture, middle + QPoint(12 * k, 3 * k));
  // QTest's moves carry no buttons on the offscreen platform; a real one does.
  QMouseEvent drag(QEvent::MouseMove, middle + QPoint(130, 30), Qt::NoButton, Qt::LeftButton, {});
  QCoreApplication::sendEvent(&picture, &drag);
  QTest::mouseRelease(&picture, Qt::LeftButton, {}, middle + QPoint(130, 30));
  REQUIRE(settle());
  REQUIRE(desktop.window->view().camera.preset.empty());
  REQUIRE(picture.image() != before);
  const vis::Camera turned = desktop.window->view().camera;

  QWheelEvent wheel(middle, picture.mapToGlobal(middle), {}, QPoint(0, 120), Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(&picture, &wheel);
  REQUIRE(settle());
  const auto distance = [](const vis::Camera& c) { return (c.position - c.target).norm(); };
  REQUIRE(distance(desktop.window->view().camera) == Approx(distance(turned) / 1.15));

  desktop.key(Qt::Key_F); // before the wheel counts as still
  REQUIRE(waitFor([&] { return desktop.window->isSettled() && picture.image() == before; }));
  handleEvents(0.4);
  REQUIRE(settle());
  REQUIRE(picture.image() == before);

  desktop.key(Qt::Key_Comma);
  REQUIRE(settle());
  REQUIRE(timeShown(desktop) == Approx(0.045).epsilon(1e-3));
  desktop.key(Qt::Key_Home);
  REQUIRE(settle());
  REQUIRE(timeShown(desktop) == 0);
  desktop.child<QSlider>("time")->setValue(5);
  REQUIRE(settle());
  REQUIRE(timeShown(desktop) == Approx(0.025).epsilon(1e-3));
}

TEST_CASE("Colour, range and cut change the picture, and panels show curves", "[desktop]") {
  TemporaryFolder folder("desktop-view");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 6, 6, 0.05)));
  desktop.key(Qt::Key_F5);
  REQUIRE(waitFor([&] { return desktop.session().progress() && !desktop.session().runs(); }));
  REQUIRE(waitFor([&] { return desktop.window->isSettled() && timeShown(desktop) > 0.049; }));
  REQUIRE(waitFor([&] { return desktop.child<desktop::ChartPanel>("energies")->charts() > 0; }));
  REQUIRE(desktop.child<desktop::ChartPanel>("energies")->curve()->series.size() == 3);
  REQUIRE(waitFor([&] { return desktop.child<desktop::ChartPanel>("gr")->charts() > 0; }));

  auto& picture = desktop.picture();
  QImage last = picture.image();
  const auto changed = [&] {
    const bool settled = waitFor([&] { return desktop.window->isSettled(); });
    const bool other = picture.image() != last;
    last = picture.image();
    return settled && other;
  };
  auto* quantity = desktop.child<QComboBox>("quantity");
  REQUIRE(quantity->findText("z") >= 0); // what the frame has, not a fixed list
  quantity->setCurrentText("z");
  REQUIRE(changed());
  QTest::mouseClick(desktop.child<QCheckBox>("clip"), Qt::LeftButton, {}, QPoint(8, 8));
  REQUIRE(desktop.window->view().clips.size() == 1);
  REQUIRE(changed());
  QTest::mouseClick(desktop.child<QCheckBox>("clipFlip"), Qt::LeftButton, {}, QPoint(8, 8));
  REQUIRE(desktop.window->view().clips[0].normal == -Vec3::UnitX());
  REQUIRE(changed());
  desktop.child<QComboBox>("range")->setCurrentIndex(1);
  // Heights fall, so that the highest place of the run is in the first frame: 5.5 spacings of 2.02 mm, and of
  // a wide spread of velocities upwards at most 0.2 m/s squared over twice gravity, 2 mm.
  const auto& colouring = desktop.window->view().colouring;
  REQUIRE(waitFor([&] {
    return desktop.window->isSettled() && picture.image() != last && colouring.high > 0.01110 &&
           colouring.high < 0.0132;
  }));
}

TEST_CASE("Ground, size of grains and copies are fields; the wheel scrolls a form and changes none of it",
          "[desktop]") {
  TemporaryFolder folder("desktop-shown");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 6, 6, 0.05)));
  const auto& view = desktop.window->view();
  desktop.click("darkGround");
  CHECK(view.background[0] < 0.2);
  desktop.type("grainScale", "0.5");
  CHECK(view.grainScale == 0.5);
  desktop.type("copies", "2");
  CHECK(view.periodicImages == std::array{2, 2, 2});
  desktop.click("showTime");
  CHECK_FALSE(view.timeStamp);
  REQUIRE(waitFor([&] { return desktop.window->isSettled(); }));
  CHECK(qGray(desktop.picture().image().pixel(2, 2)) < 60);
  CHECK(desktop.undoUntil([&] { return view.background[0] == 1; }));
  CHECK(view.timeStamp);
  CHECK(view.background[0] == 1);
  CHECK(desktop.child<QDoubleSpinBox>("grainScale")->value() == 1);

  auto* form = desktop.child<QScrollArea>("view");
  auto* quantity = desktop.child<QComboBox>("quantity");
  form->verticalScrollBar()->setValue(0);
  const QString before = quantity->currentText();
  const QPoint at = quantity->rect().center();
  QWheelEvent turn(at, quantity->mapToGlobal(at), {}, QPoint(0, -120), Qt::NoButton, {}, Qt::NoScrollPhase,
                   false);
  QSpontaneKeyEvent::setSpontaneous(&turn); // else it goes no further than the box
  qApp->notify(quantity, &turn);
  CHECK(quantity->currentText() == before);
  CHECK(form->verticalScrollBar()->value() > 0);
}

TEST_CASE("Charts take the ground of the theme", "[desktop]") {
  TemporaryFolder folder("desktop-dark");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 6, 6, 0.05)));
  auto* chart = desktop.child<desktop::ChartPanel>("gr");
  REQUIRE(waitFor([&] { return chart->charts() > 0 && desktop.window->isSettled(); }));
  CHECK(qGray(chart->grab().toImage().pixel(2, 2)) == 255);
  const auto before = chart->charts();
  desktop.key(Qt::Key_D, Qt::ControlModifier);
  REQUIRE(waitFor([&] { return chart->charts() > before && desktop.window->isSettled(); }));
  REQUIRE(waitFor([&] { return qGray(chart->grab().toImage().pixel(2, 2)) < 80; }));
  desktop.key(Qt::Key_D, Qt::ControlModifier);
  REQUIRE(waitFor([&] { return qGray(chart->grab().toImage().pixel(2, 2)) == 255; }));
}

TEST_CASE("An analysis that ends when another tab is shown is not shown there", "[desktop]") {
  TemporaryFolder folder("desktop-late");
  Desktop desktop(folder / "run");
  auto* chart = desktop.child<desktop::ChartPanel>("gr");
  const auto scene = writeBed(folder / "bed.toml", 8, 8, 0.05);
  for (int turn = 0; turn < 3; ++turn) {
    REQUIRE(desktop.open(scene));
    REQUIRE(waitFor([&] { return desktop.window->shownFrame() != nullptr; })); // g(r) of it begins
    desktop.key(Qt::Key_T, Qt::ControlModifier);
    handleEvents(0.5);
    REQUIRE(waitFor([&] { return desktop.window->isSettled(); }));
    CHECK_FALSE(chart->curve());
  }
}

TEST_CASE("Larger text is larger everywhere, and charts are drawn again for it", "[desktop]") {
  TemporaryFolder folder("desktop-text");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 6, 6, 0.05)));
  auto* chart = desktop.child<desktop::ChartPanel>("gr");
  REQUIRE(waitFor([&] { return chart->charts() > 0 && desktop.window->isSettled(); }));
  const auto height = [&](const char* name) { return desktop.child<QWidget>(name)->fontMetrics().height(); };
  const int box = height("clip"), combo = height("quantity"), tree = height("accuracy");
  const auto before = chart->charts();
  for (int k = 0; k < 4; ++k)
    desktop.key(Qt::Key_Equal, Qt::ControlModifier);
  CHECK(height("clip") > 1.3 * box); // 1.1 to the fourth is 1.46
  CHECK(height("quantity") > 1.3 * combo);
  CHECK(height("accuracy") > 1.3 * tree);
  REQUIRE(waitFor([&] { return chart->charts() > before && desktop.window->isSettled(); }));
  for (int k = 0; k < 4; ++k)
    desktop.key(Qt::Key_Minus, Qt::ControlModifier);
  CHECK(height("clip") == box);
}

TEST_CASE("Faults are sentences in the window, which keeps what was open", "[desktop]") {
  TemporaryFolder folder("desktop-faults");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 4, 4, 0.05)));
  std::ofstream(folder / "bad.toml") << "title = \"bad\"\ngravty = 3\n";
  REQUIRE(desktop.open(folder / "bad.toml"));
  REQUIRE(desktop.window->bannerText().contains("gravty"));
  REQUIRE(desktop.child<QPlainTextEdit>("log")->toPlainText().contains("gravty"));
  REQUIRE(desktop.session().current().path == folder / "bed.toml");

  REQUIRE(desktop.open(folder / "missing"));
  REQUIRE(desktop.window->bannerText().contains("there is no such file or folder"));
  REQUIRE(desktop.open(folder / "bed.toml"));
  REQUIRE(desktop.window->bannerText().toStdString() == "");
}

TEST_CASE("Files are dropped into the window", "[desktop]") {
  TemporaryFolder folder("desktop-drop");
  Desktop desktop(folder / "run");
  QMimeData data;
  const auto file = writeBed(folder / "bed.toml", 4, 4, 0.05);
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
  QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(desktop.window.get(), &enter);
  REQUIRE(enter.isAccepted());
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(desktop.window.get(), &drop);
  REQUIRE(desktop.session().isOpening());
  REQUIRE(waitFor([&] { return !desktop.session().isOpening(); }));
  REQUIRE(desktop.window->bannerText().toStdString() == "");
  REQUIRE(desktop.session().current().path == file);
}

TEST_CASE("Every command has a name, a tip, keys of its own and a place in the cheat sheet", "[desktop]") {
  TemporaryFolder folder("desktop-commands");
  Desktop desktop(folder / "run");
  std::set<QString> used;
  for (const auto& row : desktop.window->commands().rows()) {
    INFO(row.id.toStdString());
    REQUIRE(!row.name.isEmpty());
    REQUIRE(!row.toolTip.isEmpty());
    for (const auto& key : row.keys) {
      REQUIRE(!key.isEmpty());
      REQUIRE(used.insert(key.toString()).second);
    }
  }
  desktop.key(Qt::Key_F1);
  auto* sheet = desktop.child<QDialog>("cheatSheet");
  REQUIRE(sheet->isVisible());
  const QString text = desktop.window->commands().cheatSheet({});
  for (const auto& row : desktop.window->commands().rows())
    if (!row.keys.isEmpty())
      REQUIRE(text.contains(row.keys.first().toString(QKeySequence::NativeText).toHtmlEscaped()));
}

TEST_CASE("Closing the window stops the run and keeps its checkpoint", "[desktop]") {
  TemporaryFolder folder("desktop-close");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 8, 8, endless)));
  desktop.key(Qt::Key_F5);
  REQUIRE(waitFor([&] { return timeShown(desktop) > 0; }));
  desktop.window->close();
  REQUIRE_FALSE(desktop.session().runs());
  desktop.window.reset();
  Desktop again(folder / "unused");
  REQUIRE(again.open(folder / "run"));
  REQUIRE(again.window->bannerText().toStdString() == "");
  REQUIRE(again.session().current().canResume);
}
