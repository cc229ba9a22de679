// What the window must not change: the run's bits and the picture's pixels.

#include "desktop_harness.h"

#include "sim/io/run_folder.h"
#include "sim/run/checkpoint_store.h"
#include "tests/sim/frame_equality.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;

TEST_CASE("A run gives the same bits with the window open and closed", "[desktop]") {
  TemporaryFolder folder("desktop-bits");
  const auto scene = writeBed(folder / "bed.toml", 8, 8, 0.1);
  {
    RunOptions options;
    options.folder = folder / "closed";
    options.threads = 1;
    Run(readScene(scene.string()), options).execute();
  }
  {
    Desktop desktop(folder / "open", 2);
    REQUIRE(desktop.open(scene));
    auto& session = desktop.session();
    const auto turn = [&] { desktop.key(Qt::Key_Left, Qt::ControlModifier); }; // the drawing thread is busy
    desktop.key(Qt::Key_S);                                                    // begins paused
    desktop.key(Qt::Key_S, Qt::ShiftModifier);
    REQUIRE(waitFor([&] { return turn(), session.liveFrame() && session.liveFrame()->step == 101; }));
    desktop.key(Qt::Key_Space);
    for (double until = 0.02; until < 0.09;
         until += 0.02) { // paused wherever the keys fall, if it still runs
      REQUIRE(waitFor([&] { return turn(), !session.runs() || session.liveFrame()->time > until; }));
      if (!session.runs()) break;
      desktop.key(Qt::Key_Space);
      for (int k = 0; k < 20; ++k)
        turn(), handleEvents(0.002);
      if (session.isPaused()) desktop.key(Qt::Key_Space);
    }
    REQUIRE(waitFor([&] { return turn(), !session.runs(); }));
    REQUIRE(session.progress()->fraction == 1);
    REQUIRE(desktop.picture().pictures() > 0);
  }
  const auto open = openFrames(folder / "open"), closed = openFrames(folder / "closed");
  REQUIRE(closed->size() == 21); // 0.1 s, a frame each 5 ms, and the first
  REQUIRE(open->size() == closed->size());
  for (std::size_t k = 0; k < open->size(); ++k)
    requireEqual(*open->load(k), *closed->load(k));
  const auto last = [](const std::filesystem::path& run) {
    auto state = readCheckpoint(checkpointFiles(run).back());
    std::erase_if(state, [](const auto& entry) { return !entry.first.starts_with("solver/"); });
    return state;
  };
  REQUIRE(!last(folder / "open").empty());
  REQUIRE(last(folder / "open") == last(folder / "closed"));
}

TEST_CASE("The saved picture is what the renderer draws headless, and leads back to the run", "[desktop]") {
  TemporaryFolder folder("desktop-picture");
  {
    RunOptions options;
    options.folder = folder / "run";
    options.threads = 1;
    Run(readScene(writeBed(folder / "bed.toml", 6, 6, 0.05).string()), options).execute();
  }
  const auto file = folder / "picture.png";
  vis::View view;
  {
    Desktop desktop(folder / "unused");
    REQUIRE(desktop.open(folder / "run"));
    const auto settled = [&] { return desktop.window->isSettled() && desktop.window->shownFrame(); };
    REQUIRE(waitFor(settled));
    desktop.window->showTime(0.02);
    desktop.key(Qt::Key_Right, Qt::ControlModifier);
    REQUIRE(waitFor(settled));
    bool saved = false;
    QObject::connect(desktop.window.get(), &desktop::MainWindow::pictureSaved,
                     [&](const QString&, const QString& fault) { saved = fault.isEmpty(); });
    desktop.window->savePicture(QString::fromStdString(file.string()));
    REQUIRE(waitFor([&] { return saved; }));
    view = desktop.window->view();
    // The screen shows the same pixels.
    const vis::Image image = vis::readPng(file);
    REQUIRE(waitFor(settled));
    REQUIRE(desktop.picture().image() == desktop::toQImage(image));
  }
  std::map<std::string, std::string> text;
  const vis::Image saved = vis::readPng(file, &text);
  const auto frames = openFrames(folder / "run");
  REQUIRE(frames->time(4) == Approx(0.02));
  const vis::Image headless = vis::Renderer().draw(*frames->load(4), view);
  REQUIRE(saved.width == headless.width);
  REQUIRE(vis::difference(saved, headless, 0) == 0);
  REQUIRE(text.at("scene") == sceneHash(readScene((folder / "run" / "scene.toml").string())));
  REQUIRE(std::stod(text.at("time")) == frames->time(4));

  Desktop other(folder / "unused");
  REQUIRE(other.open(file));
  REQUIRE(other.session().current().runFolder == folder / "run");
  REQUIRE(waitFor([&] { return other.window->shownFrame() && other.window->isSettled(); }));
  REQUIRE(other.window->shownFrame()->time == frames->time(4));
  REQUIRE((other.window->view().camera.position - view.camera.position).norm() < 1e-12);
}

TEST_CASE("Stale orders are not drawn", "[desktop]") {
  application();
  desktop::DrawingThread drawing;
  auto frame = std::make_shared<Frame>();
  frame->domain.upper = Vec3::Ones();
  frame->position = {Vec3::Constant(0.5)};
  frame->id = {0};
  frame->scalars[quantity::radius] = {0.3};
  constexpr quint64 orders = 200;
  quint64 shown = 0, newest = 0;
  QObject::connect(&drawing, &desktop::DrawingThread::pictureReady, qApp, [&] {
    if (const auto picture = drawing.takePicture()) ++shown, newest = picture->number;
  });
  for (quint64 k = 1; k <= orders; ++k) {
    desktop::PictureOrder order;
    order.left.frame = frame;
    order.view.width = order.view.height = 64;
    order.number = k;
    drawing.draw(std::move(order));
  }
  REQUIRE(waitFor([&] { return newest == orders; }));
  REQUIRE(shown < orders / 4);
}
