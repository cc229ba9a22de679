#pragma once
// The phase diagram of a sweep: one mark a point, its colour and shape the state, or its colour a number. A
// mark shared by several states is a pie; numbers that differ from seed to seed have a bar. Painted by the
// window itself: a few thousand marks cost milliseconds. A click or the arrow keys choose a point, a double
// click or Enter opens it.

#include "app/desktop/sweep_points.h"

#include <QWidget>

#include <optional>

namespace sandglass::desktop {

class PhaseDiagram : public QWidget {
  Q_OBJECT
public:
  explicit PhaseDiagram(QWidget* parent = nullptr);

  void show(std::shared_ptr<const SweepData> data, const SweepChoice& choice);
  void setCriticalShown(bool on);
  void setDisagreementShown(bool on);
  const SweepDiagram& diagram() const { return diagram_; }
  int chosen() const { return chosen_; } ///< point, or 0
  void choose(int point);                ///< emits pointChosen() when it is another one
  QPoint placeOf(int point) const;       ///< pixel of a point's mark
  bool save(const QString& file);        ///< PNG of what is shown, twice as fine
  QSize sizeHint() const override { return {520, 460}; }

Q_SIGNALS:
  void pointChosen(int point);
  void pointOpened(int point);

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  QRectF area() const; ///< of the marks
  QPointF place(double x, double y) const;
  const SweepSpot* nearest(QPointF at) const; ///< null: none within reach
  double markSize() const;
  void findLimits();
  void paintAxes(QPainter& painter);
  void paintMark(QPainter& painter, const SweepSpot& spot);
  void paintCritical(QPainter& painter);
  void paintLegend(QPainter& painter);
  QColor colourOf(const SweepSpot& spot) const;
  QString tipOf(const SweepSpot& spot) const;

  std::shared_ptr<const SweepData> data_;
  SweepChoice choice_;
  SweepDiagram diagram_;
  double xLow_ = 0, xHigh_ = 1, yLow_ = 0, yHigh_ = 1;
  double spacing_ = 0; ///< [share of the area] of neighbouring marks
  bool criticalShown_ = true, disagreementShown_ = true;
  int chosen_ = 0;
};

} // namespace sandglass::desktop
