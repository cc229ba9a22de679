// sandglass-desktop: the window.

#include "app/desktop/background.h"
#include "app/desktop/main_window.h"
#include "app/desktop/screenshot.h"
#include "app/desktop/style.h"
#include "app/desktop/sweep_panel.h"
#include "sim/base/error.h"
#include "vis/readers/child_reader.h"
#include "vis/readers/vti_field.h"
#include "vis/readers/vtk_frame.h"
#include "vis/readers/vtp_mesh.h"

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QStandardPaths>
#include <QTimer>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

namespace {

struct Arguments {
  std::string path, folder, columns, viewFile, screenshot, size = "1440x900", backend = "auto";
  int threads = 0;
  double at = -1;
  int point = 0;
  bool run = false, dark = false;
};

void addOptions(CLI::App& app, Arguments& a) {
  app.add_option("PATH", a.path,
                 "a scene, the folder of a run, a file of frames, a saved picture or session");
  app.add_option("-o,--output", a.folder, "folder of the run (out/<name of the scene>)");
  app.add_option("--columns", a.columns,
                 "what columns, units and walls of another program's file are (default: FILE.import.toml or "
                 "import.toml beside it)");
  app.add_option("--threads", a.threads, "of the simulation; 0: all cores")->check(CLI::NonNegativeNumber);
  app.add_flag("--run", a.run, "start at once");
  app.add_option("--view", a.viewFile, "view file (TOML)");
  app.add_option("--at", a.at, "show the saved frame nearest to this time [s]");
  app.add_option("--point", a.point, "of a sweep: choose this one")->check(CLI::PositiveNumber);
  app.add_option("--size", a.size, "of the window, WIDTHxHEIGHT [pixel]");
  app.add_option("--screenshot", a.screenshot,
                 "save what the window looks like as PNG, then quit; needs no display");
  app.add_flag("--dark", a.dark, "light letters on dark ground");
  app.add_option("--gl", a.backend, "who draws")->check(CLI::IsMember({"auto", "osmesa", "egl"}));
}

sandglass::vis::GlBackend backendOf(const std::string& name) {
  using sandglass::vis::GlBackend;
  return name == "osmesa" ? GlBackend::osmesa : name == "egl" ? GlBackend::egl : GlBackend::automatic;
}

QSize sizeOf(const std::string& text) {
  int width = 0, height = 0;
  if (std::sscanf(text.c_str(), "%dx%d", &width, &height) != 2 || width < 400 || height < 300)
    throw sandglass::InputError("--size " + text + ": a size is WIDTHxHEIGHT, at least 400x300");
  return {width, height};
}

/// Qt ends the program with a message of its own when there is no display; a screenshot needs none.
void choosePlatform(const Arguments& a) {
  const bool display = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
  if (display || std::getenv("QT_QPA_PLATFORM")) return;
  if (a.screenshot.empty())
    throw sandglass::InputError(
        "there is no display (DISPLAY and WAYLAND_DISPLAY are not set); use sandglass run, "
        "or --screenshot, or xvfb-run");
  setenv("QT_QPA_PLATFORM", "offscreen", 1);
}

int show(const Arguments& a, int argc, char** argv) {
  using namespace sandglass::desktop;
  choosePlatform(a);
  limitRasteriserThreads();
  QApplication application(argc, argv);
  setStyle(application);
  WindowOptions options;
  options.session.threads = a.threads;
  options.session.folder = a.folder;
  if (!a.columns.empty()) options.session.import = sandglass::readImportSettings(a.columns);
  options.backend = backendOf(a.backend);
  if (a.screenshot.empty())
    options.settingsFile =
        QStandardPaths::writableLocation(QStandardPaths::ConfigLocation) + "/sandglass/desktop.ini";
  options.asksNothing = !a.screenshot.empty();
  std::optional<sandglass::vis::View> view;
  if (!a.viewFile.empty()) view = sandglass::vis::readView(a.viewFile);
  bool shown = false;
  MainWindow window(options);
  window.resize(sizeOf(a.size));
  QObject::connect(&window.session(), &Session::opened, &window, [&] {
    if (std::exchange(shown, true)) return; // what is opened later is as it is
    if (view) window.showView(*view);
    if (a.at >= 0) window.showTime(a.at);
    if (a.point > 0 && window.session().current().sweep)
      window.findChild<SweepPanel*>()->diagram()->choose(a.point);
    if (a.run) window.session().start();
  });
  if (a.dark) window.commands().action("window.dark")->trigger();
  window.show();
  if (!a.path.empty()) window.open(QString::fromStdString(a.path));
  if (a.screenshot.empty()) return QApplication::exec();
  if (saveScreenshot(window, QString::fromStdString(a.screenshot))) return 0;
  const QString fault = window.bannerText();
  throw sandglass::InputError(fault.isEmpty()
                                  ? a.screenshot + ": there was nothing to show, or it cannot be written"
                                  : fault.toStdString());
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a write beyond the largest file allowed then fails, as on a full disk
  if (int code = 0; sandglass::vis::serveAsReader(argc, argv, code)) return code;
  CLI::App app{"Sandglass: granular flow in a window."};
  Arguments arguments;
  addOptions(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  sandglass::vis::registerMeshReaders();
  sandglass::vis::registerFlowReaders();
  sandglass::vis::registerFrameReaders();
  try {
    return show(arguments, argc, argv);
  } catch (const sandglass::InputError& e) {
    for (const auto& sentence : e.sentences())
      std::fprintf(stderr, "sandglass-desktop: %s\n", sentence.c_str());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "sandglass-desktop: %s\n", e.what());
    return 1;
  }
}
