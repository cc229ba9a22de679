#pragma once
// The knobs that trade speed for accuracy, as the open scene sets them, and what this run really does.

#include "sim/run/run.h"
#include "sim/scene/scene.h"

#include <QTreeWidget>

#include <optional>

namespace sandglass::desktop {

class AccuracyPanel : public QTreeWidget {
  Q_OBJECT
public:
  explicit AccuracyPanel(QWidget* parent = nullptr);

  void setScene(const std::optional<Scene>& scene);
  void setProgress(const Progress& progress);
  void setFrame(const Frame& frame);
  void setPicturesPerSecond(double rate);

private:
  QTreeWidgetItem* row(QTreeWidgetItem* group, const QString& name, const QString& tip);
  QTreeWidgetItem *level_, *contact_, *step_, *stiffness_, *arithmetic_, *skin_, *limit_;
  QTreeWidgetItem *speed_, *ratio_, *left_, *overlap_, *pictures_;
  double lastTime_ = -1, lastWall_ = 0;
};

} // namespace sandglass::desktop
