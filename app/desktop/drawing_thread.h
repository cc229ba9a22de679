#pragma once
// The thread that owns the one GL context and draws everything: the picture of the grains, charts, pictures
// for files. Orders go in through a slot of one place per kind, so that stale ones are never drawn; results
// come out through a slot of one place, fetched when pictureReady() says so.
//
// While a simulation runs, the thread draws at a lower priority, at most three pictures a second, and rests
// after each one for as long as keeps it within its share of one core; a picture with the mouse button down
// does not wait.

#include "analysis/result.h"
#include "app/desktop/one_slot.h"
#include "vis/renderer.h"

#include "sim/io/run_folder.h"

#include <QImage>
#include <QObject>
#include <QPoint>
#include <QSize>
#include <QString>

#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace sandglass::desktop {

/// A frame at hand, or frame `index` of a source, loaded by the drawing thread.
struct FrameOrder {
  FramePtr frame;
  std::shared_ptr<const FrameSource> source;
  std::size_t index = 0;
  std::shared_ptr<const FrameSource> run; ///< the other frames, for views that look back
  std::string name;                       ///< of the run, beside another one
};

/// What to draw.
struct PictureOrder {
  FrameOrder left;
  std::optional<FrameOrder> right; ///< the other half of the picture
  vis::View view;                  ///< of both halves; as wide as both together
  quint64 number = 0;              ///< of the order; its picture carries it
  bool interactive = false;        ///< somebody waits with the mouse button down
};

struct Picture {
  QImage image;
  FramePtr frame, right; ///< `right` of a pair
  vis::Camera camera;    ///< presets resolved
  quint64 number = 0;
  bool interactive = false;
};

struct PictureFile {
  FrameOrder left;
  std::optional<FrameOrder> right;
  vis::View view;
  std::string file;
  std::map<std::string, std::string> text; ///< further chunks; provenance and view are added
};

class DrawingThread : public QObject {
  Q_OBJECT
public:
  explicit DrawingThread(vis::GlBackend backend = vis::GlBackend::automatic);
  ~DrawingThread() override;

  void draw(PictureOrder order);
  void drawChart(const QString& panel, analysis::Curve curve, QSize pixels, const vis::ChartLook& look);
  void pick(QPoint pixel);                                    ///< of the picture drawn last
  void pickIn(QRect pixels);                                  ///< all grains in a rectangle of it
  void save(PictureFile file);                                ///< never dropped
  void saveChart(analysis::Curve curve, const QString& file); ///< likewise; PNG
  void setSimulationRuns(bool runs);

  std::optional<Picture> takePicture() { return out_.take(); }

Q_SIGNALS: // from the drawing thread: connect to objects of the window's thread
  void pictureReady();
  void chartReady(const QString& panel, const QImage& image, const sandglass::vis::ChartPlace& place);
  void picked(qint64 grain, int half);                    ///< half: 1 in the right one of a pair, else 0
  void pickedIn(const std::vector<std::int64_t>& grains); ///< ascending
  void saved(const QString& file, const QString& fault);  ///< no fault: it is there
  void failed(const QString& sentence);
  void started(const QString& backend);

private:
  struct ChartOrder {
    analysis::Curve curve;
    QSize pixels;
    vis::ChartLook look;
  };
  using Clock = std::chrono::steady_clock;
  using Task = std::function<void(vis::Renderer&)>;

  void work(vis::GlBackend backend);
  std::optional<Task> nextTask();
  std::optional<Task> dueTask(Clock::time_point now);
  Clock::time_point nextDue() const;
  void drawPicture(vis::Renderer& renderer, const PictureOrder& order);
  struct Drawn {
    vis::Image image;
    FramePtr left, right;
  };
  Drawn render(vis::Renderer& renderer, const FrameOrder& left, const std::optional<FrameOrder>& right,
               const vis::View& view);
  std::shared_ptr<const vis::History> lookBack(std::size_t half, const vis::View& view,
                                               const std::shared_ptr<const FrameSource>& run);
  void writePicture(vis::Renderer& renderer, const PictureFile& file);
  void rest(double seconds, double processorSeconds);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<PictureOrder> picture_;
  std::map<QString, ChartOrder> charts_;
  std::deque<PictureFile> files_;
  std::deque<std::pair<analysis::Curve, QString>> chartFiles_;
  std::optional<QPoint> pick_;
  std::optional<QRect> pickIn_;
  bool simulationRuns_ = false, quit_ = false, chartLast_ = false;
  Clock::time_point pictureFrom_{}, chartFrom_{}; ///< not before

  struct Past {
    std::string key; ///< what it is the history of
    std::shared_ptr<const vis::History> history;
  };
  struct Averaged {
    FramePtr of, with;
  };
  FramePtr fieldsOf(const FramePtr& frame, std::size_t half);
  std::array<Averaged, 2> averaged_; ///< fields of the frames drawn last, likewise
  std::array<Past, 2> past_;         ///< of the halves; of the drawing thread alone
  OneSlot<Picture> out_;
  std::thread thread_; ///< last: starts when all else is there
};

/// An Image as Qt paints it without conversion.
QImage toQImage(vis::Image image);

} // namespace sandglass::desktop

Q_DECLARE_METATYPE(sandglass::vis::ChartPlace)
