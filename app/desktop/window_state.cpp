// What outlives the window: settings, files opened lately, and sessions.

#include "app/desktop/main_window.h"
#include "app/desktop/start_page.h"
#include "app/desktop/style.h"
#include "app/desktop/text_panels.h"
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSignalBlocker>
#include <QStatusBar>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr int layoutVersion = 5; ///< of docks and tool bars: another one starts from the built-in layout
constexpr int mostRecent = 12;
constexpr double smallestText = 0.7, largestText = 2.5;

QString base64(const QByteArray& bytes) {
  return QString::fromLatin1(bytes.toBase64());
}

QByteArray fromBase64(const QJsonValue& value) {
  return QByteArray::fromBase64(value.toString().toLatin1());
}

} // namespace

void MainWindow::readSettings() {
  if (options_.settingsFile.isEmpty()) return;
  settings_ = std::make_unique<QSettings>(options_.settingsFile, QSettings::IniFormat);
  recent_ = settings_->value("recent").toStringList();
  start_->setRecent(recent_);
  restoreGeometry(settings_->value("geometry").toByteArray());
  restoreState(settings_->value("layout").toByteArray(), layoutVersion);
  setTextScale(settings_->value("textScale", 1.0).toDouble());
  setDark(settings_->value("dark", false).toBool());
}

void MainWindow::writeSettings() {
  if (!settings_) return;
  settings_->setValue("recent", recent_);
  settings_->setValue("geometry", saveGeometry());
  settings_->setValue("layout", saveState(layoutVersion));
  settings_->setValue("textScale", textScale_);
  settings_->setValue("dark", dark_);
  settings_->sync();
}

void MainWindow::remember(const QString& path) {
  const QString whole = QFileInfo(path).absoluteFilePath();
  recent_.removeAll(whole);
  recent_.prepend(whole);
  recent_ = recent_.mid(0, mostRecent);
  start_->setRecent(recent_);
  writeSettings();
}

void MainWindow::setDark(bool on) {
  dark_ = on;
  desktop::setStyle(*qApp, on ? Theme::dark : Theme::light, textScale_);
  const QSignalBlocker blocker(commands_->action("window.dark"));
  commands_->action("window.dark")->setChecked(on);
  showsPause_ = !showsPause_; // icons have the ink of the theme
  commands_->refreshIcons();
  setRunIcon(!showsPause_);
}

void MainWindow::setTextScale(double factor) {
  textScale_ = std::clamp(factor, smallestText, largestText);
  desktop::setStyle(*qApp, dark_ ? Theme::dark : Theme::light, textScale_);
}

void MainWindow::saveSession(const QString& file) {
  now_->chosen = time_->chosen();
  QJsonArray tabs;
  const auto numberOf = [this](const Document* wanted) { // among those that are kept
    int number = 0;
    for (const auto& d : documents_) {
      if (d.get() == wanted) break;
      number += d->session->isOpen();
    }
    return number;
  };
  for (const auto& d : documents_) {
    const Opened& current = d->session->current();
    if (current.path.empty()) continue;
    const auto& place = current.runFolder.empty() ? current.path : current.runFolder;
    QJsonObject tab{{"path", QFileInfo(QString::fromStdString(place.string())).absoluteFilePath()},
                    {"view", QString::fromStdString(vis::writeView(d->view))},
                    {"grain", static_cast<qint64>(d->grain)}};
    if (d->sceneText != current.sceneText || current.runFolder.empty()) tab["scene"] = d->sceneText;
    if (d->beside) tab["beside"] = numberOf(d->beside);
    if (d->chosen && current.store->size() > 0)
      tab["time"] = current.store->time(std::min(*d->chosen, current.store->size() - 1));
    tabs.append(tab);
  }
  const QJsonObject whole{{"format", "sandglass session"},
                          {"version", 1},
                          {"tabs", tabs},
                          {"current", tabBar_->currentIndex()},
                          {"geometry", base64(saveGeometry())},
                          {"layout", base64(saveState(layoutVersion))},
                          {"dark", dark_},
                          {"textScale", textScale_}};
  try {
    writeAtomically(file.toStdString(), QJsonDocument(whole).toJson().toStdString());
    say(LogLevel::info, "The session is saved in " + file + ".");
    statusBar()->showMessage("Saved " + file);
    remember(file);
  } catch (const std::exception& e) {
    complain({QString::fromUtf8(e.what())});
  }
}

void MainWindow::openSession(const QString& file) {
  QFile in(file);
  if (!in.open(QIODevice::ReadOnly))
    return complain({file + ": the session cannot be opened; check the path"});
  QJsonParseError fault;
  const QJsonObject whole = QJsonDocument::fromJson(in.readAll(), &fault).object();
  if (fault.error != QJsonParseError::NoError || whole["format"].toString() != "sandglass session")
    return complain({file + ": this is no session of Sandglass" +
                     (fault.error != QJsonParseError::NoError
                          ? QString(" (byte %1: %2)").arg(fault.offset).arg(fault.errorString())
                          : QString())});
  setTextScale(whole["textScale"].toDouble(1));
  setDark(whole["dark"].toBool());
  restoreGeometry(fromBase64(whole["geometry"]));
  restoreState(fromBase64(whole["layout"]), layoutVersion);
  bool first = !session_->isOpen();
  std::vector<Document*> opened;
  for (const auto& entry : whole["tabs"].toArray()) {
    const QJsonObject tab = entry.toObject();
    if (!std::exchange(first, false)) newTab();
    Document* document = opened.emplace_back(now_);
    const auto once = std::make_shared<QMetaObject::Connection>();
    *once = connect(session_, &Session::opened, this, [this, document, tab, once] {
      disconnect(*once);
      try {
        document->view = document->kept =
            vis::parseView(tab["view"].toString().toStdString(), "view of the session");
      } catch (const InputError& e) {
        complain({QString::fromUtf8(e.what())});
      }
      const auto& store = document->session->current().store;
      if (tab.contains("time") && store->size() > 0)
        document->chosen = store->nearest(tab["time"].toDouble());
      if (tab.contains("scene")) document->sceneText = tab["scene"].toString();
      document->grain = static_cast<qint64>(tab["grain"].toDouble(-1));
      if (document == now_) showDocument();
    });
    session_->open(tab["path"].toString());
  }
  for (std::size_t k = 0; k < opened.size(); ++k) {
    const int beside = whole["tabs"].toArray()[static_cast<int>(k)].toObject()["beside"].toInt(-1);
    if (beside < 0 || beside >= static_cast<int>(opened.size()) ||
        opened[k] == opened[static_cast<std::size_t>(beside)])
      continue;
    setBeside(opened[k], opened[static_cast<std::size_t>(beside)]);
  }
  showTab(std::clamp(whole["current"].toInt(), 0, tabs() - 1));
  remember(file);
}

} // namespace sandglass::desktop
