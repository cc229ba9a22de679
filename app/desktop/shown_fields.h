#pragma once
// What of a frame is drawn, and on which ground, as fields of the view panel.

#include "vis/view.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QSlider>
#include <QSpinBox>

namespace sandglass::desktop {

class ShownFields : public QObject {
  Q_OBJECT
public:
  explicit ShownFields(QFormLayout* form);

  void setView(const vis::View& view); ///< does not emit changed()
  void apply(vis::View& view) const;

Q_SIGNALS:
  void changed();

private:
  struct Box {
    QCheckBox* box;
    bool vis::View::*field;
  };
  std::vector<Box> boxes_;
  QCheckBox* dark_;
  QSlider* opacity_;
  QDoubleSpinBox* grainScale_;
  QSpinBox* copies_;
};

} // namespace sandglass::desktop
