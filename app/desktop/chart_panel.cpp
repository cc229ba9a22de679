#include "app/desktop/chart_panel.h"

#include <QPainter>

namespace sandglass::desktop {

namespace {

constexpr int smallest = 40; ///< [pixel] below which no chart is worth drawing

} // namespace

ChartPanel::ChartPanel(const QString& name, const QString& hint, QWidget* parent)
    : QWidget(parent), hint_(hint) {
  setObjectName(name);
  setMinimumSize(180, 120);
  setAttribute(Qt::WA_OpaquePaintEvent);
}

void ChartPanel::setCurve(analysis::Curve curve) {
  curve_ = std::move(curve);
  want();
}

void ChartPanel::setImage(const QImage& image) {
  if (!curve_) return; // cleared while it was drawn
  image_ = image;
  waiting_ = false;
  ++charts_;
  update();
}

void ChartPanel::clear(const QString& hint) {
  curve_.reset();
  image_ = {};
  hint_ = hint;
  update();
}

void ChartPanel::want() {
  outdated_ = true;
  if (!curve_ || !isVisible() || width() < smallest || height() < smallest) return;
  outdated_ = false;
  waiting_ = true;
  Q_EMIT wanted(objectName(), *curve_, size() * devicePixelRatioF());
}

void ChartPanel::resizeEvent(QResizeEvent*) {
  want();
}

void ChartPanel::showEvent(QShowEvent*) {
  if (outdated_) want();
}

void ChartPanel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Qt::white);
  if (!image_.isNull()) {
    painter.setRenderHint(QPainter::SmoothPixmapTransform, image_.size() != size() * devicePixelRatioF());
    painter.drawImage(rect(), image_);
    return;
  }
  painter.setPen(QColor(120, 126, 133));
  painter.drawText(rect().adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap, hint_);
}

} // namespace sandglass::desktop
