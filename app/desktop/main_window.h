#pragma once
// The window: puts panels, tabs, drawing thread and workers together. Handles events and shows finished
// images; draws, computes and reads nothing itself.

#include "app/desktop/analysis_worker.h"
#include "app/desktop/command_table.h"
#include "app/desktop/document.h"
#include "app/desktop/drawing_thread.h"
#include "app/desktop/scene_checker.h"
#include "app/desktop/time_bar.h"

#include <QDockWidget>
#include <QElapsedTimer>
#include <QMainWindow>
#include <QSettings>
#include <QStackedWidget>
#include <QTabBar>
#include <QTimer>
#include <QUndoGroup>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace sandglass::desktop {

class AccuracyPanel;
class Banner;
class ChartPanel;
class InspectorPanel;
class LogPanel;
class PictureView;
class PointPanel;
class RunPanel;
class ScenePanel;
class StartPage;
class StatePanel;
class SweepPanel;
class ViewPanel;

struct WindowOptions {
  SessionOptions session;
  vis::GlBackend backend = vis::GlBackend::automatic;
  bool asksNothing = false; ///< for tests and scripts: no question when closing
  QString settingsFile;     ///< where settings are kept; empty: nowhere
};

class MainWindow : public QMainWindow {
  Q_OBJECT
public:
  explicit MainWindow(const WindowOptions& options);
  ~MainWindow() override;

  /// A scene, run, file of frames, picture or session file; beside what runs in this tab, in another one.
  void open(const QString& path);
  void showTime(double seconds); ///< the saved frame nearest to it
  void showView(const vis::View& view);
  void savePicture(const QString& file); ///< of what is shown, in the size in which it is shown
  void saveScene(const QString& file);   ///< the text as it is now
  void saveSession(const QString& file);
  void branch(); ///< a new run in a new tab from the frame shown
  void newTab();
  void closeTab(int index);
  void showTab(int index);
  /// The run of another tab in the right half of the picture of this one, through the same camera; false
  /// ends it. The tab is the one looked at before, or the nearest in which something is open.
  void showBeside(bool on);
  FramePtr shownBeside() const { return now_->shownBeside; }
  int tabs() const { return static_cast<int>(documents_.size()); }
  /// Whether nothing is being opened, and picture, charts, analyses and scene are up to date.
  bool isSettled() const;

  Session& session() { return *session_; }
  const vis::View& view() const { return now_->view; }
  const CommandTable& commands() const { return *commands_; }
  FramePtr shownFrame() const { return now_->shown; }
  QString bannerText() const;
  QDockWidget* dock(const QString& id) const { return docks_.at(id); }

Q_SIGNALS:
  void pictureSaved(const QString& file, const QString& fault);

protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  std::vector<Command> commandRows();
  std::vector<Command> fileRows();
  std::vector<Command> editRows();
  std::vector<Command> runRows();
  std::vector<Command> timeRows();
  std::vector<Command> viewRows();
  std::vector<Command> panelRows();
  std::vector<Command> windowRows();
  std::vector<Command> helpRows();
  void buildCentre();
  void buildDocks();
  void buildCharts();
  void connectPanels();
  void connectDrawing();
  void connectSession(Document* document);
  QDockWidget* addDock(const QString& id, const QString& title, QWidget* content, Qt::DockWidgetArea area);

  // Tabs and what happens in them (window_documents.cpp).
  Document* addDocument();
  void enter(Document* document);
  void nameTab(const Document& document);
  void onOpened(Document* document);
  void showDocument();
  void onFrame();
  void onState();
  void onRunEnded(bool complete, const QString& fault);
  void onChecked(const SceneChecker::Outcome& outcome);
  void onSceneEdited(const QString& before, const QString& after, const QString& what);
  void showState();
  void spareSimulations(); ///< drawing and analyses leave their cores to those that go on

  // Pictures and curves (window_pictures.cpp).
  void requestPicture(bool interactive = false);
  void onPicture();
  void onPicked(qint64 grain, int half);
  void onPickedIn(const std::vector<std::int64_t>& grains);
  void chooseNone();
  void refreshPanels(bool restart);
  void requestAnalyses(bool restart);
  void takeAnalyses();
  void refreshCurves();
  void keepView(const QString& what); ///< the view has changed: undo can take it back
  void applyView(const vis::View& view);
  void exportCurve(const analysis::Curve& curve, const QString& suffix);
  QString curveName() const;

  // Two runs side by side (window_beside.cpp).
  Document* partner() const;
  void setBeside(Document* document, Document* other);
  void forgetBeside(const Document* document);
  std::optional<FrameOrder> besideOrder() const;
  void inspect();

  // The explorer of a sweep (window_sweep.cpp).
  void connectSweep();
  void showSweep();
  void choosePoint(int point);
  void showSweepRun(int run);
  void openPoint(int point);
  void saveSweepTable(const QString& file);

  // Columns of other programs' files (window_import.cpp).
  void chooseColumns();
  void mapColumns(const QString& path, const QString& reason);
  void onOpenFailed(const QStringList& sentences);
  void onDrawingFailed(const QString& sentence);
  void offerColumns();

  // What commands do (window_actions.cpp).
  void say(LogLevel level, const QString& text);
  void complain(const QStringList& sentences);
  void usePreset(const std::string& preset);
  void toggleTrack();
  void togglePanel(const QString& id, bool on);
  void chooseFile();
  void chooseFolder();
  void choosePictureFile();
  void chooseSceneFile();
  void chooseSessionFile();
  void showCheatSheet();
  void startOrPause();
  void step(int steps);
  bool sceneIsReady();
  void changeRun(const EventSpec& event);
  void setRunIcon(bool running);
  bool mayStop(const QString& question);

  // Settings and session files (window_state.cpp).
  void readSettings();
  void writeSettings();
  void remember(const QString& path);
  void openSession(const QString& file);
  void setDark(bool on);
  void setTextScale(double factor);

  /// The colour range over the whole run: scanned in a worker, then widened by each frame that comes.
  struct RunRange {
    std::string quantity;
    const FrameStore* store = nullptr;
    std::array<double, 2> limits{0, 0};
    bool known = false;
  };
  void scanRunRange();
  void widenRunRange(const Frame& frame);

  WindowOptions options_;
  std::unique_ptr<QSettings> settings_;
  std::vector<std::unique_ptr<Document>> documents_;
  Document* now_ = nullptr;    ///< the tab that is shown
  Document* before_ = nullptr; ///< the one shown before; null when it is closed
  Session* session_ = nullptr; ///< its session
  std::unique_ptr<DrawingThread> drawing_;
  std::unique_ptr<AnalysisWorker> analyses_;
  std::unique_ptr<CommandTable> commands_;
  QUndoGroup undo_;
  QThreadPool pool_;

  Banner* banner_ = nullptr;
  QTabBar* tabBar_ = nullptr;
  QStackedWidget* centre_ = nullptr;
  StartPage* start_ = nullptr;
  PictureView* picture_ = nullptr;
  TimeBar* time_ = nullptr;
  ViewPanel* viewPanel_ = nullptr;
  RunPanel* run_ = nullptr;
  ScenePanel* scene_ = nullptr;
  LogPanel* log_ = nullptr;
  AccuracyPanel* accuracy_ = nullptr;
  InspectorPanel* inspector_ = nullptr;
  StatePanel* states_ = nullptr;
  SweepPanel* sweep_ = nullptr;
  PointPanel* point_ = nullptr;
  std::map<QString, ChartPanel*> charts_;
  std::map<QString, QDockWidget*> docks_;

  RunRange range_;
  quint64 ordered_ = 0, drawn_ = 0; ///< numbers of pictures
  bool showsPause_ = false;         ///< on the button that starts and pauses
  bool outdated_ = false, curvesOutdated_ = false;
  bool startWhenChecked_ = false;
  QStringList recent_;
  bool dark_ = false;
  double textScale_ = 1;
  int picturesSince_ = 0;
  int sweepReading_ = 0; ///< runs of a sweep that are being read
  int surveys_ = 0;      ///< files whose columns are being listed
  QElapsedTimer sincePictures_;
  QTimer curveTimer_;
};

} // namespace sandglass::desktop
