// What the commands of the window do that takes more than a line.

#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/scene_panel.h"
#include "app/desktop/style.h"
#include "app/desktop/text_panels.h"
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"

#include <QDialog>
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QScreen>
#include <QScrollArea>
#include <QStatusBar>
#include <QVBoxLayout>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace sandglass::desktop {

void MainWindow::say(LogLevel level, const QString& text) {
  log_->add(static_cast<int>(level), text);
}

void MainWindow::complain(const QStringList& sentences) {
  statusBar()->clearMessage();
  for (const auto& sentence : sentences)
    say(LogLevel::error, sentence);
  banner_->setSentences(sentences);
}

QString MainWindow::bannerText() const {
  return banner_->isVisible() ? banner_->text() : QString();
}

bool MainWindow::mayStop(const QString& question) {
  const bool running =
      std::any_of(documents_.begin(), documents_.end(), [](const auto& d) { return d->session->runs(); });
  if (!running || options_.asksNothing) return true;
  return QMessageBox::question(this, "Sandglass", question, QMessageBox::Close | QMessageBox::Cancel,
                               QMessageBox::Cancel) == QMessageBox::Close;
}

/// Whether what the panel shows is what would run; says why not, or waits for the check.
bool MainWindow::sceneIsReady() {
  if (session_->runs() || !session_->current().scene) return true;
  if (!scene_->isSettled() && scene_->text() != session_->current().sceneText) {
    startWhenChecked_ = true;
    return false;
  }
  if (scene_->faults().isEmpty()) return true;
  complain(scene_->faults());
  docks_.at("scene")->show();
  docks_.at("scene")->raise();
  return false;
}

void MainWindow::startOrPause() {
  if (!sceneIsReady()) return;
  if (!session_->runs()) {
    banner_->setSentences({});
    session_->start();
    time_->choose(std::nullopt);
  } else {
    session_->pause(!session_->isPaused());
  }
}

void MainWindow::step(int steps) {
  if (!sceneIsReady()) return;
  const bool fresh = !session_->runs();
  session_->step(steps);
  if (fresh) time_->choose(std::nullopt);
}

void MainWindow::changeRun(const EventSpec& event) {
  const QString fault = session_->change(event);
  if (!fault.isEmpty()) complain({fault});
}

void MainWindow::setRunIcon(bool running) {
  if (std::exchange(showsPause_, running) == running) return; // a new icon lays the tool bar out again
  commands_->action("run.start")->setIcon(icon(running ? "pause" : "run"));
}

void MainWindow::usePreset(const std::string& preset) {
  picture_->forgetWheel();
  now_->view.camera.preset = preset;
  keepView("look from " + QString::fromStdString(preset));
  requestPicture();
}

void MainWindow::togglePanel(const QString& id, bool on) {
  auto* dock = docks_.at(id);
  // One that lies behind another tab is meant to come to the front, not to go.
  const bool behind = dock->isVisible() && dock->visibleRegion().isEmpty();
  commands_->action("panel." + id)->setChecked(on || behind);
  dock->setVisible(on || behind);
  if (on || behind) dock->raise();
}

void MainWindow::toggleTrack() {
  if (now_->grain < 0) return complain({"Click a grain first: its track is shown then."});
  auto& tracked = now_->view.tracks.grains;
  const auto at = std::find(tracked.begin(), tracked.end(), now_->grain);
  if (at == tracked.end())
    tracked.push_back(now_->grain);
  else
    tracked.erase(at);
  keepView("track a grain");
  requestPicture();
}

void MainWindow::showTime(double seconds) {
  const auto& store = session_->current().store;
  if (store && store->size() > 0) time_->choose(store->nearest(seconds));
}

void MainWindow::showView(const vis::View& view) {
  now_->kept = view;
  applyView(view);
}

void MainWindow::chooseFile() {
  const QString file = QFileDialog::getOpenFileName(
      this, "Open", {},
      "Scenes, frames, pictures, sessions (*.toml *.vtkhdf *.png *.mp4 *.sandglass);;All files (*)");
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

void MainWindow::chooseSceneFile() {
  const QString file = QFileDialog::getSaveFileName(this, "Save scene", "scene.toml", "Scenes (*.toml)");
  if (!file.isEmpty()) saveScene(file);
}

void MainWindow::chooseSessionFile() {
  const QString file =
      QFileDialog::getSaveFileName(this, "Save session", "work.sandglass", "Sessions (*.sandglass)");
  if (!file.isEmpty()) saveSession(file);
}

void MainWindow::savePicture(const QString& file) {
  if (!now_->shown) return;
  std::map<std::string, std::string> text;
  const auto describe = [&](const Document& document, const Frame& shown, const std::string& prefix) {
    const Opened& current = document.session->current();
    const auto& source = current.runFolder.empty() ? current.path : current.runFolder;
    text[prefix + "source"] = std::filesystem::absolute(source).string();
    if (current.store->size() > 0)
      text[prefix + "frame"] = std::to_string(current.store->nearest(shown.time));
    return FrameOrder{document.shown, nullptr, 0, current.store, runName(document)};
  };
  PictureFile order;
  order.left = describe(*now_, *now_->shown, "");
  order.left.frame = now_->shown;
  if (now_->beside && now_->shownBeside) {
    order.right = describe(*now_->beside, *now_->shownBeside, "right_");
    order.right->frame = now_->shownBeside;
  }
  order.view = now_->view;
  order.file = file.toStdString();
  order.text = std::move(text);
  drawing_->save(std::move(order));
}

void MainWindow::saveScene(const QString& file) {
  try {
    writeAtomically(file.toStdString(), now_->sceneText.toStdString());
    say(LogLevel::info, "The scene is saved in " + file + ".");
    statusBar()->showMessage("Saved " + file);
    remember(file);
  } catch (const std::exception& e) {
    complain({QString::fromUtf8(e.what())});
  }
}

void MainWindow::showCheatSheet() {
  if (auto* before = findChild<QDialog*>("cheatSheet")) return before->raise();
  auto* dialog = new QDialog(this);
  dialog->setObjectName("cheatSheet");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle("Keys and mouse");
  auto* text = new QLabel(commands_->cheatSheet({{"Turn the view", "drag"},
                                                 {"Move the view", "right drag, or Shift + drag"},
                                                 {"Zoom", "wheel"},
                                                 {"What a grain is and does", "click"},
                                                 {"Choose grains", "Ctrl + drag"},
                                                 {"See everything", "double click"},
                                                 {"Read a chart", "point at it"},
                                                 {"Zoom in a chart", "drag, or wheel; double click: all"},
                                                 {"Open", "drop a file or folder"}}));
  text->setMargin(18);
  text->setTextFormat(Qt::RichText);
  auto* scroll = new QScrollArea;
  scroll->setWidget(text);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* column = new QVBoxLayout(dialog);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(scroll);
  dialog->resize((text->sizeHint() + QSize(24, 8)).boundedTo(screen()->availableSize() * 9 / 10));
  dialog->show();
}

} // namespace sandglass::desktop
