#pragma once
// A window that a test drives with real key and mouse events, without a display.

#include "app/desktop/background.h"
#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/style.h"
#include "sim/scene/scene.h"
#include "tests/sim/temporary_folder.h"

#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QScrollArea>
#include <QSlider>
#include <QtTest>

#include <fmt/format.h>

#include <fstream>

namespace sandglass::test {

/// The one application of the test program.
inline QApplication& application() {
  static QApplication* app = [] {
    setenv("QT_QPA_PLATFORM", "offscreen", 0);
    desktop::limitRasteriserThreads();
    static int argc = 1;
    static char name[] = "tests_desktop";
    static char* argv[] = {name, nullptr};
    auto* made = new QApplication(argc, argv); // lives as long as the program
    desktop::setStyle(*made);
    return made;
  }();
  return *app;
}

/// [s] simulated, of a run that no machine ends while a test waits: the test ends it.
constexpr double endless = 1000;

/// Handles events until the condition holds; false when it does not within the time, which is for a machine
/// that is slow and busy: no test waits so long unless it fails.
template <class Condition> bool waitFor(Condition&& condition, double seconds = 120) {
  QElapsedTimer since;
  since.start();
  for (;;) {
    // What is on its way by then may undo it, and a slow machine handles less of it in one go.
    if (condition()) {
      QCoreApplication::processEvents(QEventLoop::AllEvents, 1000);
      if (condition()) return true;
    }
    if (since.elapsed() > 1000 * seconds) return false;
    QCoreApplication::processEvents(QEventLoop::AllEvents, 5);
    QThread::msleep(1);
  }
}

inline void handleEvents(double seconds) {
  waitFor([] { return false; }, seconds);
}

/// A shown window whose runs go into `folder`.
class Desktop {
public:
  explicit Desktop(const std::filesystem::path& runFolder, int threads = 1) {
    application();
    desktop::WindowOptions options;
    options.session.folder = runFolder;
    options.session.runsFolder = runFolder.parent_path() / "out";
    options.session.threads = threads;
    options.asksNothing = true;
    window = std::make_unique<desktop::MainWindow>(options);
    window->resize(1000, 700);
    window->show();
    QApplication::setActiveWindow(window.get()); // short cuts belong to the active window
  }

  bool open(const std::filesystem::path& path) {
    window->open(QString::fromStdString(path.string()));
    return waitFor([&] { return !window->session().isOpening(); });
  }
  desktop::PictureView& picture() { return *child<desktop::PictureView>("picture"); }
  template <class Widget> Widget* child(const char* name) {
    auto* found = window->findChild<Widget*>(name);
    if (!found) throw std::logic_error(std::string("the window has no ") + name);
    return found;
  }
  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QTest::keyClick(window.get(), static_cast<Qt::Key>(key), modifiers);
  }
  desktop::Session& session() { return window->session(); }
  /// Undoes until the condition holds. What is typed slowly is several steps of undo, what is typed fast one.
  template <class Condition> bool undoUntil(Condition&& condition) {
    for (int k = 0; k < 100 && !condition(); ++k)
      key(Qt::Key_Z, Qt::ControlModifier);
    return condition();
  }

  // What hands do: a widget is focused, as the tabulator does, and gets keys; or it gets the mouse.
  void click(const char* name) {
    auto* button = child<QAbstractButton>(name);
    if (auto* panel = scrollAreaOf(button)) panel->ensureWidgetVisible(button);
    QTest::mouseClick(button, Qt::LeftButton, {}, QPoint(8, button->height() / 2));
  }
  void type(const char* name, const QString& text) {
    auto* widget = child<QWidget>(name);
    widget->setFocus(Qt::TabFocusReason);
    QTest::keyClick(widget, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(widget, text);
    QTest::keyClick(widget, Qt::Key_Return);
  }
  static void choose(QComboBox* box, const QString& item) {
    if (box->findText(item) < 0) throw std::logic_error("there is no item " + item.toStdString());
    box->setFocus(Qt::TabFocusReason);
    for (int k = 0; k < box->count() && box->currentText() != item; ++k)
      QTest::keyClick(box, box->findText(item) > box->currentIndex() ? Qt::Key_Down : Qt::Key_Up);
  }
  void choose(const char* name, const QString& item) { choose(child<QComboBox>(name), item); }
  void slide(const char* name, int value) {
    auto* slider = child<QSlider>(name);
    slider->setFocus(Qt::TabFocusReason);
    while (slider->value() != value) {
      const int before = slider->value(), far = value - before, page = slider->pageStep();
      const int key = far >= page    ? Qt::Key_PageUp
                      : far > 0      ? Qt::Key_Right
                      : far <= -page ? Qt::Key_PageDown
                                     : Qt::Key_Left;
      QTest::keyClick(slider, static_cast<Qt::Key>(key));
      if (slider->value() == before) throw std::logic_error("the slider does not move");
    }
  }

  std::unique_ptr<desktop::MainWindow> window;

private:
  static QScrollArea* scrollAreaOf(QWidget* widget) {
    for (QWidget* w = widget; w; w = w->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(w)) return area;
    return nullptr;
  }
};

/// The step at which a run rests that has been paused, when the window has its frame: a change that is asked
/// for after the pause (of nothing: drag stays 0) is given this step.
inline std::int64_t restingStep(Desktop& desktop) {
  auto& session = desktop.session();
  const std::size_t before = session.current().scene->events.size();
  const QString fault = session.change({.drag = 0});
  if (!fault.isEmpty()) throw std::logic_error(fault.toStdString());
  std::int64_t step = -1;
  const bool rests = waitFor([&] {
    const auto& events = session.current().scene->events;
    if (events.size() > before) step = events.back().step;
    return step >= 0 && session.liveFrame()->step == step;
  });
  if (!rests) throw std::logic_error("the run does not come to rest");
  return step;
}

/// Beads of 2 mm, `side` by `side` by `layers`, on a cube lattice with hair gaps, that fall and spread for
/// `duration` [s]: dense from the first step on.
inline std::filesystem::path writeBed(const std::filesystem::path& file, int side, int layers,
                                      double duration) {
  const double spacing = 2.02, half = side * spacing / 2, height = layers * spacing;
  std::ofstream(file) << fmt::format(R"(
title = "A bed of beads"
seed = 11
[domain]
lower = ["{0:.6f} mm", "{0:.6f} mm", "-1 mm"]
upper = ["{1:.6f} mm", "{1:.6f} mm", "{2:.6f} mm"]
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[contact]]
between = ["glass", "glass"]
normal = {{ law = "linear", collision_time = "5e-4 s", restitution = 0.9 }}
tangential = {{ law = "spring", friction = 0.3, stiffness_ratio = 0.2857142857142857 }}
[[species]]
name = "bead"
material = "glass"
size = {{ distribution = "single", diameter = "2 mm" }}
[[wall]]
name = "box"
kind = "box"
material = "glass"
lower = ["{0:.6f} mm", "{0:.6f} mm", "0"]
upper = ["{1:.6f} mm", "{1:.6f} mm", "{2:.6f} mm"]
open = ["z+"]
[[fill]]
kind = "lattice"
species = "bead"
lower = ["{0:.6f} mm", "{0:.6f} mm", "0"]
upper = ["{1:.6f} mm", "{1:.6f} mm", "{3:.6f} mm"]
structure = "sc"
spacing = "{4:.6f} mm"
velocity_spread = ["0.05 m/s", "0.05 m/s", "0.05 m/s"]
[[stage]]
name = "settle"
until = {{ duration = "{5} s" }}
[[probe]]
name = "energy"
kind = "energies"
interval = "1 ms"
[output]
frame_interval = "5 ms"
quantities = ["velocity"]
)",
                                     -half - 1e-3, half + 1e-3, 2 * height, height + 1e-3, spacing, duration);
  return file;
}

} // namespace sandglass::test
