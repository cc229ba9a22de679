#pragma once
// The cuts of a view by a box and by a cylinder, as fields: typed numbers take effect as soon as they are
// sound.

#include "app/desktop/numbers_edit.h"
#include "vis/view.h"

#include <QCheckBox>
#include <QFormLayout>

namespace sandglass::desktop {

/// Rows in the form of the view panel. Further boxes and cylinders of the view are kept as they are.
class ClipFields : public QObject {
  Q_OBJECT
public:
  explicit ClipFields(QFormLayout* form);

  /// Where a box or cylinder begins that is switched on: the middle half of this space.
  void setSpace(const Vec3& lower, const Vec3& upper);
  void setView(const vis::View& view); ///< does not emit changed()
  void apply(vis::View& view) const;

Q_SIGNALS:
  void changed();

private:
  void addBox(QFormLayout* form);
  void addCylinder(QFormLayout* form);
  void check();
  void enable();

  QCheckBox *box_, *boxOutside_, *cylinder_, *cylinderOutside_;
  NumbersEdit *lower_, *upper_, *point_, *axis_, *radius_;
  vis::ClipBox soundBox_;
  vis::ClipCylinder soundCylinder_;
  bool boxTouched_ = false, cylinderTouched_ = false; ///< set by hand or by a view, not by setSpace()
};

} // namespace sandglass::desktop
