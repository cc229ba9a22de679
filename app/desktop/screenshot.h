#pragma once
// A picture of the whole window, once all of its panels are up to date.

#include "app/desktop/main_window.h"

#include <QString>

namespace sandglass::desktop {

/// Runs the event loop until the window is settled, then saves what it looks like. False when it did not
/// settle within `patience` seconds or the file cannot be written.
bool saveScreenshot(MainWindow& window, const QString& file, double patience = 120);

} // namespace sandglass::desktop
