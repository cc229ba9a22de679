#include "app/desktop/main_window.h"

#include "app/desktop/chart_panel.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/text_panels.h"
#include "app/desktop/view_panel.h"
#include "sim/base/error.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QMessageBox>
#include <QMimeData>
#include <QStatusBar>
#include <QVBoxLayout>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr int curveInterval = 1000;     ///< [ms] between looks at the probes' new samples
constexpr int grainsWhileMoving = 4000; ///< drawn while the camera moves

const char* const hintTitle = "Open a scene or a run";
const char* const hintText = "Drop a scene (.toml), a run folder or a file of frames here, or press Ctrl+O.\n"
                             "Samples to start from are in sample_runs.    Press ? for all keys.";

} // namespace

MainWindow::MainWindow(const WindowOptions& options)
    : options_(options), session_(std::make_unique<Session>(options.session)),
      drawing_(std::make_unique<DrawingThread>(options.backend)),
      pairs_(std::make_unique<PairCorrelationWorker>()) {
  setWindowTitle("Sandglass");
  setAcceptDrops(true);
  setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowTabbedDocks | QMainWindow::AllowNestedDocks);
  pool_.setMaxThreadCount(1);
  buildCentre();
  commands_ = std::make_unique<CommandTable>(this, commandRows());
  commands_->fill(menuBar());
  auto* bar = addToolBar("Tools");
  bar->setObjectName("tools");
  bar->setMovable(false);
  bar->setIconSize({20, 20});
  bar->setToolButtonStyle(Qt::ToolButtonIconOnly);
  commands_->fill(bar);
  buildDocks();
  connectDrawing();
  connectSession();
  curveTimer_.setInterval(curveInterval);
  connect(&curveTimer_, &QTimer::timeout, this, &MainWindow::refreshCurves);
  resize(1440, 900);
  onState();
}

MainWindow::~MainWindow() {
  session_->disconnect(this);
  session_->stopAndWait();
  pool_.waitForDone();
}

void MainWindow::buildCentre() {
  auto* centre = new QWidget(this);
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(banner_ = new Banner(centre));
  column->addWidget(picture_ = new PictureView(centre), 1);
  column->addWidget(time_ = new TimeBar(centre));
  setCentralWidget(centre);
  picture_->setHint(hintTitle, hintText);

  connect(picture_, &PictureView::cameraMoved, this, [this](const vis::Camera& camera, bool interactive) {
    view_.camera = camera;
    requestPicture(interactive);
  });
  connect(picture_, &PictureView::resized, this, [this] { requestPicture(); });
  connect(picture_, &PictureView::clicked, this, [this](QPoint pixel) { drawing_->pick(pixel); });
  connect(picture_, &PictureView::fitWanted, this, [this] { usePreset("fit"); });
  connect(time_, &TimeBar::chosenChanged, this, [this] {
    pairsOutdated_ = true;
    requestPicture();
  });
}

QDockWidget* MainWindow::addDock(const QString& id, const QString& title, QWidget* content,
                                 Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName("dock." + id);
  dock->setWidget(content);
  addDockWidget(area, dock);
  docks_[id] = dock;
  QAction* action = commands_->action("panel." + id);
  connect(dock->toggleViewAction(), &QAction::toggled, action, &QAction::setChecked);
  return dock;
}

void MainWindow::buildDocks() {
  viewPanel_ = new ViewPanel;
  viewPanel_->setView(view_);
  addDock("view", "View", viewPanel_, Qt::LeftDockWidgetArea);
  auto* scene = addDock("scene", "Scene", scene_ = new ScenePanel, Qt::LeftDockWidgetArea);
  auto* log = addDock("log", "Log", log_ = new LogPanel, Qt::LeftDockWidgetArea);
  tabifyDockWidget(scene, log);
  scene->raise();
  connect(viewPanel_, &ViewPanel::changed, this, [this] {
    viewPanel_->apply(view_);
    scanRunRange();
    requestPicture();
  });

  const auto chart = [&](const char* id, const QString& title, const QString& hint) {
    auto* panel = charts_[id] = new ChartPanel(id, hint);
    addDock(id, title, panel, Qt::RightDockWidgetArea);
    connect(panel, &ChartPanel::wanted, this,
            [this](const QString& name, const analysis::Curve& curve, QSize pixels) {
              drawing_->drawChart(name, curve, pixels);
            });
  };
  chart("energies", "Energies", "Energies of the grains, once a scene with an energies probe runs.");
  chart("flow", "Flow rate", "Mass flow, once a scene with a flow_rate probe runs.");
  chart("gr", "Pair correlation g(r)", "g(r) of the frame that is shown.");
  resizeDocks({docks_["view"], docks_["energies"]}, {300, 400}, Qt::Horizontal);
  resizeDocks({docks_["view"], docks_["scene"]}, {410, 380}, Qt::Vertical);
}

void MainWindow::connectDrawing() {
  connect(drawing_.get(), &DrawingThread::pictureReady, this, &MainWindow::onPicture);
  connect(drawing_.get(), &DrawingThread::chartReady, this,
          [this](const QString& panel, const QImage& image) { charts_.at(panel)->setImage(image); });
  connect(drawing_.get(), &DrawingThread::picked, this, &MainWindow::onPicked);
  connect(drawing_.get(), &DrawingThread::failed, this,
          [this](const QString& sentence) { complain({sentence}); });
  connect(drawing_.get(), &DrawingThread::started, this,
          [this](const QString& backend) { say(LogLevel::info, "Pictures by " + backend + "."); });
  connect(drawing_.get(), &DrawingThread::saved, this, [this](const QString& file, const QString& fault) {
    if (fault.isEmpty())
      say(LogLevel::info, "The picture is saved in " + file + ".");
    else
      complain({fault});
    requestPicture(); // picking looks at the picture drawn last
    Q_EMIT pictureSaved(file, fault);
  });
  connect(pairs_.get(), &PairCorrelationWorker::ready, this, [this] {
    const auto outcome = pairs_->take();
    if (!outcome) return;
    if (outcome->curve)
      charts_.at("gr")->setCurve(*outcome->curve);
    else
      charts_.at("gr")->clear(outcome->fault);
  });
}

void MainWindow::connectSession() {
  connect(session_.get(), &Session::opened, this, &MainWindow::onOpened);
  connect(session_.get(), &Session::openFailed, this, &MainWindow::complain);
  connect(session_.get(), &Session::stateChanged, this, &MainWindow::onState);
  connect(session_.get(), &Session::frameArrived, this, &MainWindow::onFrame);
  connect(session_.get(), &Session::progressArrived, this, &MainWindow::onState);
  connect(session_.get(), &Session::samplesArrived, this, [this] { curvesOutdated_ = true; });
  connect(session_.get(), &Session::logged, this,
          [this](int level, const QString& text) { say(static_cast<LogLevel>(level), text); });
  connect(session_.get(), &Session::runEnded, this, &MainWindow::onRunEnded);
}

void MainWindow::open(const QString& path) {
  statusBar()->showMessage("Opening " + path + " ...");
  session_->open(path);
}

void MainWindow::onOpened() {
  const Opened& current = session_->current();
  statusBar()->clearMessage();
  banner_->setSentences({});
  const QString name = QString::fromStdString(current.path.string());
  const QString title = current.scene ? QString::fromStdString(current.scene->title) : QString();
  setWindowTitle((title.isEmpty() ? name : title) + " - Sandglass");
  say(LogLevel::info, "Opened " + name + ".");
  scene_->setScene(current.sceneText, current.resolved);
  shown_.reset();
  range_ = {};
  view_.camera.preset = "fit";
  if (current.view) {
    view_ = *current.view;
    viewPanel_->setView(view_);
  }
  picture_->clear();
  picture_->setHint(title.isEmpty() ? name : title, "Press F5 or Space to run this scene.");
  for (auto& [id, panel] : charts_)
    panel->clear(id == "gr" ? "g(r) of the frame that is shown." : "");
  time_->setFrames(current.store->size(), false);
  time_->choose(std::nullopt);
  if (current.time && current.store->size() > 0) time_->choose(current.store->nearest(*current.time));
  time_->setTime("");
  pairsOutdated_ = curvesOutdated_ = true;
  refreshCurves();
  scanRunRange();
  requestPicture();
}

void MainWindow::onFrame() {
  const FramePtr frame = session_->liveFrame();
  widenRunRange(*frame);
  if (!time_->chosen()) requestPicture();
}

void MainWindow::onState() {
  const bool runs = session_->runs(), paused = session_->isPaused();
  const bool open = session_->isOpen();
  drawing_->setSimulationRuns(runs && !paused);
  if (open) time_->setFrames(session_->current().store->size(), runs);
  auto* start = commands_->action("run.start");
  start->setEnabled(runs || session_->canStart());
  start->setText(runs && !paused ? "&Pause" : paused ? "&Go on" : "&Run");
  setRunIcon(runs && !paused);
  for (const char* id : {"run.step", "run.steps"})
    commands_->action(id)->setEnabled(runs || session_->canStart());
  commands_->action("run.stop")->setEnabled(runs);
  for (const char* id : {"time.back", "time.forward", "time.first", "time.last"})
    commands_->action(id)->setEnabled(open && session_->current().store->size() > 0);
  commands_->action("file.savePicture")->setEnabled(shown_ != nullptr);
  if (runs && !paused && !curveTimer_.isActive()) curveTimer_.start();
  if (!runs) curveTimer_.stop();

  QString state;
  const auto& progress = session_->progress();
  if (progress && (runs || paused)) {
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
    state = "starting";
  } else if (progress && progress->fraction >= 1) {
    state = "complete";
  } else if (open && session_->current().canResume) {
    state = "saved run";
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
  pairsOutdated_ = true;
  requestPicture();
}

void MainWindow::requestPicture(bool interactive) {
  if (!session_->isOpen()) return;
  const auto& store = session_->current().store;
  PictureOrder order;
  order.interactive = interactive;
  if (const auto index = time_->chosen()) {
    if (store->size() == 0) return;
    order.index = std::min(*index, store->size() - 1);
    order.source = store;
  } else if (!(order.frame = session_->liveFrame())) {
    return;
  }
  if (range_.known && view_.colouring.range == vis::ColourRange::run) {
    view_.colouring.low = range_.limits[0];
    view_.colouring.high = range_.limits[1];
  }
  const QSize pixels = picture_->pixels();
  view_.width = pixels.width();
  view_.height = pixels.height();
  order.view = view_;
  if (interactive) order.view.maximumGrains = grainsWhileMoving;
  order.number = ++ordered_;
  drawing_->draw(std::move(order));
}

void MainWindow::onPicture() {
  auto picture = drawing_->takePicture();
  if (!picture) return;
  const bool other = picture->frame != shown_;
  shown_ = picture->frame;
  drawn_ = picture->number;
  picture_->show(std::move(*picture));
  if (!other) return;
  viewPanel_->setFrame(*shown_);
  time_->setTime(QString("t = %1 s    %L2 grains").arg(shown_->time, 0, 'f', 4).arg(shown_->size()));
  commands_->action("file.savePicture")->setEnabled(true);
  requestPairCorrelation(std::exchange(pairsOutdated_, false));
}

void MainWindow::requestPairCorrelation(bool restart) {
  const auto* panel = charts_.at("gr");
  if (!panel->isVisible() || !shown_ || shown_->size() < 2) return;
  const auto& scene = session_->current().scene;
  const bool beside = session_->runs() && !session_->isPaused();
  pairs_->compute(shown_, scene ? Vec3(-scene->gravity) : Vec3::Zero(), restart, beside);
}

void MainWindow::refreshCurves() {
  if (!std::exchange(curvesOutdated_, false) || !session_->isOpen()) return;
  const Opened& current = session_->current();
  if (!current.scene) return;
  if (auto curve = current.series.energies(*current.scene))
    charts_.at("energies")->setCurve(std::move(*curve));
  else
    charts_.at("energies")->clear("No samples of an energies probe.");
  if (auto curve = current.series.flowRate(*current.scene))
    charts_.at("flow")->setCurve(std::move(*curve));
  else
    charts_.at("flow")->clear("No samples of a flow_rate probe.");
}

bool MainWindow::isSettled() const {
  return !session_->isOpening() && drawn_ == ordered_ &&
         std::all_of(charts_.begin(), charts_.end(), [](const auto& c) { return c.second->isCurrent(); }) &&
         pairs_->isIdle();
}

void MainWindow::say(LogLevel level, const QString& text) {
  log_->add(static_cast<int>(level), text);
}

void MainWindow::complain(const QStringList& sentences) {
  statusBar()->clearMessage();
  for (const auto& sentence : sentences)
    say(LogLevel::error, sentence);
  banner_->setSentences(sentences);
}

QString MainWindow::bannerText() const {
  return banner_->isVisible() ? banner_->text() : QString();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (session_->runs() && !options_.asksNothing) {
    const auto answer = QMessageBox::question(
        this, "Sandglass",
        "The simulation is running. Stop it and close? A checkpoint is kept; Run goes on from it later.",
        QMessageBox::Close | QMessageBox::Cancel, QMessageBox::Cancel);
    if (answer != QMessageBox::Close) return event->ignore();
  }
  hide();
  session_->stopAndWait();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const auto urls = event->mimeData()->urls();
  if (!urls.isEmpty() && urls.first().isLocalFile()) open(urls.first().toLocalFile());
}

} // namespace sandglass::desktop
