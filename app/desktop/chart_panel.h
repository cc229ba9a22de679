#pragma once
// Shows the newest chart of a curve; the drawing thread draws it. Drag or wheel: zoom along x; double click:
// everything; the pointer reads values out. The buttons pin the curve for comparison, make axes logarithmic
// and export what is shown.

#include "analysis/result.h"
#include "sim/scene/parameters.h"
#include "vis/renderer.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QImage>
#include <QLineEdit>
#include <QToolButton>
#include <QWidget>

#include <optional>
#include <vector>

namespace sandglass::desktop {

class ChartPanel : public QWidget {
  Q_OBJECT
public:
  /// `hint` is shown while there is no curve.
  ChartPanel(const QString& name, const QString& hint, QWidget* parent = nullptr);

  void setCurve(analysis::Curve curve);
  /// Several: the panel lets the user choose which is shown.
  void setCurves(std::vector<analysis::Curve> curves);
  /// A line for knobs as "name=value ..."; emits knobsChanged().
  void offerKnobs(const std::vector<ParameterSpec>& knobs);
  QString knobs() const { return knobs_ ? knobs_->text() : QString(); }
  void setImage(const QImage& image, const vis::ChartPlace& place);
  void clear(const QString& hint);
  void setPinName(const QString& name) { pinName_ = name; } ///< of curves pinned from now on
  /// Offers these for the analysis to look at; emits quantityChosen() by the user's choice alone.
  void offerQuantities(const std::vector<std::string>& names);
  QString quantity() const { return quantity_ ? quantity_->currentText() : QString(); }

  const std::optional<analysis::Curve>& curve() const { return curve_; }
  std::size_t pinned() const { return pins_.size(); }
  /// Whether what is shown, if anything, is the newest curve in the right size.
  bool isCurrent() const { return !curve_ || !isVisible() || !waiting_; }
  std::uint64_t charts() const { return charts_; } ///< shown so far
  QSize sizeHint() const override { return {380, 230}; }

  void pin(); ///< keeps what is shown beside what comes
  void unpin();
  void showAll();                ///< ends a zoom
  analysis::Curve drawn() const; ///< with pins, zoom and logarithms

Q_SIGNALS:
  /// The chart is to be drawn, in this many pixels.
  void wanted(const QString& name, const analysis::Curve& curve, QSize pixels);
  void exportWanted(const analysis::Curve& curve, const QString& suffix); ///< "csv" or "png"
  void quantityChosen();
  void knobsChanged();

protected:
  bool event(QEvent* event) override; ///< the whole definition as tool tip: small charts cut it short
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;

private:
  QToolButton* button(const char* name, const QString& text, const QString& tip);
  void addChoice(QComboBox* box);
  void layOut();
  using QWidget::show;
  void show(analysis::Curve curve);
  void want();
  void zoomTo(double low, double high);
  double valueAt(double pixel) const; ///< of the x axis, as it is drawn
  void paintReadOut(QPainter& painter);

  QWidget* bar_;
  QBoxLayout* rows_;
  QHBoxLayout *choices_, *buttons_;
  QToolButton *logX_, *logY_, *unpin_;
  QComboBox *quantity_ = nullptr, *which_ = nullptr;
  QLineEdit* knobs_ = nullptr;
  std::vector<analysis::Curve> curves_;
  std::optional<analysis::Curve> curve_;
  std::vector<analysis::Series> pins_;
  QString pinName_;
  std::optional<std::pair<double, double>> zoom_; ///< of the drawn x axis
  QImage image_;
  vis::ChartPlace place_;
  QString hint_;
  std::optional<QPoint> pointer_, dragFrom_;
  bool waiting_ = false;  ///< a chart was asked for
  bool outdated_ = false; ///< the curve changed while the panel was hidden
  std::uint64_t charts_ = 0;
};

} // namespace sandglass::desktop
