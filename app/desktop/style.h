#pragma once
// The look of the window: one palette and style sheet, and the icons of the tool bar, drawn here so that no
// icon theme is needed.

#include <QApplication>
#include <QIcon>

namespace sandglass::desktop {

enum class Theme { light, dark };

/// `textScale`: of all text, 1 for the usual size. May be called again at any time.
void setStyle(QApplication& app, Theme theme = Theme::light, double textScale = 1);

/// Colours that panels paint with, of the theme of now.
struct Ink {
  QColor text, faint, paper, error, warning;
  double textScale;
};
const Ink& ink();

/// In the ink of the theme of now: "open", "run", "pause", "step", "stop", "fit", "save", "first", "back",
/// "forward", "last", "help", "app".
QIcon icon(const QString& name);

} // namespace sandglass::desktop
