// Three days of work, with real keys and clicks: somebody who plays, somebody who runs batches, somebody who
// analyses. Each takes at most forty actions and meets no dead end. With SANDGLASS_PICTURES=FOLDER the
// pictures of the documentation are written there.

#include "desktop_harness.h"

#include "app/desktop/chart_panel.h"
#include "app/desktop/inspector_panel.h"
#include "app/desktop/scene_panel.h"
#include "app/desktop/view_panel.h"
#include "sim/io/run_folder.h"
#include "tests/app/program.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenuBar>
#include <QMimeData>
#include <QPushButton>
#include <QSlider>
#include <QStatusBar>
#include <QToolButton>

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace sandglass;
using namespace sandglass::test;

namespace {

constexpr int mostActions = 40;

/// A window in which every action of the hand is counted.
class Day {
public:
  Day(const char* name, const std::filesystem::path& folder, const std::filesystem::path& run)
      : name_(name), folder_(folder), desktop_(run, 2) {
    desktop_.window->resize(1440, 900);
    since_.start();
  }
  ~Day() {
    fmt::print("{}: {} actions, {:.1f} s\n", name_, actions_, 1e-3 * static_cast<double>(since_.elapsed()));
    CHECK(actions_ <= mostActions);
    for (const auto& fault : desktop_.child<desktop::ScenePanel>("scene")->faults())
      fmt::print("  the scene: {}\n", fault.toStdString());
    if (!window().bannerText().isEmpty()) fmt::print("  banner: {}\n", window().bannerText().toStdString());
  }

  Desktop& desktop() { return desktop_; }
  desktop::MainWindow& window() { return *desktop_.window; }
  void settle() {
    REQUIRE(waitFor([&] { return window().isSettled(); }));
    CHECK(window().bannerText().toStdString() == ""); // no dead end
  }
  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    ++actions_;
    QApplication::setActiveWindow(&window()); // what a window manager does when a dialog has closed
    window().setFocus();
    desktop_.key(key, modifiers);
  }
  /// The short cut of a command, as the cheat sheet tells it.
  void command(const char* id) {
    const auto sequence = window().commands().action(id)->shortcut();
    REQUIRE(!sequence.isEmpty());
    const int code = sequence[0];
    key(code & ~static_cast<int>(Qt::KeyboardModifierMask),
        Qt::KeyboardModifiers(code & static_cast<int>(Qt::KeyboardModifierMask)));
  }
  template <class Button> void click(const char* name) {
    ++actions_;
    desktop_.click(name);
  }
  void clickIn(QWidget* panel, const char* name) {
    ++actions_;
    auto* button = panel->findChild<QToolButton*>(name);
    REQUIRE(button);
    QTest::mouseClick(button, Qt::LeftButton);
  }
  void type(const char* name, const char* text) {
    ++actions_;
    desktop_.type(name, text);
  }
  void choose(const char* name, const QString& item) {
    ++actions_;
    desktop_.choose(name, item);
  }
  void chooseIn(QWidget* panel, const char* name, const QString& item) {
    ++actions_;
    auto* box = panel->findChild<QComboBox*>(name);
    REQUIRE(box);
    Desktop::choose(box, item);
  }
  void slide(const char* name, int value) {
    ++actions_;
    desktop_.slide(name, value);
  }
  /// Opens the command's menu with the mouse and goes down to it with the arrow key.
  void menu(const char* id) {
    ++actions_;
    QAction* action = window().commands().action(id);
    auto* bar = window().menuBar();
    for (QAction* top : bar->actions()) {
      QMenu* list = top->menu();
      if (!list || !list->actions().contains(action)) continue;
      QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(top).center());
      for (int k = 0; k < 2 * list->actions().size() && list->activeAction() != action; ++k)
        QTest::keyClick(list, Qt::Key_Down);
      REQUIRE(list->activeAction() == action);
      QTest::keyClick(list, Qt::Key_Return);
      return;
    }
    FAIL("no menu has " << id);
  }
  /// From a file manager into the window.
  void drop(const std::filesystem::path& path) {
    ++actions_;
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QString::fromStdString(path.string()))});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(&window(), &enter);
    REQUIRE(enter.isAccepted());
    QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(&window(), &drop);
  }
  /// Types a name into the file dialog that the next action opens.
  void nameNextFile(const std::filesystem::path& file) {
    ++actions_;
    auto* look = new QTimer(&window()); // again and again: a busy machine takes its time to show a dialog
    QObject::connect(look, &QTimer::timeout, look, [file, look] {
      for (auto* widget : QApplication::topLevelWidgets())
        if (auto* dialog = qobject_cast<QFileDialog*>(widget); dialog && dialog->isVisible()) {
          look->deleteLater();
          look->stop();
          auto* line = dialog->findChild<QLineEdit*>("fileNameEdit");
          QTest::keyClicks(line, QString::fromStdString(file.string()));
          QTest::keyClick(line, Qt::Key_Return);
          return;
        }
    });
    look->start(300);
  }
  /// A grain: the first that is hit, from the lower half of the picture's left to its right. Between grains
  /// the mouse can miss, and where they are depends on when the run was paused.
  void pick() {
    ++actions_;
    auto& picture = desktop_.picture();
    const auto* inspector = desktop_.child<desktop::InspectorPanel>("inspector");
    for (const int column : {40, 43, 47, 53, 60, 70, 80})
      for (int row = 80; row >= 30; row -= 5) {
        QTest::mouseClick(&picture, Qt::LeftButton, {},
                          QPoint(picture.width() * column / 100, picture.height() * row / 100));
        window().statusBar()->clearMessage();
        waitFor([&] {
          return inspector->grain() >= 0 || window().statusBar()->currentMessage() == "No grain there.";
        });
        if (inspector->grain() >= 0) return;
      }
    FAIL("no grain was hit");
  }
  /// Keeps what the window looks like.
  void picture(const char* file) {
    settle();
    window().statusBar()->clearMessage(); // names of folders of this machine
    handleEvents(0.3);
    const char* folder = std::getenv("SANDGLASS_PICTURES");
    const auto whole = folder ? std::filesystem::absolute(folder) / file : folder_ / file;
    REQUIRE(window().grab().save(QString::fromStdString(whole.string()), "PNG"));
  }
  std::filesystem::path in(const char* file) const { return folder_ / file; }

private:
  const char* name_;
  std::filesystem::path folder_;
  Desktop desktop_;
  QElapsedTimer since_;
  int actions_ = 0;
};

void runHeadless(const std::filesystem::path& scene, const std::filesystem::path& folder) {
  RunOptions options;
  options.folder = folder;
  Run(readScene(scene.string(), {"output.contacts=true", "output.checkpoint_interval=1 s"}), options)
      .execute();
}

} // namespace

TEST_CASE("A day of the explorer", "[desktop][days]") {
  TemporaryFolder folder("day-explorer");
  Day day("explorer", folder / "", folder / "run");
  auto& window = day.window();
  day.picture("explorer_start.png");
  day.click<QToolButton>("sample.hopper_glass");
  REQUIRE(waitFor([&] { return window.session().isOpen(); }));
  day.settle();
  day.type("field.fill.1.number", "1500");
  day.type("field.fill.1.upper", "6.25 cm, 10 cm, 0.28 cm");
  day.type("field.stage.settle.until.settled_after", "0.1 s");
  day.type("field.stage.settle.until.duration", "0.15 s");
  // No machine is so fast that the hopper is empty, or no longer runs, before the hand has done its work.
  day.type("field.stage.discharge.until.quiet", "1000 s");
  day.type("field.stage.discharge.until.duration", "1000 s");
  day.settle();
  REQUIRE(waitFor(
      [&] { return window.isSettled() && window.shownFrame() && window.shownFrame()->size() == 1500; }));
  day.picture("explorer_scene.png");
  day.command("panel.run");
  day.choose("speedLimit", "10 times slower");
  day.key(Qt::Key_Space);
  REQUIRE(waitFor(
      [&] { return window.session().liveFrame() && window.session().liveFrame()->stage == "discharge"; }));
  day.type("gravity.x", "6");
  day.click<QPushButton>("applyGravity");
  const double from = window.session().liveFrame()->time;
  REQUIRE(waitFor([&] { return window.session().liveFrame()->time > from + 0.1; }));
  day.key(Qt::Key_Space);
  REQUIRE(window.session().isPaused());
  day.settle();
  day.picture("explorer_run.png");
  day.pick();
  day.command("panel.view");
  day.click<QCheckBox>("clip");
  REQUIRE(window.view().clips.size() == 1);
  day.settle();
  day.key(Qt::Key_Z, Qt::ControlModifier);
  REQUIRE(window.view().clips.empty());
  day.clickIn(day.desktop().child<QWidget>("energies"), "pin");
  REQUIRE(day.desktop().child<desktop::ChartPanel>("energies")->pinned() == 3);
  day.key(Qt::Key_F5, Qt::ShiftModifier);
  REQUIRE(waitFor([&] { return !window.session().runs(); }));
  day.settle();
  day.slide("time", 3);
  day.settle();
  const double moment = window.shownFrame()->time;
  REQUIRE(moment > 0);
  day.nameNextFile(day.in("picture.png"));
  bool saved = false;
  QObject::connect(&window, &desktop::MainWindow::pictureSaved,
                   [&](const QString&, const QString& fault) { saved = fault.isEmpty(); });
  day.command("file.savePicture");
  REQUIRE(waitFor([&] { return saved; }));
  day.command("run.branch");
  REQUIRE(waitFor(
      [&] { return window.tabs() == 2 && window.session().isPaused() && window.session().liveFrame(); }));
  day.settle();
  day.command("file.closeTab");
  day.settle();
  day.key(Qt::Key_T, Qt::ControlModifier);
  day.nameNextFile(day.in("picture.png"));
  day.command("file.open");
  REQUIRE(waitFor([&] { return window.session().isOpen() && window.shownFrame(); }));
  day.settle();
  REQUIRE(window.shownFrame()->time == moment);
  day.picture("explorer_back.png");
}

TEST_CASE("A day of the batch user", "[desktop][days]") {
  TemporaryFolder folder("day-batch");
  const std::string program = SANDGLASS_PROGRAM, source = SANDGLASS_SOURCE_DIR;
  const auto run = (folder / "run").string();
  int commands = 0;
  const auto shell = [&](const std::string& arguments) {
    ++commands;
    INFO(arguments);
    REQUIRE(std::system(fmt::format("'{}' {} >'{}' 2>&1", program, arguments, (folder / "out.txt").string())
                            .c_str()) == 0);
  };
  shell(fmt::format("explain '{}/sample_runs/hopper_glass' --quick", source));
  shell(fmt::format("run '{}/sample_runs/hopper_glass' --quick --set seed=3 -o '{}'", source, run));
  shell(fmt::format("render '{}' -o '{}' --size 480x360 --every 8", run, (folder / "frames").string()));
  shell(fmt::format("analyze '{}' -o '{}' --gr --packing --discharge --energies", run,
                    (folder / "curves").string()));
  REQUIRE(std::filesystem::exists(folder / "frames"));
  {
    Day day("batch user, at the desk", folder / "", folder / "unused");
    auto& window = day.window();
    for (int k = 0; k < commands; ++k)
      day.settle();
    day.drop(run);
    REQUIRE(waitFor([&] { return window.session().isOpen() && window.shownFrame(); }));
    day.settle();
    REQUIRE(day.desktop().child<desktop::ChartPanel>("energies")->charts() > 0);
    day.key(Qt::Key_Home);
    day.settle();
    REQUIRE(window.shownFrame()->time == 0);
    day.key(Qt::Key_End);
    day.key(Qt::Key_Comma);
    day.settle();
    day.nameNextFile(day.in("flow.csv"));
    day.clickIn(day.desktop().child<QWidget>("flow"), "csv");
    REQUIRE(std::filesystem::exists(day.in("flow.csv")));
    day.choose("quantity", "y");
    day.settle();
    day.picture("batch_run.png");
    day.nameNextFile(day.in("work.sandglass"));
    day.command("file.saveSession");
    REQUIRE(std::filesystem::exists(day.in("work.sandglass")));
  }
  REQUIRE(commands < 10);
}

TEST_CASE("A day of the analyst", "[desktop][days]") {
  TemporaryFolder folder("day-analyst");
  runHeadless(writeBed(folder / "bed.toml", 12, 12, 0.12), folder / "run");
  const auto segments = std::filesystem::directory_iterator(folder / "run" / "frames");
  Day day("analyst", folder / "", folder / "unused");
  auto& window = day.window();
  day.drop(std::filesystem::begin(segments)->path()); // a file alone
  REQUIRE(waitFor([&] { return window.session().isOpen() && window.shownFrame(); }));
  day.settle();
  const auto panel = [&](const char* id) { return day.desktop().child<desktop::ChartPanel>(id); };
  REQUIRE(waitFor([&] { return panel("gr")->charts() > 0; }));
  day.command("panel.bond_angles");
  day.settle();
  REQUIRE(waitFor([&] { return panel("bond_angles")->charts() > 0; }));
  day.picture("analyst_angles.png");
  day.menu("panel.histogram");
  day.settle();
  REQUIRE(waitFor([&] { return panel("histogram")->charts() > 0; }));
  day.chooseIn(panel("histogram"), "chartQuantity", "z");
  day.settle();
  REQUIRE(panel("histogram")->curve()->x.name == "z");
  day.clickIn(panel("histogram"), "pin");
  day.key(Qt::Key_Home);
  day.settle();
  REQUIRE(waitFor(
      [&] { return panel("histogram")->isCurrent() && panel("histogram")->drawn().series.size() == 2; }));
  day.clickIn(panel("histogram"), "logY");
  day.settle();
  auto* chart = panel("histogram");
  const double widest = chart->drawn().series[0].x.back();
  QTest::mousePress(chart, Qt::LeftButton, {}, QPoint(chart->width() / 3, chart->height() / 2));
  QMouseEvent drag(QEvent::MouseMove, QPoint(chart->width() / 2, chart->height() / 2), Qt::NoButton,
                   Qt::LeftButton, {});
  QCoreApplication::sendEvent(chart, &drag);
  QTest::mouseRelease(chart, Qt::LeftButton, {}, QPoint(chart->width() / 2, chart->height() / 2));
  day.settle();
  REQUIRE(chart->drawn().series[0].x.back() < widest);
  day.nameNextFile(day.in("heights.csv"));
  day.clickIn(chart, "csv");
  REQUIRE(std::filesystem::exists(day.in("heights.csv")));
  day.nameNextFile(day.in("heights.png"));
  day.clickIn(chart, "png");
  REQUIRE(waitFor([&] { return std::filesystem::exists(day.in("heights.png")); }));
  day.type("selection", "z < 0.01");
  REQUIRE(window.view().selection.expression == "z < 0.01");
  day.settle();
  day.click<QCheckBox>("forceChains");
  day.settle();
  day.key(Qt::Key_End);
  day.pick();
  day.settle();
  REQUIRE(waitFor([&] { return panel("history")->charts() > 0; }));
  day.key(Qt::Key_T);
  REQUIRE(window.view().tracks.grains.size() == 1);
  day.settle();
  day.picture("analyst_grain.png");
}
