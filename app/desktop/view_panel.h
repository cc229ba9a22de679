#pragma once
// How the picture is drawn: colours, their range, cuts, which grains, what is shown, a slice through a field.

#include "app/desktop/clip_fields.h"
#include "app/desktop/shown_fields.h"
#include "app/desktop/slice_fields.h"
#include "sim/frame/frame.h"
#include "vis/view.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QScrollArea>
#include <QSlider>
#include <QSpinBox>

namespace sandglass::desktop {

class ViewPanel : public QScrollArea {
  Q_OBJECT
public:
  explicit ViewPanel(QWidget* parent = nullptr);
  QSize minimumSizeHint() const override; ///< as wide as what it holds

  /// Offers the quantities and the extent of this frame.
  void setFrame(const Frame& frame);
  /// Shows a view; does not emit changed().
  void setView(const vis::View& view);
  /// Writes what the panel decides into `view`: all but the camera and the size.
  void apply(vis::View& view) const;

Q_SIGNALS:
  void changed();

private:
  void addColours(QFormLayout* form);
  void addClip(QFormLayout* form);
  void addForces(QFormLayout* form);
  void enable();
  Vec3 clipPoint() const;

  QComboBox *quantity_, *map_, *range_;
  QDoubleSpinBox *low_, *high_;
  QCheckBox* clips_;
  QComboBox* axis_;
  QSlider* position_;
  QCheckBox* flip_;
  QCheckBox *chains_, *reversed_;
  QSpinBox* bands_;
  QComboBox *arrows_, *selectionUse_;
  QLineEdit* selection_;
  ShownFields* shown_;
  ClipFields* cuts_;
  SliceFields* slice_;
  Vec3 lower_ = Vec3::Zero(), upper_ = Vec3::Ones();
  std::vector<std::string> names_; ///< of the quantities offered
};

} // namespace sandglass::desktop
