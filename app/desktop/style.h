#pragma once
// The look of the window: one palette and style sheet, and the icons of the tool bar, drawn here so that no
// icon theme is needed.

#include <QApplication>
#include <QIcon>

namespace sandglass::desktop {

void setStyle(QApplication& app);

/// "open", "run", "pause", "step", "stop", "fit", "save", "first", "back", "forward", "last", "help", "app".
QIcon icon(const QString& name);

} // namespace sandglass::desktop
