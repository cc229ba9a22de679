#pragma once
// What is known of the chosen point of a sweep: parameters and results of its runs, and curves of one of
// them.

#include "app/desktop/chart_panel.h"
#include "app/desktop/sweep_points.h"

#include <QComboBox>
#include <QTreeWidget>
#include <QWidget>

namespace sandglass::desktop {

class PointPanel : public QWidget {
  Q_OBJECT
public:
  explicit PointPanel(const QString& hint, QWidget* parent = nullptr);

  ChartPanel* chart() const { return chart_; }
  void show(const SweepData& data, int point);
  void clear();
  int run() const; ///< of the chosen seed; 0: none

Q_SIGNALS:
  void runChosen(int run);

private:
  using QWidget::show;

  QComboBox* seed_;
  QTreeWidget* values_;
  ChartPanel* chart_;
};

} // namespace sandglass::desktop
