// The rows of the window's command table.

#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/style.h"
#include "vis/camera.h"

namespace sandglass::desktop {

namespace {

using Keys = QList<QKeySequence>;

constexpr double turn = 10; ///< [deg] of a key
constexpr double keyZoom = 1.25;
constexpr int manySteps = 100;

Keys keys(std::initializer_list<const char*> texts) {
  Keys result;
  for (const char* text : texts)
    result << QKeySequence(QString(text));
  return result;
}

} // namespace

std::vector<Command> MainWindow::commandRows() {
  std::vector<Command> rows;
  for (auto part : {fileRows(), runRows(), viewRows(), panelRows(), helpRows()})
    for (auto& row : part)
      rows.push_back(std::move(row));
  return rows;
}

std::vector<Command> MainWindow::fileRows() {
  const QString menu = "&File";
  return {
      {.id = "file.open",
       .menu = menu,
       .name = "&Open...",
       .keys = keys({"Ctrl+O"}),
       .toolTip = "Open a scene, a file of frames or a saved picture",
       .icon = icon("open"),
       .inToolBar = true,
       .perform = [this](bool) { chooseFile(); }},
      {.id = "file.openRun",
       .menu = menu,
       .name = "Open &run...",
       .keys = keys({"Ctrl+Shift+O"}),
       .toolTip = "Open the folder of a run",
       .icon = {},
       .perform = [this](bool) { chooseFolder(); }},
      {.id = "file.savePicture",
       .menu = menu,
       .name = "&Save picture...",
       .keys = keys({"Ctrl+S"}),
       .toolTip = "Save the picture as PNG, with what is needed to find its run again",
       .icon = icon("save"),
       .inToolBar = true,
       .beginsGroup = true,
       .perform = [this](bool) { choosePictureFile(); }},
      {.id = "file.quit",
       .menu = menu,
       .name = "&Quit",
       .keys = keys({"Ctrl+Q"}),
       .toolTip = "Close the window; a run going on is stopped and can go on later",
       .icon = {},
       .beginsGroup = true,
       .perform = [this](bool) { close(); }},
  };
}

std::vector<Command> MainWindow::runRows() {
  const QString menu = "&Run";
  return {
      {.id = "run.start",
       .menu = menu,
       .name = "&Run",
       .keys = keys({"F5", "Space"}),
       .toolTip = "Run the scene, or go on; while it runs: pause",
       .icon = icon("run"),
       .inToolBar = true,
       .perform = [this](bool) { startOrPause(); }},
      {.id = "run.step",
       .menu = menu,
       .name = "One &step",
       .keys = keys({"S"}),
       .toolTip = "Advance one time step and pause",
       .icon = icon("step"),
       .inToolBar = true,
       .perform = [this](bool) { session_->step(1); }},
      {.id = "run.steps",
       .menu = menu,
       .name = "100 s&teps",
       .keys = keys({"Shift+S"}),
       .toolTip = "Advance a hundred time steps and pause",
       .icon = {},
       .perform = [this](bool) { session_->step(manySteps); }},
      {.id = "run.stop",
       .menu = menu,
       .name = "S&top",
       .keys = keys({"Shift+F5"}),
       .toolTip = "Finish the step, write a checkpoint and end; Run goes on from there",
       .icon = icon("stop"),
       .inToolBar = true,
       .perform = [this](bool) { session_->stop(); }},
      {.id = "time.back",
       .menu = menu,
       .name = "&Previous frame",
       .keys = keys({","}),
       .toolTip = "Show the saved frame before",
       .icon = icon("back"),
       .inToolBar = true,
       .beginsGroup = true,
       .perform = [this](bool) { time_->stepBy(-1); }},
      {.id = "time.forward",
       .menu = menu,
       .name = "&Next frame",
       .keys = keys({"."}),
       .toolTip = "Show the saved frame after",
       .icon = icon("forward"),
       .inToolBar = true,
       .perform = [this](bool) { time_->stepBy(1); }},
      {.id = "time.first",
       .menu = menu,
       .name = "&First frame",
       .keys = keys({"Home"}),
       .toolTip = "Show the first saved frame",
       .icon = {},
       .perform = [this](bool) { time_->choose(0); }},
      {.id = "time.last",
       .menu = menu,
       .name = "&Live or last frame",
       .keys = keys({"End"}),
       .toolTip = "Follow the simulation, or show the last saved frame",
       .icon = {},
       .perform = [this](bool) { time_->choose(std::nullopt); }},
  };
}

std::vector<Command> MainWindow::viewRows() {
  const QString menu = "&View";
  std::vector<Command> rows{
      {.id = "view.fit",
       .menu = menu,
       .name = "&Fit",
       .keys = keys({"F"}),
       .toolTip = "See everything",
       .icon = icon("fit"),
       .inToolBar = true,
       .perform = [this](bool) { usePreset("fit"); }},
  };
  int key = 0;
  for (const auto& preset : vis::cameraPresets()) {
    if (preset == "fit") continue;
    const QString name = QString::fromStdString(preset);
    Command row{.id = "view." + name,
                .menu = menu,
                .name = "From " + name,
                .keys = {QKeySequence(QString::number(++key))},
                .toolTip = QString("Look from %1").arg(name),
                .icon = {},
                .perform = [this, preset](bool) { usePreset(preset); }};
    if (preset == "iso") row.name = "From a &corner", row.toolTip = "Look from a corner";
    rows.push_back(std::move(row));
  }
  const auto camera = [&](const char* id, const char* name, const char* key, const char* tip, auto perform) {
    rows.push_back({.id = id,
                    .menu = menu,
                    .name = name,
                    .keys = keys({key}),
                    .toolTip = tip,
                    .icon = {},
                    .beginsGroup = QString(id) == "view.in",
                    .perform = perform});
  };
  camera("view.in", "Zoom &in", "+", "Come nearer", [this](bool) { picture_->zoomBy(keyZoom); });
  camera("view.out", "Zoom &out", "-", "Go farther away", [this](bool) { picture_->zoomBy(1 / keyZoom); });
  camera("view.turnLeft", "Turn left", "Ctrl+Left", "Walk round the scene to the left",
         [this](bool) { picture_->orbitBy(-turn, 0); });
  camera("view.turnRight", "Turn right", "Ctrl+Right", "Walk round the scene to the right",
         [this](bool) { picture_->orbitBy(turn, 0); });
  camera("view.turnUp", "Turn up", "Ctrl+Up", "Look from higher up",
         [this](bool) { picture_->orbitBy(0, turn); });
  camera("view.turnDown", "Turn down", "Ctrl+Down", "Look from lower down",
         [this](bool) { picture_->orbitBy(0, -turn); });
  rows.push_back({.id = "view.orthographic",
                  .menu = menu,
                  .name = "&Parallel projection",
                  .keys = keys({"P"}),
                  .toolTip = "No perspective: equal lengths look equal",
                  .icon = {},
                  .checkable = true,
                  .perform = [this](bool on) {
                    view_.camera.orthographic = on;
                    requestPicture();
                  }});
  return rows;
}

std::vector<Command> MainWindow::panelRows() {
  std::vector<Command> rows;
  const auto panel = [&](const char* id, const char* name, const char* key) {
    rows.push_back({.id = QString("panel.") + id,
                    .menu = "&Panels",
                    .name = name,
                    .keys = keys({key}),
                    .toolTip = QString("Show or hide this panel"),
                    .icon = {},
                    .checkable = true,
                    .checked = true,
                    .perform = [this, id](bool on) { docks_.at(id)->setVisible(on); }});
  };
  panel("view", "&View", "Ctrl+1");
  panel("scene", "&Scene", "Ctrl+2");
  panel("log", "&Log", "Ctrl+3");
  panel("energies", "&Energies", "Ctrl+4");
  panel("flow", "&Flow rate", "Ctrl+5");
  panel("gr", "&g(r)", "Ctrl+6");
  return rows;
}

std::vector<Command> MainWindow::helpRows() {
  return {
      {.id = "help.keys",
       .menu = "&Help",
       .name = "&Keys and mouse",
       .keys = keys({"?", "F1"}),
       .toolTip = "All keys and mouse gestures",
       .icon = icon("help"),
       .inToolBar = true,
       .perform = [this](bool) { showCheatSheet(); }},
  };
}

} // namespace sandglass::desktop
