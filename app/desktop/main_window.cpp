#include "app/desktop/main_window.h"

#include "app/desktop/accuracy_panel.h"
#include "app/desktop/calm_wheel.h"
#include "app/desktop/chart_panel.h"
#include "app/desktop/inspector_panel.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/point_panel.h"
#include "app/desktop/run_panel.h"
#include "app/desktop/scene_panel.h"
#include "app/desktop/start_page.h"
#include "app/desktop/state_panel.h"
#include "app/desktop/style.h"
#include "app/desktop/sweep_panel.h"
#include "app/desktop/text_panels.h"
#include "app/desktop/view_panel.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QMessageBox>
#include <QMimeData>
#include <QScrollArea>
#include <QScrollBar>
#include <QSplitter>
#include <QStatusBar>
#include <QVBoxLayout>

namespace sandglass::desktop {

namespace {

constexpr int curveInterval = 1000; ///< [ms] between looks at the probes' new samples

/// A panel that may be less high than what it holds, but not less wide.
class UprightScroll : public QScrollArea {
public:
  QSize minimumSizeHint() const override {
    return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(),
            QScrollArea::minimumSizeHint().height()};
  }

protected:
  bool eventFilter(QObject* watched, QEvent* event) override { // rows come and go with what is open
    if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return QScrollArea::eventFilter(watched, event);
  }
};

QScrollArea* scrolling(QWidget* content) {
  auto* area = new UprightScroll;
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setWidget(content);
  return area;
}

} // namespace

MainWindow::MainWindow(const WindowOptions& options)
    : options_(options), drawing_(std::make_unique<DrawingThread>(options.backend)),
      analyses_(std::make_unique<AnalysisWorker>()) {
  setWindowTitle("Sandglass");
  setAcceptDrops(true);
  setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowTabbedDocks | QMainWindow::AllowNestedDocks);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  pool_.setMaxThreadCount(1);
  qApp->installEventFilter(new CalmWheel(this));
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
  buildCharts();
  connectPanels();
  connectDrawing();
  curveTimer_.setInterval(curveInterval);
  connect(&curveTimer_, &QTimer::timeout, this, &MainWindow::refreshCurves);
  resize(1440, 900);
  resizeDocks({docks_["view"], docks_["energies"]}, {310, 390}, Qt::Horizontal);
  resizeDocks({docks_["view"], docks_["scene"]}, {360, 440}, Qt::Vertical);
  resizeDocks({docks_["energies"], docks_["flow"], docks_["gr"]}, {260, 260, 290}, Qt::Vertical);
  enter(addDocument());
  readSettings();
}

MainWindow::~MainWindow() {
  for (const auto& document : documents_) {
    document->session->disconnect(this);
    document->session->stopAndWait();
  }
  pool_.waitForDone();
}

void MainWindow::buildCentre() {
  auto* centre = new QWidget(this);
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  tabBar_ = new QTabBar(centre);
  tabBar_->setObjectName("tabs");
  tabBar_->setAccessibleName("Open scenes and runs");
  tabBar_->setTabsClosable(true);
  tabBar_->setExpanding(false);
  tabBar_->setDrawBase(false);
  centre_ = new QStackedWidget(centre);
  auto* pictures = new QWidget;
  auto* below = new QVBoxLayout(pictures);
  below->setContentsMargins(0, 0, 0, 0);
  below->setSpacing(0);
  below->addWidget(picture_ = new PictureView(pictures), 1);
  below->addWidget(time_ = new TimeBar(pictures));
  auto* split = new QSplitter(Qt::Vertical, this);
  split->addWidget(sweep_ = new SweepPanel);
  split->addWidget(pictures);
  split->setSizes({3, 2});
  split->setStretchFactor(0, 3);
  split->setStretchFactor(1, 2);
  sweep_->hide();
  centre_->addWidget(start_ = new StartPage);
  centre_->addWidget(split);
  column->addWidget(tabBar_);
  column->addWidget(banner_ = new Banner(centre));
  column->addWidget(centre_, 1);
  setCentralWidget(centre);

  connect(tabBar_, &QTabBar::currentChanged, this, [this](int index) {
    if (index >= 0 && index < tabs()) enter(documents_[static_cast<std::size_t>(index)].get());
  });
  connect(tabBar_, &QTabBar::tabCloseRequested, this, &MainWindow::closeTab);
  connect(start_, &StartPage::sampleChosen, this, &MainWindow::open);
  connect(start_, &StartPage::recentChosen, this, &MainWindow::open);
  connect(start_, &StartPage::openWanted, this, &MainWindow::chooseFile);
  connect(picture_, &PictureView::cameraMoved, this, [this](const vis::Camera& camera, bool interactive) {
    now_->view.camera = camera;
    if (!interactive) keepView("move the camera");
    requestPicture(interactive);
  });
  connect(picture_, &PictureView::resized, this, [this] { requestPicture(); });
  connect(picture_, &PictureView::clicked, this, [this](QPoint pixel) { drawing_->pick(pixel); });
  connect(picture_, &PictureView::rectangleDrawn, this, [this](QRect pixels) { drawing_->pickIn(pixels); });
  connect(picture_, &PictureView::fitWanted, this, [this] { usePreset("fit"); });
  connect(time_, &TimeBar::chosenChanged, this, [this] {
    outdated_ = true;
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
  auto* view = addDock("view", "View", viewPanel_ = new ViewPanel, Qt::LeftDockWidgetArea);
  auto* run = addDock("run", "Run", scrolling(run_ = new RunPanel), Qt::LeftDockWidgetArea);
  auto* scene = addDock("scene", "Scene", scene_ = new ScenePanel, Qt::LeftDockWidgetArea);
  auto* accuracy = addDock("accuracy", "Speed", accuracy_ = new AccuracyPanel, Qt::LeftDockWidgetArea);
  auto* log = addDock("log", "Log", log_ = new LogPanel, Qt::LeftDockWidgetArea);
  tabifyDockWidget(view, run);
  tabifyDockWidget(scene, accuracy);
  tabifyDockWidget(scene, log);
  view->raise();
  scene->raise();
}

void MainWindow::buildCharts() {
  const auto chart = [&](const QString& id, const QString& title, const QString& hint) {
    auto* panel = charts_[id] = new ChartPanel(id, hint);
    panel->setProperty("hint", hint);
    return addDock(id, title, panel, Qt::RightDockWidgetArea);
  };
  chart("energies", "Energies", "Energies of the grains, once a scene or run is open.");
  auto* flow = chart("flow", "Flow rate", "Mass flow through the outlet, once a scene or run is open.");
  inspector_ = new InspectorPanel;
  charts_["history"] = inspector_->history();
  point_ = new PointPanel("Open the folder of a sweep and choose a point of its diagram.");
  charts_["point"] = point_->chart();
  point_->chart()->setProperty("hint", "Open the folder of a sweep and choose a point of its diagram.");
  auto* inspector = addDock("inspector", "Grain", inspector_, Qt::RightDockWidgetArea);
  auto* point = addDock("point", "Point", point_, Qt::RightDockWidgetArea);
  tabifyDockWidget(flow, inspector);
  tabifyDockWidget(flow, point);
  flow->raise();
  QDockWidget* first = nullptr;
  for (const auto& analysis : panelAnalyses()) {
    const QString id = QString::fromStdString(analysis.id);
    QString tip = QString::fromStdString(analysis.tip) + ".";
    tip[0] = tip[0].toUpper();
    QDockWidget* dock = nullptr;
    if (id == "states") { // with its evidence above the chart
      states_ = new StatePanel(tip);
      charts_[id] = states_->chart();
      states_->chart()->setProperty("hint", tip);
      dock = addDock(id, QString::fromStdString(analysis.title), states_, Qt::RightDockWidgetArea);
    } else {
      dock = chart(id, QString::fromStdString(analysis.title), tip);
    }
    charts_.at(id)->offerKnobs(analysis.knobs);
    if (first)
      tabifyDockWidget(first, dock);
    else
      first = dock;
    dock->setVisible(analysis.shown);
    commands_->action("panel." + id)->setChecked(analysis.shown);
    connect(dock, &QDockWidget::visibilityChanged, this, [this](bool visible) {
      if (visible) requestAnalyses(true);
    });
  }
  if (first) first->raise();
  for (const auto& [id, panel] : charts_) {
    connect(panel, &ChartPanel::wanted, this,
            [this](const QString& name, const analysis::Curve& curve, QSize pixels) {
              const QColor& paper = ink().paper;
              drawing_->drawChart(
                  name, curve, pixels,
                  {{paper.redF(), paper.greenF(), paper.blueF()}, static_cast<float>(ink().textScale)});
            });
    connect(panel, &ChartPanel::exportWanted, this, &MainWindow::exportCurve);
    if (id != "history" && id != "point")
      connect(panel, &ChartPanel::quantityChosen, this, [this] { requestAnalyses(true); });
  }
}

void MainWindow::connectPanels() {
  connect(viewPanel_, &ViewPanel::changed, this, [this] {
    viewPanel_->apply(now_->view);
    keepView("change the view");
    scanRunRange();
    requestPicture();
  });
  connect(scene_, &ScenePanel::edited, this, &MainWindow::onSceneEdited);
  connect(scene_, &ScenePanel::checked, this, &MainWindow::onChecked);
  connect(run_, &RunPanel::changeWanted, this, &MainWindow::changeRun);
  connect(run_, &RunPanel::branchWanted, this, &MainWindow::branch);
  connect(run_, &RunPanel::speedLimitChosen, this, [this](double ratio) { session_->limitSpeed(ratio); });
  connectSweep();
  connect(docks_["inspector"], &QDockWidget::visibilityChanged, this, [this](bool visible) {
    if (visible && now_) inspect();
  });
}

void MainWindow::connectDrawing() {
  connect(drawing_.get(), &DrawingThread::pictureReady, this, &MainWindow::onPicture);
  connect(drawing_.get(), &DrawingThread::chartReady, this,
          [this](const QString& panel, const QImage& image, const vis::ChartPlace& place) {
            charts_.at(panel)->setImage(image, place);
          });
  connect(drawing_.get(), &DrawingThread::picked, this, &MainWindow::onPicked);
  connect(drawing_.get(), &DrawingThread::pickedIn, this, &MainWindow::onPickedIn);
  connect(drawing_.get(), &DrawingThread::failed, this, &MainWindow::onDrawingFailed);
  connect(drawing_.get(), &DrawingThread::started, this,
          [this](const QString& backend) { say(LogLevel::info, "Pictures by " + backend + "."); });
  connect(drawing_.get(), &DrawingThread::saved, this, [this](const QString& file, const QString& fault) {
    if (fault.isEmpty()) {
      say(LogLevel::info, "The picture is saved in " + file + ".");
      statusBar()->showMessage("Saved " + file);
    } else {
      complain({fault});
    }
    requestPicture(); // picking looks at the picture drawn last
    Q_EMIT pictureSaved(file, fault);
  });
  connect(analyses_.get(), &AnalysisWorker::ready, this, &MainWindow::takeAnalyses);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!mayStop(
          "A simulation is running. Stop it and close? A checkpoint is kept; Run goes on from it later."))
    return event->ignore();
  writeSettings();
  hide();
  for (const auto& document : documents_)
    document->session->stopAndWait();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const auto& url : event->mimeData()->urls())
    if (url.isLocalFile()) open(url.toLocalFile());
}

} // namespace sandglass::desktop
