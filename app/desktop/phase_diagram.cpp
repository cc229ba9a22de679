#include "app/desktop/phase_diagram.h"

#include "app/desktop/diagram_marks.h"
#include "app/desktop/style.h"
#include "vis/ticks.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sandglass::desktop {

namespace {

constexpr double left = 66, right = 150, top = 18, bottom = 56; ///< [pixel] of the margins
constexpr double smallestMark = 5, largestMark = 26;
constexpr double room = 0.06; ///< beside the outermost marks, in shares of the range

QString axisText(const analysis::SweepColumn& column, int exponent) {
  return QString::fromStdString(vis::axisTitle(column.name, column.unit == "1" ? "" : column.unit, exponent));
}

/// The smallest gap between different places, as a share of the range.
double smallestGap(std::set<double> places, double range) {
  double gap = range;
  for (auto it = places.begin(); it != places.end() && std::next(it) != places.end(); ++it)
    if (*std::next(it) - *it > 1e-9 * range) gap = std::min(gap, *std::next(it) - *it);
  return range > 0 ? gap / range : 1;
}

} // namespace

PhaseDiagram::PhaseDiagram(QWidget* parent) : QWidget(parent) {
  setObjectName("phaseDiagram");
  setAccessibleName("Phase diagram");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(300, 240);
}

void PhaseDiagram::show(std::shared_ptr<const SweepData> data, const SweepChoice& choice) {
  data_ = std::move(data);
  choice_ = choice;
  diagram_ = data_ && data_->columns.size() > 1 ? diagramOf(*data_, choice_) : SweepDiagram{};
  findLimits();
  update();
}

void PhaseDiagram::findLimits() {
  std::set<double> xs, ys;
  for (const auto& spot : diagram_.spots)
    xs.insert(spot.x), ys.insert(spot.y);
  const auto limits = [](const std::set<double>& places, double& low, double& high) {
    low = places.empty() ? 0 : *places.begin();
    high = places.empty() ? 1 : *places.rbegin();
    const double range = high - low, beside = range > 0 ? room * range : std::max(std::abs(low), 1.0) * room;
    low -= beside;
    high += beside;
  };
  limits(xs, xLow_, xHigh_);
  limits(ys, yLow_, yHigh_);
  spacing_ = std::min(smallestGap(xs, xHigh_ - xLow_), smallestGap(ys, yHigh_ - yLow_));
}

void PhaseDiagram::setCriticalShown(bool on) {
  criticalShown_ = on;
  update();
}

void PhaseDiagram::setDisagreementShown(bool on) {
  disagreementShown_ = on;
  update();
}

QRectF PhaseDiagram::area() const {
  return {left, top, std::max(20.0, width() - left - right), std::max(20.0, height() - top - bottom)};
}

QPointF PhaseDiagram::place(double x, double y) const {
  const QRectF a = area();
  return {a.left() + a.width() * (x - xLow_) / (xHigh_ - xLow_),
          a.bottom() - a.height() * (y - yLow_) / (yHigh_ - yLow_)};
}

QPoint PhaseDiagram::placeOf(int point) const {
  for (const auto& spot : diagram_.spots)
    if (spot.point == point) return place(spot.x, spot.y).toPoint();
  return {-1, -1};
}

double PhaseDiagram::markSize() const {
  return std::clamp(0.75 * spacing_ * std::min(area().width(), area().height()), smallestMark, largestMark);
}

const SweepSpot* PhaseDiagram::nearest(QPointF at) const {
  const SweepSpot* best = nullptr;
  double least = std::max(10.0, markSize());
  for (const auto& spot : diagram_.spots) {
    const QPointF way = place(spot.x, spot.y) - at;
    if (const double distance = std::hypot(way.x(), way.y()); distance < least)
      least = distance, best = &spot;
  }
  return best;
}

void PhaseDiagram::choose(int point) {
  if (point == chosen_) return;
  chosen_ = point;
  update();
  if (point > 0) Q_EMIT pointChosen(point);
}

QColor PhaseDiagram::colourOf(const SweepSpot& spot) const {
  if (!diagram_.classes.empty()) return classColour(spot.shownClass);
  const double range = diagram_.high - diagram_.low;
  return numberColour(range > 0 ? (spot.value - diagram_.low) / range : 0 * spot.value + 0.5);
}

void PhaseDiagram::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), ink().paper);
  if (!data_ || diagram_.spots.empty()) {
    painter.setPen(ink().text);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     "No point of the sweep has these columns yet.");
    return;
  }
  paintAxes(painter);
  painter.save();
  painter.setClipRect(area());
  for (const auto& spot : diagram_.spots)
    paintMark(painter, spot);
  if (criticalShown_) paintCritical(painter);
  painter.restore();
  paintLegend(painter);
}

void PhaseDiagram::paintAxes(QPainter& painter) {
  const QRectF a = area();
  painter.setPen(QPen(ink().faint, 1));
  painter.drawRect(a);
  const auto &x = data_->columns[choice_.x], &y = data_->columns[choice_.y];
  const vis::Ticks across = vis::niceTicks(xLow_, xHigh_, std::max(2, static_cast<int>(a.width() / 80)));
  const vis::Ticks up = vis::niceTicks(yLow_, yHigh_, std::max(2, static_cast<int>(a.height() / 50)));
  for (std::size_t k = 0; k < across.values.size(); ++k) {
    const double at = place(across.values[k], yLow_).x();
    painter.setPen(QPen(ink().faint, 1));
    painter.drawLine(QPointF(at, a.bottom()), QPointF(at, a.bottom() + 5));
    painter.setPen(ink().text);
    painter.drawText(QRectF(at - 40, a.bottom() + 6, 80, 18), Qt::AlignCenter,
                     QString::fromStdString(across.labels[k]));
  }
  for (std::size_t k = 0; k < up.values.size(); ++k) {
    const double at = place(xLow_, up.values[k]).y();
    painter.setPen(QPen(ink().faint, 1));
    painter.drawLine(QPointF(a.left() - 5, at), QPointF(a.left(), at));
    painter.setPen(ink().text);
    painter.drawText(QRectF(a.left() - 52, at - 9, 44, 18), Qt::AlignRight | Qt::AlignVCenter,
                     QString::fromStdString(up.labels[k]));
  }
  painter.drawText(QRectF(a.left(), a.bottom() + 26, a.width(), 20), Qt::AlignCenter,
                   axisText(x, across.exponent));
  painter.save();
  painter.translate(14, a.center().y());
  painter.rotate(-90);
  painter.drawText(QRectF(-a.height() / 2, -9, a.height(), 18), Qt::AlignCenter, axisText(y, up.exponent));
  painter.restore();
}

void PhaseDiagram::paintMark(QPainter& painter, const SweepSpot& spot) {
  const QPointF at = place(spot.x, spot.y);
  const double size = markSize();
  painter.save();
  painter.translate(at);
  if (spot.failed) {
    painter.setPen(QPen(ink().error, 1.6));
    painter.drawLine(QPointF(-0.35 * size, -0.35 * size), QPointF(0.35 * size, 0.35 * size));
    painter.drawLine(QPointF(-0.35 * size, 0.35 * size), QPointF(0.35 * size, -0.35 * size));
  } else if (!spot.done) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(ink().faint);
    painter.drawEllipse(QPointF(0, 0), 2, 2);
  } else if (disagreementShown_ && spot.classes.size() > 1) {
    int runs = 0;
    for (const auto& [which, count] : spot.classes)
      runs += count;
    double from = 90 * 16;
    painter.setPen(QPen(ink().text, 0.8));
    for (const auto& [which, count] : spot.classes) {
      painter.setBrush(classColour(which));
      painter.drawPie(QRectF(-size / 2, -size / 2, size, size), static_cast<int>(std::lround(from)),
                      static_cast<int>(std::lround(-360.0 * 16 * count / runs)));
      from -= 360.0 * 16 * count / runs;
    }
  } else {
    painter.setPen(QPen(ink().text, 0.5));
    painter.setBrush(colourOf(spot));
    painter.save();
    painter.scale(size, size);
    QPen thin(ink().text, 0.5 / size);
    painter.setPen(thin);
    painter.drawPath(shapeOf(diagram_.classes.empty() ? 1 : spot.shownClass));
    painter.restore();
    if (disagreementShown_ && diagram_.classes.empty() && spot.disagreement > 0) {
      const double length = std::min(1.0, spot.disagreement) * size; // as long as the mark: the whole range
      painter.setPen(QPen(ink().paper, 3));
      painter.drawLine(QPointF(0, -length / 2), QPointF(0, length / 2));
      painter.setPen(QPen(ink().text, 1.4));
      painter.drawLine(QPointF(0, -length / 2), QPointF(0, length / 2));
    }
  }
  if (spot.point == chosen_) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(ink().text, 2.2));
    const double half = 0.5 * size + 4;
    painter.drawRect(QRectF(-half, -half, 2 * half, 2 * half));
  }
  painter.restore();
}

void PhaseDiagram::paintCritical(QPainter& painter) {
  if (diagram_.critical.empty()) return;
  QPainterPath path;
  const auto& c = diagram_.critical;
  path.moveTo(place(c.front().first, c.front().second));
  for (const auto& [x, y] : c)
    path.lineTo(place(x, y));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(ink().paper, 5));
  painter.drawPath(path);
  painter.setPen(QPen(ink().text, 2, Qt::DashLine));
  painter.drawPath(path);
}

void PhaseDiagram::paintLegend(QPainter& painter) {
  const QRectF a = area();
  double y = a.top() + 8;
  const double x = a.right() + 18;
  const auto write = [&](const QString& text) {
    painter.setPen(ink().text);
    painter.drawText(QRectF(x + 18, y - 9, right - 38, 18), Qt::AlignLeft | Qt::AlignVCenter, text);
    y += 21;
  };
  if (!diagram_.classes.empty()) {
    for (std::size_t k = 0; k < diagram_.classes.size(); ++k) {
      painter.save();
      painter.translate(x + 4, y);
      painter.scale(13, 13);
      painter.setPen(QPen(ink().text, 0.5 / 13));
      painter.setBrush(classColour(static_cast<int>(k)));
      painter.drawPath(shapeOf(static_cast<int>(k)));
      painter.restore();
      write(QString::fromStdString(diagram_.classes[k]));
    }
  } else {
    const double height = std::min(180.0, a.height() - 60);
    painter.setPen(ink().text);
    const vis::Ticks ticks = vis::niceTicks(diagram_.low, diagram_.high, 5);
    painter.drawText(QRectF(a.right() + 8, y - 9, right - 10, 36), Qt::AlignLeft | Qt::TextWordWrap,
                     axisText(data_->columns[choice_.colour], ticks.exponent));
    y += 36;
    for (int k = 0; k < static_cast<int>(height); ++k)
      painter.fillRect(QRectF(x, y + height - 1 - k, 14, 1.5), numberColour(k / height));
    const double range = diagram_.high - diagram_.low;
    for (std::size_t k = 0; k < ticks.values.size(); ++k) {
      const double share = range > 0 ? (ticks.values[k] - diagram_.low) / range : 0.5;
      painter.drawText(QRectF(x + 20, y + height * (1 - share) - 9, right - 40, 18),
                       Qt::AlignLeft | Qt::AlignVCenter, QString::fromStdString(ticks.labels[k]));
    }
    y += height + 22;
  }
  if (criticalShown_ && !diagram_.critical.empty()) {
    painter.setPen(QPen(ink().text, 2, Qt::DashLine));
    painter.drawLine(QPointF(x - 8, y), QPointF(x + 14, y));
    write(QString("critical ") + QChar(0x03A9));
  }
  if (data_->waiting > 0) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(ink().faint);
    painter.drawEllipse(QPointF(x + 4, y), 2, 2);
    write(QString("not run yet"));
  }
  if (data_->failed > 0) {
    painter.setPen(QPen(ink().error, 1.6));
    painter.drawLine(QPointF(x, y - 4), QPointF(x + 8, y + 4));
    painter.drawLine(QPointF(x, y + 4), QPointF(x + 8, y - 4));
    write("failed");
  }
}

QString PhaseDiagram::tipOf(const SweepSpot& spot) const {
  QStringList lines{QString("point %1").arg(spot.point)};
  const auto& first = data_->rows[spot.rows.front()];
  for (std::size_t k = 0; k < data_->axes; ++k)
    lines << QString("%1 = %2 %3")
                 .arg(QString::fromStdString(data_->columns[k].name),
                      QString::fromStdString(cellText(*data_, first, k)),
                      QString::fromStdString(data_->columns[k].unit == "1" ? "" : data_->columns[k].unit));
  for (const auto& [which, count] : spot.classes)
    lines << QString("%1: %2 of the seeds")
                 .arg(QString::fromStdString(diagram_.classes[static_cast<std::size_t>(which)]))
                 .arg(count);
  if (diagram_.classes.empty() && std::isfinite(spot.value)) {
    const QString name = QString::fromStdString(data_->columns[choice_.colour].name);
    lines << QString("%1 = %2").arg(name).arg(spot.value, 0, 'g', 5) +
                 (spot.deviation > 0 ? QString(" %1 %2").arg(QChar(0x00B1)).arg(spot.deviation, 0, 'g', 2)
                                     : QString());
  }
  for (const auto k : spot.rows)
    if (!data_->rows[k].fault.empty()) lines << QString::fromStdString(data_->rows[k].fault);
  return lines.join("\n");
}

void PhaseDiagram::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const auto* spot = nearest(event->localPos())) choose(spot->point);
}

void PhaseDiagram::mouseMoveEvent(QMouseEvent* event) {
  const auto* spot = nearest(event->localPos());
  if (spot)
    QToolTip::showText(event->globalPos(), tipOf(*spot), this);
  else
    QToolTip::hideText();
}

void PhaseDiagram::mouseDoubleClickEvent(QMouseEvent* event) {
  if (const auto* spot = nearest(event->localPos())) Q_EMIT pointOpened(spot->point);
}

/// To the nearest mark in the direction of the arrow, those straight ahead before those aside.
void PhaseDiagram::keyPressEvent(QKeyEvent* event) {
  const bool opens = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (opens && chosen_ > 0) return Q_EMIT pointOpened(chosen_);
  QPointF way;
  switch (event->key()) {
  case Qt::Key_Left:
    way = {-1, 0};
    break;
  case Qt::Key_Right:
    way = {1, 0};
    break;
  case Qt::Key_Up:
    way = {0, -1};
    break;
  case Qt::Key_Down:
    way = {0, 1};
    break;
  default:
    return QWidget::keyPressEvent(event);
  }
  if (diagram_.spots.empty()) return;
  if (chosen_ == 0) return choose(diagram_.spots.front().point);
  const QPointF from = placeOf(chosen_);
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& spot : diagram_.spots) {
    const QPointF step = place(spot.x, spot.y) - from;
    const double ahead = QPointF::dotProduct(step, way),
                 aside = std::abs(step.x() * way.y() - step.y() * way.x());
    if (ahead < 2) continue;
    if (const double cost = ahead + 3 * aside; cost < least) least = cost, best = spot.point;
  }
  if (best > 0) choose(best);
}

bool PhaseDiagram::save(const QString& file) {
  QPixmap picture(size() * 2);
  picture.setDevicePixelRatio(2);
  const int before = std::exchange(chosen_, 0);
  render(&picture);
  chosen_ = before;
  return picture.save(file, "PNG");
}

} // namespace sandglass::desktop
