#pragma once
// Stages, pace and what may change while a run goes on.

#include "sim/run/run.h"
#include "sim/scene/scene.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QWidget>

#include <array>
#include <optional>

namespace sandglass::desktop {

class RunPanel : public QWidget {
  Q_OBJECT
public:
  explicit RunPanel(QWidget* parent = nullptr);

  void setScene(const std::optional<Scene>& scene);
  void setProgress(const std::optional<Progress>& progress, bool runs);
  void setFrame(const Frame& frame); ///< which walls there are
  void setSpeedLimit(double ratio);
  void setCanBranch(bool can) { branch_->setEnabled(can); }
  Vec3 gravity() const; ///< as the fields say

Q_SIGNALS:
  void changeWanted(const EventSpec& event);
  void speedLimitChosen(double ratio);
  void branchWanted();

private:
  void addStages();
  void addGravityAndDrag();
  void addWalls();
  void addField();
  void addEnds(); ///< of a stage, of the past that runs share
  QPushButton* button(const char* name, const QString& text, const QString& tip);
  /// By how much something is as strong or fast as the scene says.
  QDoubleSpinBox* factor(const char* name, double low, double high, const QString& tip);
  /// A row of the form for something that not every scene has.
  void showRow(QLayout* row, bool shown);
  void showStages();
  void showEvents();

  QListWidget* stages_;
  QComboBox *speed_, *walls_, *movers_, *fields_;
  std::array<QDoubleSpinBox*, 3> gravity_;
  QDoubleSpinBox *drag_, *wallPace_, *fieldFactor_;
  QPushButton *applyPace_, *applyField_, *applyGravity_, *applyDrag_, *removeWall_, *endStage_, *branch_;
  QLabel* events_;
  QFormLayout* form_;
  QLayout *motion_, *field_, *wall_; ///< rows
  std::optional<Scene> scene_;
  std::string stage_;
  bool runs_ = false, complete_ = false;
};

} // namespace sandglass::desktop
