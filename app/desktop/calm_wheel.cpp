#include "app/desktop/calm_wheel.h"

#include <QAbstractScrollArea>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QEvent>
#include <QSlider>

namespace sandglass::desktop {

namespace {

bool scrolls(const QWidget* field) {
  for (const QWidget* above = field->parentWidget(); above; above = above->parentWidget())
    if (qobject_cast<const QAbstractScrollArea*>(above)) return true;
  return false;
}

} // namespace

bool CalmWheel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Wheel && event->type() != QEvent::Polish) return false;
  auto* field = qobject_cast<QWidget*>(watched);
  if (!qobject_cast<QComboBox*>(field) && !qobject_cast<QAbstractSpinBox*>(field) &&
      !qobject_cast<QSlider*>(field))
    return false;
  if (event->type() == QEvent::Polish) {
    if (field->focusPolicy() == Qt::WheelFocus) field->setFocusPolicy(Qt::StrongFocus);
    return false;
  }
  if (!scrolls(field)) return false;
  event->ignore(); // what is above gets it
  return true;
}

} // namespace sandglass::desktop
