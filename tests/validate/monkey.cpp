// Random input at a window with a run going: nothing may crash, hang or leak. The input follows from the seed
// alone; what the window makes of it also depends on how fast the machine is.
//
// validate_monkey FOLDER [--seconds S] [--seed N]     FOLDER gets monkey.csv

#include "tests/app/desktop_harness.h"

#include <CLI/CLI.hpp>
#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QToolButton>

#include <fstream>
#include <random>
#include <set>

using namespace sandglass;
using namespace sandglass::test;

namespace {

constexpr double hang = 20; ///< [s] that one action may take, sanitizers included

/// Commands that end the program, write files of the user or open a dialog of the system.
const std::set<QString> leftOut{"file.quit",        "file.open",      "file.openRun",
                                "file.savePicture", "file.saveScene", "file.saveSession"};

class Monkey {
public:
  Monkey(std::uint64_t seed, const std::filesystem::path& folder)
      : random_(seed), folder_(folder), scene_(writeBed(folder / "bed.toml", 8, 8, 5)),
        desktop_(folder / "run", 1) {
    // Whatever opens and blocks is sent away again.
    closer_.setInterval(50);
    QObject::connect(&closer_, &QTimer::timeout, [] {
      if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget())) dialog->reject();
      if (auto* popup = QApplication::activePopupWidget()) popup->close();
    });
    closer_.start();
    start();
  }

  void act() {
    QElapsedTimer since;
    since.start();
    switch (random_() % 8) {
    case 0:
    case 1:
      command();
      break;
    case 2:
      click();
      break;
    case 3:
      drag();
      break;
    case 4:
      type();
      break;
    case 5:
      wheel();
      break;
    case 6:
      click();
      break;
    default:
      resize();
      break;
    }
    QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete); // as an event loop does
    QThread::msleep(random_() % 20);
    const double seconds = 1e-3 * static_cast<double>(since.elapsed());
    if (seconds > longest_) longest_ = seconds, slowest_ = now_;
    ++actions_;
    if (actions_ % 40 == 0 && !desktop_.session().runs()) start();
  }

  int actions() const { return actions_; }
  int runs() const { return runs_; }
  double longest() const { return longest_; } ///< [s]
  const std::string& slowest() const { return slowest_; }
  quint64 pictures() { return desktop_.picture().pictures(); }

private:
  void start() {
    while (desktop_.window->tabs() > 3)
      desktop_.window->closeTab(0);
    desktop_.open(scene_);
    desktop_.session().start();
    runs_ += desktop_.session().runs();
  }
  void command() {
    const auto& rows = desktop_.window->commands().rows();
    const auto& row = rows[random_() % rows.size()];
    if (leftOut.contains(row.id)) return;
    now_ = "the command " + row.id.toStdString();
    if (row.keys.isEmpty()) return desktop_.window->commands().action(row.id)->trigger();
    const int code = row.keys.first()[0], mask = static_cast<int>(Qt::KeyboardModifierMask);
    QTest::keyClick(desktop_.window.get(), static_cast<Qt::Key>(code & ~mask),
                    Qt::KeyboardModifiers(code & mask));
  }
  QWidget* anyWidget() {
    QList<QWidget*> all;
    for (auto* widget : desktop_.window->findChildren<QWidget*>())
      if (widget->isVisible() && widget->isEnabled() && widget->width() > 4 && widget->height() > 4 &&
          !qobject_cast<QMenu*>(widget) && !widget->inherits("QMenuBar"))
        all << widget;
    return all.isEmpty() ? desktop_.window.get()
                         : all[static_cast<int>(random_() % static_cast<unsigned>(all.size()))];
  }
  QPoint anyPoint(const QWidget* widget) {
    return {static_cast<int>(random_() % static_cast<unsigned>(widget->width())),
            static_cast<int>(random_() % static_cast<unsigned>(widget->height()))};
  }
  void click() {
    QWidget* widget = anyWidget();
    const QString name = widget->objectName();
    now_ = fmt::format("a click on {} {}", widget->metaObject()->className(), name.toStdString());
    if (name == "csv" || name == "png" || name == "startOpen") return; // file dialogs
    const auto button = random_() % 5 ? Qt::LeftButton : Qt::RightButton;
    if (random_() % 6)
      QTest::mouseClick(widget, button, {}, anyPoint(widget));
    else
      QTest::mouseDClick(widget, button, {}, anyPoint(widget));
  }
  void drag() {
    now_ = "a drag";
    QPointer<QWidget> widget = random_() % 2 ? static_cast<QWidget*>(&desktop_.picture()) : anyWidget();
    if (widget->inherits("QDockWidget") || widget->inherits("QTabBar"))
      return; // moving docks grabs the mouse
    const auto button = random_() % 3 ? Qt::LeftButton : Qt::RightButton;
    QTest::mousePress(widget, button, {}, anyPoint(widget));
    for (int k = 0; k < 5 && widget; ++k) {
      QMouseEvent move(QEvent::MouseMove, anyPoint(widget), Qt::NoButton, button, {});
      QCoreApplication::sendEvent(widget, &move);
    }
    if (widget) QTest::mouseRelease(widget, button, {}, anyPoint(widget));
  }
  void type() {
    now_ = "letters";
    static const char* const texts[] = {
        "1",           "-1",  "0.002",  "3 mm",           "x",  "\"", "]", "1e308",
        "speed > 0.1", "z <", "bins=3", "r_max=nonsense", "\n", "{",  "ü"};
    QPointer<QWidget> widget = anyWidget();
    if (!qobject_cast<QLineEdit*>(widget) && !qobject_cast<QPlainTextEdit*>(widget)) {
      const auto lines = desktop_.window->findChildren<QLineEdit*>();
      if (lines.isEmpty()) return;
      widget = lines[static_cast<int>(random_() % static_cast<unsigned>(lines.size()))];
    }
    if (!widget->isVisible() || !widget->isEnabled()) return;
    widget->setFocus();
    for (const QChar c : QString(texts[random_() % std::size(texts)])) {
      if (!widget) return;
      QKeyEvent press(QEvent::KeyPress, c == '\n' ? Qt::Key_Return : 0, Qt::NoModifier, QString(c));
      QCoreApplication::sendEvent(widget, &press);
    }
    if (widget && random_() % 2) QTest::keyClick(widget.data(), Qt::Key_Return);
    if (desktop_.window) desktop_.window->setFocus();
  }
  void wheel() {
    now_ = "the wheel";
    QWidget* widget = random_() % 2 ? static_cast<QWidget*>(&desktop_.picture()) : anyWidget();
    const QPoint at = anyPoint(widget);
    QWheelEvent turn(at, widget->mapToGlobal(at), {}, QPoint(0, random_() % 2 ? 120 : -120), Qt::NoButton, {},
                     Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(widget, &turn);
  }
  void resize() {
    now_ = "another size of the window";
    desktop_.window->resize(700 + static_cast<int>(random_() % 700), 500 + static_cast<int>(random_() % 400));
  }

  std::mt19937_64 random_;
  std::filesystem::path folder_, scene_;
  Desktop desktop_;
  QTimer closer_;
  int actions_ = 0, runs_ = 0;
  double longest_ = 0;
  std::string now_ = "the start", slowest_; ///< actions in words
};

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Random input at the window."};
  std::string folder;
  double seconds = 600;
  std::uint64_t seed = 1;
  app.add_option("FOLDER", folder, "gets monkey.csv")->required();
  app.add_option("--seconds", seconds, "how long");
  app.add_option("--seed", seed, "of the input");
  CLI11_PARSE(app, argc, argv);
  std::filesystem::create_directories(folder);
  application();
  const TemporaryFolder work("monkey");
  std::string rows = "case,quantity,ours,uncertainty,expected,tolerance,source,verdict\n";
  bool ok = false;
  {
    Monkey monkey(seed, work / "");
    QElapsedTimer since;
    since.start();
    while (since.elapsed() < 1000 * seconds)
      monkey.act();
    ok = monkey.longest() < hang && monkey.pictures() > 0;
    rows += fmt::format("monkey_{},actions,{},0,all survived,,{} s of input with {} runs going,ok\n", seed,
                        monkey.actions(), seconds, monkey.runs());
    rows += fmt::format("monkey_{},longest action [s],{:.3g},0,below {},,no hang; it was {},{}\n", seed,
                        monkey.longest(), hang, monkey.slowest(), monkey.longest() < hang ? "ok" : "off");
    rows += fmt::format("monkey_{},pictures,{},0,more than 0,,the window went on drawing,{}\n", seed,
                        monkey.pictures(), monkey.pictures() > 0 ? "ok" : "off");
  }
  fmt::print("{}", rows);
  std::ofstream(std::filesystem::path(folder) / "monkey.csv") << rows;
  return ok ? 0 : 1;
}
