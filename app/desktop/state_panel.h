#pragma once
// The state of what is shown: in words, the evidence rule by rule with the thresholds, and curves. The states
// of a bed in a vortex and the general map (solid, liquid, gas) beside each other.

#include "analysis/results.h"
#include "app/desktop/chart_panel.h"

#include <QLabel>
#include <QTreeWidget>
#include <QWidget>

namespace sandglass::desktop {

class StatePanel : public QWidget {
  Q_OBJECT
public:
  explicit StatePanel(const QString& hint, QWidget* parent = nullptr);

  ChartPanel* chart() const { return chart_; }
  void show(const analysis::Results& results); ///< all but the curves, which the chart gets
  void clear();
  QString sentence() const { return sentence_->text(); }

private:
  using QWidget::show;
  void addTable(const analysis::Table& table);

  QLabel* sentence_;
  QTreeWidget* evidence_;
  ChartPanel* chart_;
};

} // namespace sandglass::desktop
