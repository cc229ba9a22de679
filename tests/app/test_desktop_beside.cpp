// Two runs in one picture, through one camera.

#include "desktop_harness.h"

#include "app/desktop/inspector_panel.h"
#include "sim/io/run_folder.h"

#include <QAction>

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace sandglass;
using namespace sandglass::test;

namespace {

/// The same bed twice, once with gravity along x as well.
void runTwo(const TemporaryFolder& folder) {
  const auto scene = writeBed(folder / "bed.toml", 6, 6, 0.1).string();
  for (const char* name : {"level", "tilted"}) {
    RunOptions options;
    options.folder = folder / name;
    options.threads = 1;
    const bool tilted = std::string(name) == "tilted";
    Run(readScene(scene, tilted ? std::vector<std::string>{"gravity=[\"8 m/s^2\", \"0\", \"-9.81 m/s^2\"]"}
                                : std::vector<std::string>{}),
        options)
        .execute();
  }
}

bool settled(Desktop& desktop) {
  return waitFor([&] { return desktop.window->isSettled() && desktop.window->shownFrame(); });
}

void keepPicture(Desktop& desktop, const std::filesystem::path& otherwise) {
  const char* folder = std::getenv("SANDGLASS_PICTURES");
  const auto file = folder ? std::filesystem::absolute(folder) / "side_by_side.png" : otherwise;
  handleEvents(0.3);
  REQUIRE(desktop.window->grab().save(QString::fromStdString(file.string()), "PNG"));
}

} // namespace

TEST_CASE("Two runs side by side turn together, are picked apart, and come back from their picture",
          "[desktop][beside]") {
  TemporaryFolder folder("desktop-beside");
  runTwo(folder);
  const auto file = folder / "pair.png";
  double time = 0;
  vis::Camera camera;
  {
    Desktop desktop(folder / "unused");
    desktop.window->resize(1440, 900);
    REQUIRE(desktop.open(folder / "tilted"));
    desktop.key(Qt::Key_T, Qt::ControlModifier);
    REQUIRE(desktop.open(folder / "level"));
    REQUIRE(settled(desktop));
    const QImage alone = desktop.picture().image();
    desktop.key(Qt::Key_B, Qt::ControlModifier);
    REQUIRE(settled(desktop));
    REQUIRE(desktop.window->bannerText().toStdString() == "");
    REQUIRE(desktop.window->commands().action("view.beside")->isChecked());
    REQUIRE(desktop.window->shownBeside());
    const QImage both = desktop.picture().image();
    REQUIRE(both.size() == alone.size());
    REQUIRE(both != alone);

    // The halves are the two runs: pairs of one moment, the right one sheared along x.
    const auto meanX = [](const Frame& frame) {
      double sum = 0;
      for (const Vec3& x : frame.position)
        sum += x.x();
      return sum / static_cast<double>(frame.size());
    };
    REQUIRE(desktop.window->shownBeside()->time == desktop.window->shownFrame()->time);
    REQUIRE(meanX(*desktop.window->shownBeside()) > meanX(*desktop.window->shownFrame()) + 1e-4);

    // One camera: a drag in the right half turns both.
    auto& picture = desktop.picture();
    const auto half = [&](bool right) {
      const QImage& image = picture.image();
      return image.copy(right ? image.width() / 2 : 0, 0, image.width() / 2, image.height());
    };
    const QImage left = half(false), right = half(true);
    const QPoint from(picture.width() * 3 / 4, picture.height() / 2);
    QTest::mousePress(&picture, Qt::LeftButton, {}, from);
    QMouseEvent drag(QEvent::MouseMove, from + QPoint(90, 20), Qt::NoButton, Qt::LeftButton, {});
    QCoreApplication::sendEvent(&picture, &drag);
    QTest::mouseRelease(&picture, Qt::LeftButton, {}, from + QPoint(90, 20));
    REQUIRE(settled(desktop));
    REQUIRE(half(false) != left);
    REQUIRE(half(true) != right);
    keepPicture(desktop, folder / "window.png");

    // Time goes on in both.
    desktop.key(Qt::Key_Home);
    REQUIRE(settled(desktop));
    REQUIRE(desktop.window->shownBeside()->time == 0);
    for (int k = 0; k < 12; ++k)
      desktop.key(Qt::Key_Period);
    REQUIRE(settled(desktop));
    time = desktop.window->shownFrame()->time;
    REQUIRE(time == Approx(0.06));
    REQUIRE(desktop.window->shownBeside()->time == Approx(0.06));

    // The grain under the mouse is one of the half in which it lies.
    auto* inspector = desktop.child<desktop::InspectorPanel>("inspector");
    for (const int quarter : {1, 3}) {
      QTest::mouseClick(&picture, Qt::LeftButton, {},
                        QPoint(picture.width() * quarter / 4, picture.height() * 6 / 10));
      const FramePtr of = quarter == 1 ? desktop.window->shownFrame() : desktop.window->shownBeside();
      REQUIRE(waitFor([&] { return inspector->grain() >= 0 && inspector->frame() == of; }));
      REQUIRE(settled(desktop));
    }

    bool saved = false;
    QObject::connect(desktop.window.get(), &desktop::MainWindow::pictureSaved,
                     [&](const QString&, const QString& fault) { saved = fault.isEmpty(); });
    desktop.window->savePicture(QString::fromStdString(file.string()));
    REQUIRE(waitFor([&] { return saved; }));
    REQUIRE(settled(desktop));
    REQUIRE(desktop.picture().image() == desktop::toQImage(vis::readPng(file)));
    camera = desktop.window->view().camera;

    desktop.key(Qt::Key_B, Qt::ControlModifier); // alone again
    REQUIRE(settled(desktop));
    REQUIRE_FALSE(desktop.window->shownBeside());
    desktop.key(Qt::Key_B, Qt::ControlModifier);
    REQUIRE(settled(desktop));
    desktop.window->closeTab(0); // of the right half
    REQUIRE(settled(desktop));
    REQUIRE_FALSE(desktop.window->shownBeside());
    desktop.key(Qt::Key_B, Qt::ControlModifier); // nobody to show
    REQUIRE(desktop.window->bannerText().contains("Side by side takes two runs"));
    REQUIRE_FALSE(desktop.window->commands().action("view.beside")->isChecked());
  }
  Desktop desktop(folder / "unused");
  desktop.window->resize(1440, 900);
  REQUIRE(desktop.open(file));
  REQUIRE(waitFor([&] { return desktop.window->isSettled() && desktop.window->shownBeside(); }));
  REQUIRE(desktop.window->tabs() == 2);
  REQUIRE(desktop.window->bannerText().toStdString() == "");
  REQUIRE(desktop.session().current().runFolder == folder / "level");
  REQUIRE(desktop.window->shownFrame()->time == time);
  REQUIRE(desktop.window->shownBeside()->time == Approx(time));
  REQUIRE((desktop.window->view().camera.position - camera.position).norm() < 1e-12);
  REQUIRE(desktop.picture().image() == desktop::toQImage(vis::readPng(file)));
}

TEST_CASE("Two runs side by side go on at the same time", "[desktop][beside]") {
  TemporaryFolder folder("desktop-beside-live");
  Desktop desktop(folder / "first");
  const auto scene = writeBed(folder / "bed.toml", 5, 5, endless);
  REQUIRE(desktop.open(scene));
  desktop.key(Qt::Key_Space);
  REQUIRE(waitFor([&] { return desktop.window->shownFrame() && desktop.window->shownFrame()->time > 0; }));
  desktop.key(Qt::Key_T, Qt::ControlModifier);
  REQUIRE(desktop.open(scene));
  desktop.key(Qt::Key_Space);
  desktop.key(Qt::Key_B, Qt::ControlModifier);
  REQUIRE(waitFor([&] { return desktop.window->shownBeside() && desktop.window->shownFrame(); }));
  const double left = desktop.window->shownFrame()->time, right = desktop.window->shownBeside()->time;
  REQUIRE(waitFor([&] {
    return desktop.window->shownBeside() && desktop.window->shownBeside()->time > right &&
           desktop.window->shownFrame()->time > left;
  }));
}
