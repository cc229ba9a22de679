#pragma once
// The window: puts panels, session, drawing thread and g(r) worker together. Handles events and shows
// finished images; draws, computes and reads nothing itself.

#include "app/desktop/command_table.h"
#include "app/desktop/drawing_thread.h"
#include "app/desktop/pair_correlation_worker.h"
#include "app/desktop/session.h"
#include "app/desktop/time_bar.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QTimer>

#include <array>
#include <memory>
#include <optional>

namespace sandglass::desktop {

class Banner;
class ChartPanel;
class LogPanel;
class PictureView;
class ScenePanel;
class ViewPanel;

struct WindowOptions {
  SessionOptions session;
  vis::GlBackend backend = vis::GlBackend::automatic;
  bool asksNothing = false; ///< for tests and scripts: no question when closing
};

class MainWindow : public QMainWindow {
  Q_OBJECT
public:
  explicit MainWindow(const WindowOptions& options);
  ~MainWindow() override;

  void open(const QString& path);
  void showTime(double seconds); ///< the saved frame nearest to it
  void showView(const vis::View& view);
  void savePicture(const QString& file); ///< of what is shown, in the size in which it is shown
  /// Whether nothing is being opened, and picture, charts and g(r) are up to date.
  bool isSettled() const;

  Session& session() { return *session_; }
  const vis::View& view() const { return view_; }
  const CommandTable& commands() const { return *commands_; }
  FramePtr shownFrame() const { return shown_; }
  QString bannerText() const;

Q_SIGNALS:
  void pictureSaved(const QString& file, const QString& fault);

protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  std::vector<Command> commandRows();
  std::vector<Command> fileRows();
  std::vector<Command> runRows();
  std::vector<Command> viewRows();
  std::vector<Command> panelRows();
  std::vector<Command> helpRows();
  void buildCentre();
  void buildDocks();
  void connectDrawing();
  void connectSession();
  QDockWidget* addDock(const QString& id, const QString& title, QWidget* content, Qt::DockWidgetArea area);

  void onOpened();
  void onFrame();
  void onState();
  void onRunEnded(bool complete, const QString& fault);
  void onPicture();
  void onPicked(qint64 grain);
  void say(LogLevel level, const QString& text);
  void complain(const QStringList& sentences);

  void requestPicture(bool interactive = false);
  void requestPairCorrelation(bool restart);
  void refreshCurves();
  void usePreset(const std::string& preset);
  void chooseFile();
  void chooseFolder();
  void choosePictureFile();
  void showCheatSheet();
  void startOrPause();
  void setRunIcon(bool running);

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
  std::unique_ptr<Session> session_;
  std::unique_ptr<DrawingThread> drawing_;
  std::unique_ptr<PairCorrelationWorker> pairs_;
  std::unique_ptr<CommandTable> commands_;
  QThreadPool pool_;

  Banner* banner_ = nullptr;
  PictureView* picture_ = nullptr;
  TimeBar* time_ = nullptr;
  ViewPanel* viewPanel_ = nullptr;
  ScenePanel* scene_ = nullptr;
  LogPanel* log_ = nullptr;
  std::map<QString, ChartPanel*> charts_;
  std::map<QString, QDockWidget*> docks_;

  vis::View view_;
  FramePtr shown_;
  RunRange range_;
  quint64 ordered_ = 0, drawn_ = 0; ///< numbers of pictures
  bool showsPause_ = false;         ///< on the button that starts and pauses
  bool pairsOutdated_ = false, curvesOutdated_ = false;
  QTimer curveTimer_;
};

} // namespace sandglass::desktop
