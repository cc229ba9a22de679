// Tabs of the window, and what happens to what is open in them.

#include "app/desktop/accuracy_panel.h"
#include "app/desktop/chart_panel.h"
#include "app/desktop/inspector_panel.h"
#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/run_panel.h"
#include "app/desktop/scene_panel.h"
#include "app/desktop/start_page.h"
#include "app/desktop/state_panel.h"
#include "app/desktop/text_panels.h"
#include "app/desktop/undo_commands.h"
#include "app/desktop/view_panel.h"

#include <QSignalBlocker>
#include <QStatusBar>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr int sceneChange = 1;             ///< id of undo commands
constexpr qint64 oneTyping = 1500;         ///< [ms] within which edits of one field are one step of undo
const char* const nothingOpen = "New tab"; ///< name of a tab

QString titleOf(const Document& document) {
  const Opened& current = document.session->current();
  if (current.path.empty()) return {};
  if (current.scene && !current.scene->title.empty()) return QString::fromStdString(current.scene->title);
  return QString::fromStdString(current.path.string());
}

} // namespace

std::string runName(const Document& document) {
  const Opened& current = document.session->current();
  const auto& place = current.runFolder.empty() ? current.path : current.runFolder;
  return (place.filename() == "scene.toml" ? place.parent_path() : place).filename().string();
}

Document* MainWindow::addDocument() {
  SessionOptions options = options_.session;
  if (!documents_.empty()) options.folder.clear(); // -o names the folder of the first run
  auto* document = documents_.emplace_back(std::make_unique<Document>(options)).get();
  undo_.addStack(&document->undo);
  connectSession(document);
  const QSignalBlocker blocker(tabBar_);
  tabBar_->addTab(nothingOpen);
  tabBar_->setVisible(tabs() > 1);
  return document;
}

void MainWindow::spareSimulations() {
  const bool any = std::any_of(documents_.begin(), documents_.end(), [](const auto& document) {
    return document->session->runs() && !document->session->isPaused();
  });
  drawing_->setSimulationRuns(any);
  analyses_->setSimulationRuns(any);
}

void MainWindow::connectSession(Document* d) {
  Session* s = d->session.get();
  const auto here = [this, d] { return now_ == d; };
  connect(s, &Session::opened, this, [this, d] { onOpened(d); });
  connect(s, &Session::openFailed, this, &MainWindow::onOpenFailed);
  connect(s, &Session::stateChanged, this, [this, here] {
    if (here()) onState();
    spareSimulations();
  });
  connect(s, &Session::frameArrived, this, [this, d, here] {
    if (here()) onFrame();
    if (now_ && now_->beside == d) requestPicture();
  });
  connect(s, &Session::progressArrived, this, [this, here] {
    if (here()) onState();
  });
  connect(s, &Session::samplesArrived, this, [this, here] {
    if (here()) curvesOutdated_ = true;
  });
  connect(s, &Session::sceneChanged, this, [this, d, here] {
    d->sceneText = d->session->current().resolved; // what the folder of the run holds now
    if (!here()) return;
    run_->setScene(session_->current().scene);
    scene_->setScene(d->sceneText, QString::fromStdString(session_->current().path.string()), false);
  });
  connect(s, &Session::logged, this,
          [this](int level, const QString& text) { say(static_cast<LogLevel>(level), text); });
  connect(s, &Session::runEnded, this, [this, here](bool complete, const QString& fault) {
    if (here()) return onRunEnded(complete, fault);
    if (!fault.isEmpty()) complain(fault.split('\n'));
  });
}

void MainWindow::newTab() {
  addDocument();
  showTab(tabs() - 1);
}

void MainWindow::showTab(int index) {
  if (index == tabBar_->currentIndex() && now_ == documents_[static_cast<std::size_t>(index)].get()) return;
  tabBar_->setCurrentIndex(index);
}

void MainWindow::closeTab(int index) {
  Document* document = documents_[static_cast<std::size_t>(index)].get();
  showTab(index);
  if (document->session->runs() &&
      !mayStop("The simulation in this tab is running. Stop it and close the tab? A checkpoint is kept."))
    return;
  document->session->disconnect(this);
  if (tabs() == 1) addDocument();
  {
    const QSignalBlocker blocker(tabBar_);
    tabBar_->removeTab(index);
  }
  forgetBeside(document);
  now_ = before_ = nullptr;
  session_ = nullptr;
  documents_.erase(documents_.begin() + index); // waits for the checkpoint
  spareSimulations();
  tabBar_->setVisible(tabs() > 1);
  enter(documents_[static_cast<std::size_t>(std::clamp(tabBar_->currentIndex(), 0, tabs() - 1))].get());
}

void MainWindow::enter(Document* document) {
  if (now_) now_->chosen = time_->chosen();
  if (now_ && now_ != document) before_ = now_;
  now_ = document;
  session_ = document->session.get();
  undo_.setActiveStack(&document->undo);
  const auto at =
      std::find_if(documents_.begin(), documents_.end(), [&](const auto& d) { return d.get() == now_; });
  const QSignalBlocker blocker(tabBar_);
  tabBar_->setCurrentIndex(static_cast<int>(at - documents_.begin()));
  const QSignalBlocker alsoThis(commands_->action("view.beside"));
  commands_->action("view.beside")->setChecked(now_->beside != nullptr);
  statusBar()->clearMessage(); // of the tab before
  showDocument();
  onState();
}

void MainWindow::nameTab(const Document& document) {
  const auto at =
      std::find_if(documents_.begin(), documents_.end(), [&](const auto& d) { return d.get() == &document; });
  const int index = static_cast<int>(at - documents_.begin());
  QString name = QString::fromStdString(runName(document));
  if (document.session->runs()) name = QString(QChar(0x25B6)) + " " + name;
  tabBar_->setTabText(index, name.isEmpty() ? nothingOpen : name);
  tabBar_->setTabToolTip(index, titleOf(document));
}

void MainWindow::open(const QString& path) {
  if (path.endsWith(".sandglass")) return openSession(path);
  if (session_->runs()) newTab();
  statusBar()->showMessage("Opening " + path + " ...");
  session_->open(path);
}

void MainWindow::branch() {
  if (!now_->shown || session_->current().runFolder.empty()) return;
  const auto source = session_->current().runFolder;
  const auto step = now_->shown->step;
  newTab();
  statusBar()->showMessage(QString("Branching at step %L1 ...").arg(static_cast<qlonglong>(step)));
  session_->openBranch(source, step);
}

void MainWindow::onOpened(Document* document) {
  const Opened& current = document->session->current();
  document->shown.reset();
  document->preview.reset();
  document->previewScene.reset();
  document->chosen.reset();
  document->grain = -1;
  document->grainBeside = false;
  document->columnsOffered = false;
  document->undo.clear();
  document->sceneText = current.sceneText;
  document->view.camera.preset = "fit";
  if (current.view) document->view = *current.view;
  document->kept = document->view;
  if (current.time && current.store->size() > 0) document->chosen = current.store->nearest(*current.time);
  const QString name = QString::fromStdString(current.path.string());
  say(LogLevel::info, "Opened " + name + ".");
  remember(name);
  nameTab(*document);
  if (current.beside) {
    Document* other = addDocument();
    other->session->open(QString::fromStdString(current.beside->string()));
    setBeside(document, other);
  }
  if (now_->beside == document) requestPicture();
  if (document != now_) return;
  statusBar()->clearMessage();
  banner_->setSentences({});
  showDocument();
}

/// All panels show the document of this tab, from scratch.
void MainWindow::showDocument() {
  const Opened& current = session_->current();
  const bool open = session_->isOpen();
  const QString title = titleOf(*now_);
  setWindowTitle(open ? title + " - Sandglass" : "Sandglass");
  centre_->setCurrentIndex(open ? 1 : 0);
  range_ = {};
  viewPanel_->setView(now_->view);
  picture_->clear();
  analyses_->forget();
  picture_->setHint(title, current.scene ? "Press F5 or Space to run this scene." : "");
  for (auto& [id, panel] : charts_)
    panel->clear(panel->property("hint").toString());
  states_->clear();
  showSweep();
  if (!open) {
    scene_->setScene({}, {}, false);
    run_->setScene(std::nullopt);
    accuracy_->setScene(std::nullopt);
    time_->setFrames(0, false);
    return;
  }
  scene_->setScene(now_->sceneText, QString::fromStdString(current.scene ? current.scene->file : ""),
                   current.store->size() == 0);
  run_->setScene(current.scene);
  run_->setSpeedLimit(session_->speedLimit());
  accuracy_->setScene(current.scene);
  inspect();
  const auto chosen = now_->chosen;
  time_->setFrames(current.store->size(), session_->runs());
  time_->choose(std::nullopt);
  if (chosen) time_->choose(*chosen);
  time_->setTime("");
  outdated_ = curvesOutdated_ = true;
  refreshCurves();
  scanRunRange();
  requestPicture();
}

void MainWindow::onSceneEdited(const QString& before, const QString& after, const QString& what) {
  now_->sceneText = after;
  Document* document = now_;
  now_->undo.push(new ChangeCommand<QString>(
      sceneChange, "edit " + what, before, after,
      [this, document](const QString& text) {
        document->sceneText = text;
        if (document == now_) scene_->setText(text);
      },
      oneTyping));
}

void MainWindow::onChecked(const SceneChecker::Outcome& outcome) {
  if (outcome.text != now_->sceneText || !session_->isOpen()) return;
  const bool start = std::exchange(startWhenChecked_, false);
  if (outcome.scene && !session_->runs()) {
    const auto store = session_->current().store;
    session_->setScene(*outcome.scene, outcome.text, outcome.resolved);
    run_->setScene(session_->current().scene);
    accuracy_->setScene(session_->current().scene);
    if (outcome.preview) now_->preview = outcome.preview;
    if (store != session_->current().store) {
      range_ = {};
      time_->setFrames(0, false);
      say(LogLevel::info, "The scene is another one now: Run begins a new run of it.");
      curvesOutdated_ = true;
      refreshCurves();
    }
    if (session_->current().store->size() == 0 && !session_->liveFrame()) requestPicture();
  }
  if (start) startOrPause();
}

void MainWindow::onFrame() {
  const FramePtr frame = session_->liveFrame();
  widenRunRange(*frame);
  if (!time_->chosen()) requestPicture();
}

void MainWindow::onState() {
  const bool runs = session_->runs(), paused = session_->isPaused(), open = session_->isOpen();
  if (open) time_->setFrames(session_->current().store->size(), runs);
  auto* start = commands_->action("run.start");
  start->setEnabled(runs || session_->canStart());
  start->setText(runs && !paused ? "&Pause" : paused ? "&Go on" : "&Run");
  setRunIcon(runs && !paused);
  for (const char* id : {"run.step", "run.steps"})
    commands_->action(id)->setEnabled(runs || session_->canStart());
  for (const char* id : {"run.stop", "run.endStage"})
    commands_->action(id)->setEnabled(runs);
  const bool canBranch =
      open && now_->shown && !session_->current().runFolder.empty() && session_->current().scene;
  commands_->action("run.branch")->setEnabled(canBranch);
  run_->setCanBranch(canBranch);
  for (const char* id : {"time.back", "time.forward", "time.first", "time.last", "time.play"})
    commands_->action(id)->setEnabled(open && session_->current().store->size() > 0);
  commands_->action("file.savePicture")->setEnabled(now_->shown != nullptr);
  commands_->action("file.saveScene")->setEnabled(open && session_->current().scene);
  scene_->setEditable(!runs,
                      "The scene runs. What may change meanwhile is in the panel Run; to edit, stop first.");
  if (runs && !paused && !curveTimer_.isActive()) curveTimer_.start();
  if (!runs) curveTimer_.stop();
  nameTab(*now_);
  showState();
}

void MainWindow::showState() {
  const bool runs = session_->runs(), paused = session_->isPaused();
  QString state;
  const auto& progress = session_->progress();
  run_->setProgress(progress, runs);
  if (progress && runs) {
    accuracy_->setProgress(*progress);
    state = QString("%1: %2 %")
                .arg(QString::fromStdString(progress->stage))
                .arg(100 * progress->fraction, 0, 'f', 1);
    if (paused)
      state += ", paused";
    else if (progress->secondsLeft >= 0)
      state += ", " + durationText(progress->secondsLeft) + " left";
    statusBar()->showMessage(QString("%L1 grains    step %L2    %3 million grain-steps a second")
                                 .arg(progress->grains)
                                 .arg(static_cast<qlonglong>(progress->step))
                                 .arg(progress->grainStepsPerSecond / 1e6, 0, 'f', 2));
  } else if (runs) {
    state = paused ? "paused" : "starting";
  } else if (progress && progress->fraction >= 1) {
    state = "complete";
  } else if (session_->isOpen() && session_->current().canResume) {
    state = "saved run";
  } else if (session_->isOpen() && session_->current().scene) {
    state = "not run yet";
  }
  time_->setProgress(progress, state);
}

void MainWindow::onRunEnded(bool complete, const QString& fault) {
  if (!fault.isEmpty())
    complain(fault.split('\n'));
  else
    say(LogLevel::info, complete ? "The run is complete." : "The run is stopped; Run goes on from here.");
  curvesOutdated_ = true;
  refreshCurves();
  outdated_ = true;
  requestPicture();
}

} // namespace sandglass::desktop
