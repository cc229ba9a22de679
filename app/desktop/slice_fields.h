#pragma once
// The slice through a coarse-grained field, as fields of the view panel.

#include "app/desktop/numbers_edit.h"
#include "sim/frame/frame.h"
#include "vis/view.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QSlider>

namespace sandglass::desktop {

class SliceFields : public QObject {
  Q_OBJECT
public:
  explicit SliceFields(QFormLayout* form);

  /// Offers the arrays of the frame's fields, or those that are coarse-grained when it has none.
  void setFrame(const Frame& frame);
  void setView(const vis::View& view); ///< does not emit changed()
  void apply(vis::View& view) const;

Q_SIGNALS:
  void changed();

private:
  void check();
  void enable();

  QCheckBox* shown_;
  QComboBox *axis_, *quantity_, *map_;
  QSlider *place_, *opacity_;
  QCheckBox* streamlines_;
  NumbersEdit* range_;
  Vec3 lower_ = Vec3::Zero(), upper_ = Vec3::Ones();
};

} // namespace sandglass::desktop
