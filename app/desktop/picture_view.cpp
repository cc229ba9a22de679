#include "app/desktop/picture_view.h"

#include "app/desktop/style.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <cmath>

namespace sandglass::desktop {

namespace {

constexpr double degreesPerPixel = 0.35;
constexpr double zoomPerNotch = 1.15;
constexpr int settleTime = 250; ///< [ms] after which the wheel counts as still

} // namespace

PictureView::PictureView(QWidget* parent) : QWidget(parent) {
  setObjectName("picture");
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(240, 180);
  settle_.setSingleShot(true);
  settle_.setInterval(settleTime);
  connect(&settle_, &QTimer::timeout, this, [this] { Q_EMIT cameraMoved(camera_, false); });
}

void PictureView::show(Picture picture) {
  picture_ = std::move(picture);
  if (!dragging_ && !settle_.isActive()) camera_ = picture_.camera;
  ++pictures_;
  update();
}

void PictureView::clear() {
  picture_ = {};
  update();
}

void PictureView::setHint(const QString& title, const QString& text) {
  hintTitle_ = title;
  hintText_ = text;
  update();
}

void PictureView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (picture_.image.isNull()) return paintHint(painter);
  if (picture_.image.size() == pixels()) {
    painter.drawImage(rect(), picture_.image);
    if (drawsRectangle_ && dragging_) {
      painter.setPen(QPen(QColor(31, 111, 120), 1.5, Qt::DashLine));
      painter.setBrush(QColor(31, 111, 120, 30));
      painter.drawRect(QRect(pressed_, last_).normalized());
    }
    return;
  }
  // Until the picture of the new size is there: the old one, whole and in the middle.
  painter.fillRect(rect(), Qt::white);
  QSize size = picture_.image.size();
  size.scale(this->size(), Qt::KeepAspectRatio);
  QRect target(QPoint(0, 0), size);
  target.moveCenter(rect().center());
  painter.drawImage(target, picture_.image);
}

void PictureView::paintHint(QPainter& painter) {
  painter.fillRect(rect(), ink().paper);
  QFont font = this->font();
  const double points = font.pointSizeF();
  font.setPointSizeF(points * 1.9);
  font.setWeight(QFont::DemiBold);
  painter.setFont(font);
  painter.setPen(ink().text);
  const QRect upper(0, 0, width(), height() / 2 - 12);
  painter.drawText(upper.adjusted(24, 0, -24, 0), Qt::AlignHCenter | Qt::AlignBottom | Qt::TextWordWrap,
                   hintTitle_);
  font.setPointSizeF(points * 1.15);
  font.setWeight(QFont::Normal);
  painter.setFont(font);
  painter.setPen(ink().text);
  const QRect lower(0, height() / 2 + 8, width(), height() / 2 - 8);
  painter.drawText(lower.adjusted(24, 0, -24, 0), Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap,
                   hintText_);
}

void PictureView::resizeEvent(QResizeEvent*) {
  Q_EMIT resized();
}

void PictureView::move(const vis::Camera& camera, bool interactive) {
  if (picture_.image.isNull()) return;
  camera_ = camera;
  Q_EMIT cameraMoved(camera_, interactive);
}

void PictureView::mousePressEvent(QMouseEvent* event) {
  pressed_ = last_ = event->pos();
  drawsRectangle_ = event->button() == Qt::LeftButton && (event->modifiers() & Qt::ControlModifier);
  if (!settle_.isActive()) camera_ = picture_.camera;
}

void PictureView::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton || picture_.image.isNull()) return;
  if (!dragging_ && (event->pos() - pressed_).manhattanLength() < QApplication::startDragDistance()) return;
  dragging_ = true;
  const QPoint by = event->pos() - last_;
  last_ = event->pos();
  if (drawsRectangle_) return update();
  const bool pans = !(event->buttons() & Qt::LeftButton) || (event->modifiers() & Qt::ShiftModifier);
  if (pans)
    move(vis::pan(camera_, -static_cast<double>(by.x()) / height(), static_cast<double>(by.y()) / height()),
         true);
  else
    move(vis::orbit(camera_, -degreesPerPixel * by.x(), degreesPerPixel * by.y()), true);
}

void PictureView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->buttons() != Qt::NoButton) return;
  const bool rectangle = std::exchange(drawsRectangle_, false), dragged = std::exchange(dragging_, false);
  if (rectangle && dragged) {
    const QRect drawn = QRect(pressed_, event->pos()).normalized();
    update();
    Q_EMIT rectangleDrawn({drawn.topLeft() * devicePixelRatioF(), drawn.size() * devicePixelRatioF()});
  } else if (dragged)
    move(camera_, false);
  else if (event->button() == Qt::LeftButton && !picture_.image.isNull())
    Q_EMIT clicked(event->pos() * devicePixelRatioF());
}

void PictureView::mouseDoubleClickEvent(QMouseEvent*) {
  Q_EMIT fitWanted();
}

void PictureView::wheelEvent(QWheelEvent* event) {
  if (picture_.image.isNull()) return;
  if (!settle_.isActive() && !dragging_) camera_ = picture_.camera;
  settle_.start();
  move(vis::zoom(camera_, std::pow(zoomPerNotch, event->angleDelta().y() / 120.0)), true);
  event->accept();
}

void PictureView::orbitBy(double azimuth, double elevation) {
  move(vis::orbit(camera_, azimuth, elevation), false);
}

void PictureView::zoomBy(double factor) {
  move(vis::zoom(camera_, factor), false);
}

void PictureView::panBy(double right, double up) {
  move(vis::pan(camera_, right, up), false);
}

} // namespace sandglass::desktop
