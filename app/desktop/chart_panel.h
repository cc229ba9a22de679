#pragma once
// Shows the newest chart of a curve; the drawing thread draws it.

#include "analysis/result.h"

#include <QImage>
#include <QWidget>

#include <optional>

namespace sandglass::desktop {

class ChartPanel : public QWidget {
  Q_OBJECT
public:
  /// `hint` is shown while there is no curve.
  ChartPanel(const QString& name, const QString& hint, QWidget* parent = nullptr);

  void setCurve(analysis::Curve curve);
  void setImage(const QImage& image);
  void clear(const QString& hint);

  const std::optional<analysis::Curve>& curve() const { return curve_; }
  /// Whether what is shown, if anything, is the newest curve in the right size.
  bool isCurrent() const { return !curve_ || !isVisible() || !waiting_; }
  std::uint64_t charts() const { return charts_; } ///< shown so far
  QSize sizeHint() const override { return {380, 230}; }

Q_SIGNALS:
  /// The chart is to be drawn, in this many pixels.
  void wanted(const QString& name, const analysis::Curve& curve, QSize pixels);

protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

private:
  void want();
  std::optional<analysis::Curve> curve_;
  QImage image_;
  QString hint_;
  bool waiting_ = false;  ///< a chart was asked for
  bool outdated_ = false; ///< the curve changed while the panel was hidden
  std::uint64_t charts_ = 0;
};

} // namespace sandglass::desktop
