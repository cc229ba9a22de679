#pragma once
// Colours and shapes of the marks of a phase diagram.

#include <QColor>
#include <QPainterPath>

namespace sandglass::desktop {

QColor classColour(int which);     ///< of a state or another class; negative: none
QColor numberColour(double share); ///< of a number, as a share of the range; NaN is grey
QPainterPath shapeOf(int which);   ///< of a class, of unit width about the origin; repeats after six

} // namespace sandglass::desktop
