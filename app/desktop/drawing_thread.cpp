#include "app/desktop/drawing_thread.h"

#include "app/desktop/background.h"
#include "sim/base/error.h"
#include "vis/chart.h"
#include "vis/coarse_fields.h"
#include "vis/history.h"
#include "vis/pair_view.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace sandglass::desktop {

namespace {

using Seconds = std::chrono::duration<double>;

// Between pictures while a simulation runs: as long as keeps drawing below its usual share of one core, but
// no longer than shows one a second, unless the greatest share asks for that.
constexpr double shortestInterval = 0.35, usualInterval = 0.9; ///< [s]
constexpr double chartInterval = 2.5;                          ///< [s] between charts while a simulation runs
constexpr double usualShare = 0.3, share = 0.4; ///< of one core, for drawing while a simulation runs
constexpr int nice = 1; ///< the pace spares the simulation; more would starve the picture

} // namespace

QImage toQImage(vis::Image image) {
  auto* owner = new vis::Image(std::move(image));
  const QImage borrowed(
      owner->rgba.data(), owner->width, owner->height, owner->width * 4, QImage::Format_RGBA8888,
      [](void* p) { delete static_cast<vis::Image*>(p); }, owner);
  return borrowed.convertToFormat(QImage::Format_RGB32);
}

DrawingThread::DrawingThread(vis::GlBackend backend) : thread_([this, backend] { work(backend); }) {
  qRegisterMetaType<vis::ChartPlace>("sandglass::vis::ChartPlace");
  qRegisterMetaType<std::vector<std::int64_t>>("std::vector<std::int64_t>");
}

DrawingThread::~DrawingThread() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void DrawingThread::draw(PictureOrder order) {
  const std::lock_guard lock(mutex_);
  picture_ = std::move(order);
  changed_.notify_all();
}

void DrawingThread::drawChart(const QString& panel, analysis::Curve curve, QSize pixels,
                              const vis::ChartLook& look) {
  const std::lock_guard lock(mutex_);
  charts_[panel] = {std::move(curve), pixels, look};
  changed_.notify_all();
}

void DrawingThread::pick(QPoint pixel) {
  const std::lock_guard lock(mutex_);
  pick_ = pixel;
  changed_.notify_all();
}

void DrawingThread::pickIn(QRect pixels) {
  const std::lock_guard lock(mutex_);
  pickIn_ = pixels;
  changed_.notify_all();
}

void DrawingThread::save(PictureFile file) {
  const std::lock_guard lock(mutex_);
  files_.push_back(std::move(file));
  changed_.notify_all();
}

void DrawingThread::saveChart(analysis::Curve curve, const QString& file) {
  const std::lock_guard lock(mutex_);
  chartFiles_.emplace_back(std::move(curve), file);
  changed_.notify_all();
}

void DrawingThread::setSimulationRuns(bool runs) {
  const std::lock_guard lock(mutex_);
  simulationRuns_ = runs;
  if (!runs) pictureFrom_ = chartFrom_ = {};
  changed_.notify_all();
}

void DrawingThread::work(vis::GlBackend backend) {
  lowerPriority(nice); // before the context, whose threads inherit it
  std::unique_ptr<vis::Renderer> renderer;
  try {
    renderer = std::make_unique<vis::Renderer>(backend);
    Q_EMIT started(QString::fromStdString(renderer->backendName()));
  } catch (const std::exception& e) {
    Q_EMIT failed(QString::fromUtf8(e.what()));
    return;
  }
  while (const auto task = nextTask()) {
    const auto start = Clock::now();
    const double used = threadSeconds();
    try {
      (*task)(*renderer);
    } catch (const std::exception& e) {
      Q_EMIT failed(QString::fromUtf8(e.what()));
    }
    rest(Seconds(Clock::now() - start).count(), threadSeconds() - used);
  }
}

void DrawingThread::rest(double seconds, double processorSeconds) {
  const std::lock_guard lock(mutex_);
  if (!simulationRuns_) return;
  const auto now = Clock::now();
  const auto after = [&](double s) { return now + std::chrono::duration_cast<Clock::duration>(Seconds(s)); };
  const double pause = std::clamp(processorSeconds / usualShare, shortestInterval, usualInterval);
  const double interval = std::max(processorSeconds / share, chartLast_ ? 0 : pause);
  pictureFrom_ = std::max(pictureFrom_, after(interval - seconds));
  if (chartLast_) chartFrom_ = after(chartInterval);
}

std::optional<DrawingThread::Task> DrawingThread::nextTask() {
  std::unique_lock lock(mutex_);
  while (!quit_) {
    if (auto task = dueTask(Clock::now())) return task;
    const auto due = nextDue();
    if (due == Clock::time_point::max())
      changed_.wait(lock);
    else
      changed_.wait_until(lock, due);
  }
  return std::nullopt;
}

DrawingThread::Clock::time_point DrawingThread::nextDue() const {
  auto due = Clock::time_point::max();
  if (picture_) due = std::min(due, pictureFrom_);
  if (!charts_.empty()) due = std::min(due, std::max(pictureFrom_, chartFrom_));
  return due;
}

std::optional<DrawingThread::Task> DrawingThread::dueTask(Clock::time_point now) {
  if (pick_) {
    const QPoint p = *std::exchange(pick_, std::nullopt);
    return [this, p](vis::Renderer& r) {
      const vis::PickResult hit = r.pick(p.x(), p.y());
      Q_EMIT picked(hit.grain, hit.half);
    };
  }
  if (pickIn_) {
    const QRect p = *std::exchange(pickIn_, std::nullopt);
    return [this, p](vis::Renderer& r) {
      Q_EMIT pickedIn(r.grainsIn(p.left(), p.top(), p.right(), p.bottom()));
    };
  }
  const bool pictureDue = picture_ && (picture_->interactive || now >= pictureFrom_);
  const bool chartDue = !charts_.empty() && now >= std::max(pictureFrom_, chartFrom_);
  if (pictureDue && !(chartDue && !chartLast_ && !picture_->interactive)) {
    chartLast_ = false;
    PictureOrder order = std::move(*std::exchange(picture_, std::nullopt));
    return [this, order = std::move(order)](vis::Renderer& r) { drawPicture(r, order); };
  }
  if (chartDue) {
    chartLast_ = true;
    auto node = charts_.extract(charts_.begin());
    return [this, panel = node.key(), order = std::move(node.mapped())](vis::Renderer& r) {
      const QImage image =
          toQImage(r.draw(order.curve, order.pixels.width(), order.pixels.height(), order.look));
      Q_EMIT chartReady(panel, image, r.chartPlace());
    };
  }
  if (!files_.empty()) {
    PictureFile file = std::move(files_.front());
    files_.pop_front();
    return [this, file = std::move(file)](vis::Renderer& r) { writePicture(r, file); };
  }
  if (!chartFiles_.empty()) {
    auto [curve, file] = std::move(chartFiles_.front());
    chartFiles_.pop_front();
    return [this, curve = std::move(curve), file = file](vis::Renderer& r) {
      QString fault;
      try {
        vis::writeChart(r, curve, file.toStdString());
      } catch (const std::exception& e) {
        fault = QString::fromUtf8(e.what());
      }
      Q_EMIT saved(file, fault);
    };
  }
  return std::nullopt;
}

std::shared_ptr<const vis::History> DrawingThread::lookBack(std::size_t half, const vis::View& view,
                                                            const std::shared_ptr<const FrameSource>& run) {
  Past& past = past_[half];
  if (!vis::needsHistory(view) || !run || run->size() == 0) {
    past = {};
    return nullptr;
  }
  std::string key = fmt::format("{} {}", fmt::ptr(run.get()), run->size());
  for (const auto grain : view.tracks.grains)
    key += fmt::format(" {}", grain);
  if (key != past.key) past = {key, std::make_shared<const vis::History>(vis::historyOf(*run, view))};
  return past.history;
}

FramePtr DrawingThread::fieldsOf(const FramePtr& frame, std::size_t half) {
  Averaged& last = averaged_[half];
  if (last.of != frame) {
    tbb::task_arena arena(1); // the other cores belong to the simulation
    last = {frame, arena.execute([&] { return vis::withFields(frame); })};
  }
  return last.with;
}

DrawingThread::Drawn DrawingThread::render(vis::Renderer& renderer, const FrameOrder& left,
                                           const std::optional<FrameOrder>& right, const vis::View& view) {
  const auto load = [&](const FrameOrder& order) {
    return order.frame ? order.frame : order.source->load(order.index);
  };
  const auto drawn = [&](const FramePtr& frame, std::size_t half) { // for the slice
    if (view.slice.shown) return fieldsOf(frame, half);
    averaged_[half] = {};
    return frame;
  };
  Drawn result;
  result.left = load(left);
  if (!right) {
    renderer.setHistory(lookBack(0, view, left.run));
    result.image = renderer.draw(*drawn(result.left, 0), vis::drawableView(view, *result.left));
    return result;
  }
  result.right = load(*right);
  const vis::PairViews views = vis::pairViews(*result.left, *result.right, view, {left.name, right->name});
  result.image = renderer.drawPair(*drawn(result.left, 0), *drawn(result.right, 1), views.left, views.right,
                                   lookBack(0, view, left.run), lookBack(1, view, right->run));
  return result;
}

void DrawingThread::drawPicture(vis::Renderer& renderer, const PictureOrder& order) {
  Drawn drawn = render(renderer, order.left, order.right, order.view);
  Picture picture;
  picture.image = toQImage(std::move(drawn.image));
  picture.frame = drawn.left;
  picture.right = drawn.right;
  picture.camera = renderer.resolvedCamera();
  picture.number = order.number;
  picture.interactive = order.interactive;
  if (out_.put(std::move(picture))) Q_EMIT pictureReady();
}

void DrawingThread::writePicture(vis::Renderer& renderer, const PictureFile& file) {
  QString fault;
  try {
    const Drawn drawn = render(renderer, file.left, file.right, file.view);
    auto text = drawn.left->provenance;
    text.insert(file.text.begin(), file.text.end());
    text["Software"] = "Sandglass";
    text["view"] = vis::writeView(file.view);
    text["time"] = fmt::format("{:.17g}", drawn.left->time);
    vis::writePng(drawn.image, file.file, text);
  } catch (const std::exception& e) {
    fault = QString::fromUtf8(e.what());
  }
  Q_EMIT saved(QString::fromStdString(file.file), fault);
}

} // namespace sandglass::desktop
