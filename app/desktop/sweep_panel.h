#pragma once
// The explorer of a sweep: which columns span and colour the phase diagram, which further axes are held, and
// the diagram itself. Looks for new results while the sweep goes on.

#include "app/desktop/phase_diagram.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QThreadPool>
#include <QTimer>
#include <QWidget>

#include <map>
#include <memory>

namespace sandglass::desktop {

class SweepPanel : public QWidget {
  Q_OBJECT
public:
  explicit SweepPanel(QWidget* parent = nullptr);
  ~SweepPanel() override;

  void setSweep(std::shared_ptr<const SweepData> data); ///< null: none
  const std::shared_ptr<const SweepData>& sweep() const { return data_; }
  PhaseDiagram* diagram() const { return diagram_; }
  SweepChoice choice() const;
  void setBusy(const QString& text) { state_->setText(text); }

Q_SIGNALS:
  void refreshed(std::shared_ptr<const SweepData> data); ///< the table has new rows
  void openWanted(int point);
  void csvWanted();
  void pngWanted();

private:
  void offerColumns();
  void offerHeld();
  void redraw();
  void look();
  void showState();

  std::shared_ptr<const SweepData> data_;
  QComboBox *x_, *y_, *colour_;
  QFormLayout* form_;
  std::map<std::size_t, QComboBox*> held_; ///< of further axes
  QCheckBox *critical_, *disagreement_;
  PhaseDiagram* diagram_;
  QPushButton* open_;
  QLabel* state_;
  QTimer look_;
  QThreadPool pool_;
};

} // namespace sandglass::desktop
