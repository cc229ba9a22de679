#pragma once
// In a form that scrolls the wheel scrolls: a value must not change because somebody moves on over its field.

#include <QObject>

namespace sandglass::desktop {

/// Installed on the application: fields inside scroll areas pass the wheel on and take no focus by it.
class CalmWheel : public QObject {
public:
  using QObject::QObject;

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace sandglass::desktop
