// What the commands of the window do that takes more than a line.

#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/style.h"
#include "app/desktop/view_panel.h"
#include "sim/base/error.h"
#include "vis/survey.h"

#include <QDialog>
#include <QFileDialog>
#include <QLabel>
#include <QScrollArea>
#include <QStatusBar>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace sandglass::desktop {

void MainWindow::startOrPause() {
  if (!session_->runs()) {
    session_->start();
    time_->choose(std::nullopt);
  } else {
    session_->pause(!session_->isPaused());
  }
}

void MainWindow::setRunIcon(bool running) {
  if (std::exchange(showsPause_, running) == running) return; // a new icon lays the tool bar out again
  commands_->action("run.start")->setIcon(icon(running ? "pause" : "run"));
}

void MainWindow::usePreset(const std::string& preset) {
  view_.camera.preset = preset;
  requestPicture();
}

void MainWindow::showTime(double seconds) {
  const auto& store = session_->current().store;
  if (store && store->size() > 0) time_->choose(store->nearest(seconds));
}

void MainWindow::showView(const vis::View& view) {
  view_ = view;
  viewPanel_->setView(view);
  scanRunRange();
  requestPicture();
}

void MainWindow::chooseFile() {
  const QString file = QFileDialog::getOpenFileName(
      this, "Open", {}, "Scenes, frames, pictures (*.toml *.vtkhdf *.png);;All files (*)");
  if (!file.isEmpty()) open(file);
}

void MainWindow::chooseFolder() {
  const QString folder = QFileDialog::getExistingDirectory(this, "Open the folder of a run");
  if (!folder.isEmpty()) open(folder);
}

void MainWindow::choosePictureFile() {
  const QString file = QFileDialog::getSaveFileName(this, "Save picture", "picture.png", "PNG (*.png)");
  if (!file.isEmpty()) savePicture(file);
}

void MainWindow::savePicture(const QString& file) {
  if (!shown_) return;
  const Opened& current = session_->current();
  const auto source = std::filesystem::absolute(current.runFolder.empty() ? current.path : current.runFolder);
  drawing_->save({shown_, view_, file.toStdString(), {{"source", source.string()}}});
}

void MainWindow::showCheatSheet() {
  auto* dialog = new QDialog(this);
  dialog->setObjectName("cheatSheet");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle("Keys and mouse");
  auto* text = new QLabel(commands_->cheatSheet({{"Turn the view", "drag"},
                                                 {"Move the view", "right drag, or Shift + drag"},
                                                 {"Zoom", "wheel"},
                                                 {"What a grain is and does", "click"},
                                                 {"See everything", "double click"},
                                                 {"Open", "drop a file or folder"}}));
  text->setMargin(18);
  text->setTextFormat(Qt::RichText);
  auto* scroll = new QScrollArea;
  scroll->setWidget(text);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* column = new QVBoxLayout(dialog);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(scroll);
  dialog->resize(text->sizeHint() + QSize(24, 8));
  dialog->show();
}

void MainWindow::onPicked(qint64 grain) {
  if (!shown_ || grain < 0) return statusBar()->showMessage("No grain there.");
  const auto at = std::find(shown_->id.begin(), shown_->id.end(), grain);
  if (at == shown_->id.end()) return;
  const auto k = static_cast<std::size_t>(at - shown_->id.begin());
  const Vec3& x = shown_->position[k];
  QString text = QString("Grain %1    at (%2, %3, %4) m").arg(grain).arg(x.x()).arg(x.y()).arg(x.z());
  for (const auto& [name, values] : shown_->scalars)
    text += QString("    %1 %2 %3")
                .arg(QString::fromStdString(name))
                .arg(values[k])
                .arg(QString::fromStdString(unitOf(name)));
  for (const auto& [name, values] : shown_->vectors)
    text += QString("    |%1| %2 %3")
                .arg(QString::fromStdString(name))
                .arg(values[k].norm())
                .arg(QString::fromStdString(unitOf(name)));
  statusBar()->showMessage(text);
  say(LogLevel::info, text);
}

void MainWindow::scanRunRange() {
  const std::string quantity = view_.colouring.quantity;
  const auto store = session_->isOpen() ? session_->current().store : nullptr;
  if (view_.colouring.range != vis::ColourRange::run || quantity.empty() || !store) return;
  if (range_.quantity == quantity && range_.store == store.get()) return;
  range_ = {quantity, store.get(), {0, 0}, false};
  pool_.start([this, store, quantity] {
    QString fault;
    std::array<double, 2> limits{0, 1};
    const bool any = store->size() > 0;
    try {
      if (any) limits = vis::survey({store.get()}, quantity).run;
    } catch (const Error& e) {
      fault = QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(this, [this, store, quantity, limits, fault, any] {
      if (range_.quantity != quantity || range_.store != store.get()) return;
      if (!fault.isEmpty()) return complain({fault});
      if (!any) return;
      range_.limits = range_.known ? std::array{std::min(limits[0], range_.limits[0]),
                                                std::max(limits[1], range_.limits[1])}
                                   : limits;
      range_.known = true;
      requestPicture();
    });
  });
}

void MainWindow::widenRunRange(const Frame& frame) {
  if (view_.colouring.range != vis::ColourRange::run || view_.colouring.quantity.empty()) return;
  scanRunRange(); // a run that has just begun has a store of its own
  try {
    for (const double value : grainScalar(frame, view_.colouring.quantity)) {
      if (!std::isfinite(value)) continue;
      if (!range_.known) range_.limits = {value, value};
      range_.known = true;
      range_.limits = {std::min(range_.limits[0], value), std::max(range_.limits[1], value)};
    }
  } catch (const Error&) {
    // The frame lacks the quantity; drawing it says so.
  }
}

} // namespace sandglass::desktop
