#include "app/desktop/chart_panel.h"

#include "app/desktop/chart_curves.h"
#include "app/desktop/style.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QSignalBlocker>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace sandglass::desktop {

namespace {

constexpr int smallest = 40; ///< [pixel] below which no chart is worth drawing
constexpr double zoomPerNotch = 1.25;
constexpr int shortestDrag = 6; ///< [pixel]

} // namespace

ChartPanel::ChartPanel(const QString& name, const QString& hint, QWidget* parent)
    : QWidget(parent), hint_(hint) {
  setObjectName(name);
  setMinimumSize(290, 130);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMouseTracking(true);
  bar_ = new QWidget(this);
  bar_->setObjectName("chartBar");
  bar_->setAttribute(Qt::WA_StyledBackground);
  rows_ = new QBoxLayout(QBoxLayout::LeftToRight, bar_);
  rows_->setContentsMargins(6, 2, 6, 2);
  rows_->setSpacing(1);
  choices_ = new QHBoxLayout;
  rows_->addLayout(choices_, 1);
  buttons_ = new QHBoxLayout;
  buttons_->setSpacing(1);
  buttons_->addStretch(1);
  rows_->addLayout(buttons_);
  connect(button("pin", "Pin", "Keep this curve for comparison with those that come"), &QToolButton::clicked,
          this, &ChartPanel::pin);
  unpin_ = button("unpin", "Unpin", "Take the pinned curves away");
  connect(unpin_, &QToolButton::clicked, this, &ChartPanel::unpin);
  unpin_->hide();
  logX_ = button("logX", "log x", "Logarithmic x axis; values that are not positive are left out");
  logY_ = button("logY", "log y", "Logarithmic y axis; values that are not positive are left out");
  for (auto* b : {logX_, logY_}) {
    b->setCheckable(true);
    connect(b, &QToolButton::toggled, this, [this] {
      zoom_.reset();
      want();
    });
  }
  for (const char* suffix : {"csv", "png"})
    connect(button(suffix, QString(suffix).toUpper(),
                   QString("Save what is shown as %1").arg(QString(suffix).toUpper())),
            &QToolButton::clicked, this, [this, suffix] {
              if (curve_) Q_EMIT exportWanted(drawn(), suffix);
            });
}

QToolButton* ChartPanel::button(const char* name, const QString& text, const QString& tip) {
  auto* made = new QToolButton(bar_);
  made->setObjectName(name);
  made->setText(text);
  made->setToolTip(tip);
  made->setAccessibleName(text);
  made->setAutoRaise(true);
  made->setFocusPolicy(Qt::TabFocus);
  buttons_->addWidget(made);
  return made;
}

void ChartPanel::addChoice(QComboBox* box) {
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(8);
  choices_->insertWidget(0, box, 1);
  box->show();
  layOut();
}

void ChartPanel::offerQuantities(const std::vector<std::string>& names) {
  if (!quantity_) {
    quantity_ = new QComboBox(bar_);
    quantity_->setObjectName("chartQuantity");
    quantity_->setAccessibleName("Quantity");
    addChoice(quantity_);
    connect(quantity_, QOverload<int>::of(&QComboBox::activated), this, [this] {
      zoom_.reset();
      Q_EMIT quantityChosen();
    });
  }
  QStringList list;
  for (const auto& name : names)
    list << QString::fromStdString(name);
  QStringList now;
  for (int k = 0; k < quantity_->count(); ++k)
    now << quantity_->itemText(k);
  if (list == now) return;
  const QSignalBlocker blocker(quantity_);
  const QString chosen = quantity_->currentText().isEmpty() ? "speed" : quantity_->currentText();
  quantity_->clear();
  quantity_->addItems(list);
  quantity_->setCurrentIndex(std::max(0, quantity_->findText(chosen)));
}

void ChartPanel::setCurves(std::vector<analysis::Curve> curves) {
  curves_ = std::move(curves);
  QStringList names;
  for (const auto& curve : curves_)
    names << QString::fromStdString(curve.title.empty() ? curve.name : curve.title);
  if (!which_ && curves_.size() > 1) {
    which_ = new QComboBox(bar_);
    which_->setObjectName("curve");
    which_->setAccessibleName("Curve");
    addChoice(which_);
    connect(which_, QOverload<int>::of(&QComboBox::activated), this, [this](int k) {
      zoom_.reset();
      if (k >= 0 && static_cast<std::size_t>(k) < curves_.size()) show(curves_[static_cast<std::size_t>(k)]);
    });
  }
  int chosen = 0;
  if (which_) {
    const QSignalBlocker blocker(which_);
    chosen = std::max(0, static_cast<int>(names.indexOf(which_->currentText())));
    which_->clear();
    which_->addItems(names);
    which_->setCurrentIndex(chosen);
    which_->setVisible(curves_.size() > 1);
    layOut();
  }
  show(curves_[static_cast<std::size_t>(chosen)]);
}

void ChartPanel::show(analysis::Curve curve) {
  curve.title.clear(); // the panel has its own
  setCurve(std::move(curve));
}

void ChartPanel::offerKnobs(const std::vector<ParameterSpec>& knobs) {
  if (knobs.empty()) return;
  knobs_ = new QLineEdit(this);
  knobs_->setObjectName("knobs");
  knobs_->setAccessibleName("Knobs of the analysis");
  knobs_->setPlaceholderText(QString::fromStdString(knobs.front().name) +
                             "=... and others, with spaces between");
  QString tip = "Knobs as name=value, with spaces between:";
  for (const auto& knob : knobs)
    tip +=
        QString("\n%1: %2").arg(QString::fromStdString(knob.name), QString::fromStdString(knob.description));
  knobs_->setToolTip(tip);
  knobs_->hide();
  auto* shows = button("showKnobs", "Knobs", "Show the line in which the analysis can be set");
  shows->setCheckable(true);
  connect(shows, &QToolButton::toggled, knobs_, &QWidget::setVisible);
  connect(knobs_, &QLineEdit::editingFinished, this, [this] {
    if (knobs_->isModified()) Q_EMIT knobsChanged();
    knobs_->setModified(false);
  });
}

void ChartPanel::setCurve(analysis::Curve curve) {
  curve_ = std::move(curve);
  want();
}

void ChartPanel::setImage(const QImage& image, const vis::ChartPlace& place) {
  if (!curve_) return; // cleared while it was drawn
  image_ = image;
  place_ = place;
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

void ChartPanel::pin() {
  if (!curve_) return;
  for (auto series : curve_->series) {
    const QString name = pinName_.isEmpty() ? "pinned" : pinName_;
    series.name = (series.name.empty() ? "" : series.name + ", ") + name.toStdString();
    series.error.clear();
    pins_.push_back(std::move(series));
  }
  unpin_->show();
  layOut();
  want();
}

void ChartPanel::unpin() {
  pins_.clear();
  unpin_->hide();
  layOut();
  want();
}

void ChartPanel::showAll() {
  zoom_.reset();
  want();
}

analysis::Curve ChartPanel::drawn() const {
  analysis::Curve all = *curve_;
  if (!pins_.empty() && all.series.size() == 1 && all.series[0].name.empty()) all.series[0].name = "now";
  all.series.insert(all.series.end(), pins_.begin(), pins_.end());
  if (logX_->isChecked()) all = logarithmic(std::move(all), true);
  if (logY_->isChecked()) all = logarithmic(std::move(all), false);
  if (zoom_) all = cutOut(std::move(all), zoom_->first, zoom_->second);
  return all;
}

void ChartPanel::want() {
  outdated_ = true;
  const QSize size(width(), height() - bar_->height());
  if (!curve_ || !isVisible() || size.width() < smallest || size.height() < smallest) return;
  outdated_ = false;
  waiting_ = true;
  Q_EMIT wanted(objectName(), drawn(), size * devicePixelRatioF());
}

void ChartPanel::resizeEvent(QResizeEvent*) {
  layOut();
  want();
}

void ChartPanel::layOut() {
  // In one row where there is room, else what is shown above what is done with it.
  const bool fits = choices_->minimumSize().width() + buttons_->sizeHint().width() + 16 <= width();
  rows_->setDirection(fits ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
  rows_->invalidate();
  const int bar = bar_->sizeHint().height();
  bar_->setGeometry(0, height() - bar, width(), bar);
  if (knobs_)
    knobs_->setGeometry(6, height() - bar - knobs_->sizeHint().height() - 2, width() - 12,
                        knobs_->sizeHint().height());
}

void ChartPanel::showEvent(QShowEvent*) {
  if (outdated_) want();
}

double ChartPanel::valueAt(double pixel) const {
  const double share = (pixel * devicePixelRatioF() - place_.left) / (place_.right - place_.left);
  return place_.xLow + share * (place_.xHigh - place_.xLow);
}

void ChartPanel::zoomTo(double low, double high) {
  if (!(high > low)) return;
  zoom_ = {low, high};
  want();
}

void ChartPanel::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && !image_.isNull()) dragFrom_ = event->pos();
}

void ChartPanel::mouseMoveEvent(QMouseEvent* event) {
  pointer_ = event->pos();
  update();
}

void ChartPanel::mouseReleaseEvent(QMouseEvent* event) {
  const auto from = std::exchange(dragFrom_, std::nullopt);
  update();
  if (!from || std::abs(event->x() - from->x()) < shortestDrag) return;
  zoomTo(valueAt(std::min(event->x(), from->x())), valueAt(std::max(event->x(), from->x())));
}

void ChartPanel::mouseDoubleClickEvent(QMouseEvent*) {
  showAll();
}

void ChartPanel::wheelEvent(QWheelEvent* event) {
  if (image_.isNull()) return;
  const double factor = std::pow(zoomPerNotch, -event->angleDelta().y() / 120.0);
  const double x = valueAt(event->position().x());
  zoomTo(x + (place_.xLow - x) * factor, x + (place_.xHigh - x) * factor);
  event->accept();
}

bool ChartPanel::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip || !curve_ || image_.isNull()) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  if (help->y() * devicePixelRatioF() > place_.bottom) // beside the axes the pointer reads values out
    QToolTip::showText(help->globalPos(),
                       "<p>" + QString::fromStdString(curve_->definition).toHtmlEscaped() + "</p>", this);
  return true;
}

void ChartPanel::changeEvent(QEvent* event) {
  // Drawn for the ground of the theme and the size of letters.
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
    layOut();
    want();
  }
  QWidget::changeEvent(event);
}

void ChartPanel::leaveEvent(QEvent*) {
  pointer_.reset();
  update();
}

void ChartPanel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), ink().paper);
  const QRect area(0, 0, width(), height() - bar_->height());
  if (image_.isNull()) {
    painter.setPen(ink().text);
    painter.drawText(area.adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap, hint_);
    return;
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform, image_.size() != area.size() * devicePixelRatioF());
  painter.drawImage(area, image_);
  if (dragFrom_ && pointer_) {
    const int left = std::min(dragFrom_->x(), pointer_->x()), right = std::max(dragFrom_->x(), pointer_->x());
    const double r = devicePixelRatioF();
    painter.fillRect(QRectF(left, place_.top / r, right - left, (place_.bottom - place_.top) / r),
                     QColor(31, 111, 120, 40));
  }
  paintReadOut(painter);
}

void ChartPanel::paintReadOut(QPainter& painter) {
  if (!pointer_ || !curve_ || dragFrom_) return;
  const double r = devicePixelRatioF();
  const double px = pointer_->x() * r, py = pointer_->y() * r;
  if (px < place_.left || px > place_.right || py < place_.top || py > place_.bottom) return;
  const auto nearest = nearestPoint(drawn(), place_, px, py);
  if (!nearest) return;
  const QPointF at(nearest->pixelX / r, nearest->pixelY / r);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(ink().text, 1.5));
  painter.setBrush(ink().paper);
  painter.drawEllipse(at, 4, 4);
  const QString name = QString::fromStdString(nearest->series);
  const QString text = QString("%1%2, %3")
                           .arg(name.isEmpty() ? "" : name + ":  ")
                           .arg(nearest->x, 0, 'g', 5)
                           .arg(nearest->y, 0, 'g', 5);
  QRectF box = painter.fontMetrics().boundingRect(text);
  box.adjust(-6, -3, 6, 3);
  box.moveCenter(at + QPointF(0, -18));
  box.moveLeft(std::clamp(box.left(), 2.0, std::max(2.0, width() - box.width() - 2)));
  if (box.top() < 2) box.moveTop(at.y() + 10);
  painter.setPen(ink().faint);
  painter.drawRoundedRect(box, 4, 4);
  painter.setPen(ink().text);
  painter.drawText(box, Qt::AlignCenter, text);
}

} // namespace sandglass::desktop
