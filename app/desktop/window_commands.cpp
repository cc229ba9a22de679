// The rows of the window's command table.

#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "vis/camera.h"

namespace sandglass::desktop {

namespace {

using Keys = QList<QKeySequence>;

constexpr double turn = 10; ///< [deg] of a key
constexpr double keyZoom = 1.25;
constexpr int manySteps = 100;
constexpr double textStep = 1.1;

Keys keys(std::initializer_list<const char*> texts) {
  Keys result;
  for (const char* text : texts)
    result << QKeySequence(QString(text));
  return result;
}

} // namespace

std::vector<Command> MainWindow::commandRows() {
  std::vector<Command> rows;
  for (auto part :
       {fileRows(), editRows(), runRows(), timeRows(), viewRows(), panelRows(), windowRows(), helpRows()})
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
       .icon = "open",
       .inToolBar = true,
       .perform = [this](bool) { chooseFile(); }},
      {.id = "file.openRun",
       .menu = menu,
       .name = "Open &run...",
       .keys = keys({"Ctrl+Shift+O"}),
       .toolTip = "Open the folder of a run",
       .icon = {},
       .perform = [this](bool) { chooseFolder(); }},
      {.id = "file.columns",
       .menu = menu,
       .name = "Co&lumns of a file...",
       .keys = keys({"Ctrl+I"}),
       .toolTip = "What the columns, units and sizes in a file of another program are",
       .icon = {},
       .perform = [this](bool) { chooseColumns(); }},
      {.id = "file.newTab",
       .menu = menu,
       .name = "New &tab",
       .keys = keys({"Ctrl+T"}),
       .toolTip = "Another scene or run beside those that are open; begins with the samples",
       .icon = {},
       .perform = [this](bool) { newTab(); }},
      {.id = "file.closeTab",
       .menu = menu,
       .name = "&Close tab",
       .keys = keys({"Ctrl+W"}),
       .toolTip = "Close what this tab shows; a run going on is stopped and can go on later",
       .icon = {},
       .perform = [this](bool) { closeTab(tabBar_->currentIndex()); }},
      {.id = "file.savePicture",
       .menu = menu,
       .name = "&Save picture...",
       .keys = keys({"Ctrl+S"}),
       .toolTip = "Save the picture as PNG, with what is needed to find its run again",
       .icon = "save",
       .inToolBar = true,
       .beginsGroup = true,
       .perform = [this](bool) { choosePictureFile(); }},
      {.id = "file.saveScene",
       .menu = menu,
       .name = "Save s&cene...",
       .keys = keys({"Ctrl+Shift+S"}),
       .toolTip = "Save the scene as it stands in the panel",
       .icon = {},
       .perform = [this](bool) { chooseSceneFile(); }},
      {.id = "file.saveSession",
       .menu = menu,
       .name = "Save sess&ion...",
       .keys = keys({"Ctrl+Shift+T"}),
       .toolTip = "Save all that is open, with views, moments and panels; open it like any file",
       .icon = {},
       .perform = [this](bool) { chooseSessionFile(); }},
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

std::vector<Command> MainWindow::editRows() {
  const QString menu = "&Edit";
  return {
      {.id = "edit.undo",
       .menu = menu,
       .name = "&Undo",
       .keys = keys({"Ctrl+Z"}),
       .toolTip = "Take back the last change of scene or view",
       .icon = {},
       .perform = [this](bool) { now_->undo.undo(); }},
      {.id = "edit.redo",
       .menu = menu,
       .name = "&Redo",
       .keys = keys({"Ctrl+Shift+Z", "Ctrl+Y"}),
       .toolTip = "Make the change again that was taken back",
       .icon = {},
       .perform = [this](bool) { now_->undo.redo(); }},
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
       .icon = "run",
       .inToolBar = true,
       .perform = [this](bool) { startOrPause(); }},
      {.id = "run.step",
       .menu = menu,
       .name = "One &step",
       .keys = keys({"S"}),
       .toolTip = "Advance one time step and pause",
       .icon = "step",
       .inToolBar = true,
       .perform = [this](bool) { step(1); }},
      {.id = "run.steps",
       .menu = menu,
       .name = "100 s&teps",
       .keys = keys({"Shift+S"}),
       .toolTip = "Advance a hundred time steps and pause",
       .icon = {},
       .perform = [this](bool) { step(manySteps); }},
      {.id = "run.stop",
       .menu = menu,
       .name = "S&top",
       .keys = keys({"Shift+F5"}),
       .toolTip = "Finish the step, write a checkpoint and end; Run goes on from there",
       .icon = "stop",
       .inToolBar = true,
       .perform = [this](bool) { session_->stop(); }},
      {.id = "run.endStage",
       .menu = menu,
       .name = "&End the stage",
       .keys = keys({"Shift+E"}),
       .toolTip = "The next stage begins after the next step",
       .icon = {},
       .beginsGroup = true,
       .perform = [this](bool) { changeRun({.endStage = true}); }},
      {.id = "run.branch",
       .menu = menu,
       .name = "&Branch from this frame",
       .keys = keys({"B"}),
       .toolTip = "What if: a new run, in a new tab, that shares the past up to the frame shown",
       .icon = {},
       .perform = [this](bool) { branch(); }},
  };
}

std::vector<Command> MainWindow::timeRows() {
  const QString menu = "&Time";
  return {
      {.id = "time.play",
       .menu = menu,
       .name = "P&lay saved frames",
       .keys = keys({"Ctrl+Space"}),
       .toolTip = "Show the saved frames one after the other, round and round",
       .icon = {},
       .checkable = true,
       .perform = [this](bool on) { time_->play(on); }},
      {.id = "time.back",
       .menu = menu,
       .name = "&Previous frame",
       .keys = keys({","}),
       .toolTip = "Show the saved frame before",
       .icon = "back",
       .inToolBar = true,
       .perform = [this](bool) { time_->stepBy(-1); }},
      {.id = "time.forward",
       .menu = menu,
       .name = "&Next frame",
       .keys = keys({"."}),
       .toolTip = "Show the saved frame after",
       .icon = "forward",
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
       .icon = "fit",
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
  rows.push_back({.id = "view.chooseNone",
                  .menu = menu,
                  .name = "Choose &no grains",
                  .keys = keys({"Esc"}),
                  .toolTip = "Forget the grains that a rectangle has chosen",
                  .icon = {},
                  .beginsGroup = true,
                  .perform = [this](bool) { chooseNone(); }});
  rows.push_back({.id = "view.track",
                  .menu = menu,
                  .name = "Trac&k of the grain",
                  .keys = keys({"T"}),
                  .toolTip = "Show or hide where the grain that was clicked has been",
                  .icon = {},
                  .beginsGroup = true,
                  .perform = [this](bool) { toggleTrack(); }});
  rows.push_back({.id = "view.orthographic",
                  .menu = menu,
                  .name = "&Parallel projection",
                  .keys = keys({"P"}),
                  .toolTip = "No perspective: equal lengths look equal",
                  .icon = {},
                  .checkable = true,
                  .perform = [this](bool on) {
                    now_->view.camera.orthographic = on;
                    keepView("parallel projection");
                    requestPicture();
                  }});
  rows.push_back({.id = "view.beside",
                  .menu = menu,
                  .name = "&Side by side",
                  .keys = keys({"Ctrl+B"}),
                  .toolTip = "The run of the tab looked at before beside this one, through one camera",
                  .icon = {},
                  .checkable = true,
                  .beginsGroup = true,
                  .perform = [this](bool on) { showBeside(on); }});
  return rows;
}

std::vector<Command> MainWindow::panelRows() {
  std::vector<Command> rows;
  const auto panel = [&](const QString& id, const QString& name, const QString& key, const QString& tip) {
    rows.push_back({.id = "panel." + id,
                    .menu = "&Panels",
                    .name = name,
                    .keys = key.isEmpty() ? Keys() : Keys{QKeySequence(key)},
                    .toolTip = tip,
                    .icon = {},
                    .checkable = true,
                    .checked = true,
                    .perform = [this, id](bool on) { togglePanel(id, on); }});
  };
  panel("view", "&View", "Ctrl+1", "How the picture is drawn");
  panel("run", "&Run", "Ctrl+2", "Stages, pace, and what may change while the run goes on");
  panel("scene", "&Scene", "Ctrl+3", "The scene as a form and as text");
  panel("accuracy", "S&peed and accuracy", "Ctrl+4", "The knobs, and what the run really does");
  panel("log", "&Log", "Ctrl+5", "What happened");
  panel("energies", "&Energies", "Ctrl+6", "Energies of the grains against time");
  panel("flow", "&Flow rate", "Ctrl+7", "Mass flow against time");
  panel("inspector", "&Grain", "Ctrl+8", "All about the grain that was clicked");
  panel("point", "&Point of a sweep", "Ctrl+9", "Parameters, results and curves of the chosen point");
  int number = 0;
  for (const auto& analysis : panelAnalyses()) {
    const QString id = QString::fromStdString(analysis.id);
    const QString key = id == "states" ? QString("Alt+0")
                        : ++number > 9 ? QString()
                                       : QString("Alt+%1").arg(number);
    panel(id, QString::fromStdString(analysis.title), key, QString::fromStdString(analysis.tip));
  }
  return rows;
}

std::vector<Command> MainWindow::windowRows() {
  const QString menu = "&Window";
  const auto row = [&](const char* id, const char* name, const char* key, const char* tip, auto perform) {
    return Command{.id = id,
                   .menu = menu,
                   .name = name,
                   .keys = keys({key}),
                   .toolTip = tip,
                   .icon = {},
                   .perform = perform};
  };
  std::vector<Command> rows{
      row("window.larger", "&Larger text", "Ctrl+=", "All text a tenth larger",
          [this](bool) { setTextScale(textScale_ * textStep); }),
      row("window.smaller", "&Smaller text", "Ctrl+-", "All text a tenth smaller",
          [this](bool) { setTextScale(textScale_ / textStep); }),
      row("window.dark", "&Dark", "Ctrl+D", "Light letters on dark ground; pictures keep their background",
          [this](bool on) { setDark(on); }),
      row("window.full", "&Full screen", "F11", "The window without its frame",
          [this](bool on) {
            setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
          }),
      row("window.next", "&Next tab", "Ctrl+Tab", "Show the tab after this one",
          [this](bool) { showTab((tabBar_->currentIndex() + 1) % tabs()); }),
  };
  rows[2].checkable = rows[3].checkable = true;
  return rows;
}

std::vector<Command> MainWindow::helpRows() {
  return {
      {.id = "help.keys",
       .menu = "&Help",
       .name = "&Keys and mouse",
       .keys = keys({"?", "F1"}),
       .toolTip = "All keys and mouse gestures",
       .icon = "help",
       .inToolBar = true,
       .perform = [this](bool) { showCheatSheet(); }},
  };
}

} // namespace sandglass::desktop
