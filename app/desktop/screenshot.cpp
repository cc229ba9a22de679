#include "app/desktop/screenshot.h"

#include <QElapsedTimer>
#include <QEventLoop>
#include <QPixmap>
#include <QTimer>

namespace sandglass::desktop {

bool saveScreenshot(MainWindow& window, const QString& file, double patience) {
  constexpr int look = 100, calm = 5; // [ms]; looks in a row that find nothing left to do
  QEventLoop loop;
  QElapsedTimer since;
  since.start();
  int settled = 0;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, [&] {
    settled = window.isSettled() ? settled + 1 : 0;
    if (settled >= calm || since.elapsed() > 1000 * patience || !window.bannerText().isEmpty()) loop.quit();
  });
  timer.start(look);
  loop.exec();
  return settled >= calm && window.grab().save(file, "PNG");
}

} // namespace sandglass::desktop
