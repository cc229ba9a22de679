// The window answers and shows pictures while a large run goes on, and the run waits for nobody. How much
// speed that costs is measured by `./bootstrap bench desktop`; nothing here depends on the speed of a
// machine.

#include "desktop_harness.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <set>
#include <thread>

using namespace sandglass;
using namespace sandglass::test;

TEST_CASE("While 20,000 grains run, the window answers and shows them", "[desktop]") {
  TemporaryFolder folder("desktop-awake");
  Desktop desktop(folder / "run", 2);
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 27, 28, endless))); // 20,412 grains
  REQUIRE(waitFor([&] { return desktop.window->isSettled(); }));         // the preview
  int beats = 0;
  QTimer heart;
  heart.setInterval(5);
  QObject::connect(&heart, &QTimer::timeout, [&] { ++beats; });
  std::set<std::int64_t> shown; // steps of the frames
  desktop.key(Qt::Key_F5);
  heart.start();
  REQUIRE(waitFor([&] {
    if (const auto& frame = desktop.window->shownFrame(); frame && frame->step > 0) shown.insert(frame->step);
    return shown.size() >= 4;
  }));
  REQUIRE(desktop.session().runs());
  // A window that draws itself, or waits for steps, has hardly a beat between two pictures.
  CHECK(beats > 5 * static_cast<int>(shown.size()));
  const QString before = desktop.window->windowTitle();
  desktop.key(Qt::Key_T, Qt::ControlModifier); // and its keys do what they do
  CHECK(desktop.window->tabs() == 2);
  desktop.key(Qt::Key_W, Qt::ControlModifier);
  CHECK(desktop.window->windowTitle() == before);
  CHECK(desktop.session().runs());
}

TEST_CASE("A run does not wait for a window that is busy", "[desktop]") {
  TemporaryFolder folder("desktop-busy");
  Desktop desktop(folder / "run");
  REQUIRE(desktop.open(writeBed(folder / "bed.toml", 8, 8, endless)));
  desktop.key(Qt::Key_F5);
  REQUIRE(waitFor([&] { return desktop.session().liveFrame() != nullptr; }));
  const auto store = desktop.session().current().store;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  const std::size_t before = store->size();
  while (store->size() < before + 10 && std::chrono::steady_clock::now() < limit) // no event is handled
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(store->size() >= before + 10);
  CHECK(desktop.session().runs());
  const FramePtr late = store->load(store->size() - 1); // and it is not behind once it has time again
  CHECK(waitFor([&] { return desktop.session().liveFrame()->step >= late->step; }));
}
