// Files of other programs whose columns, units or sizes somebody has to name.

#include "app/desktop/import_dialog.h"
#include "app/desktop/main_window.h"
#include "sim/base/error.h"

#include <QFileDialog>
#include <QPointer>

namespace sandglass::desktop {

void MainWindow::chooseColumns() {
  const Opened& current = session_->current();
  if (now_->shown && now_->shown->provenance.contains("format"))
    return mapColumns(QString::fromStdString(current.path.string()), {});
  const QString file = QFileDialog::getOpenFileName(this, "Columns of a file of another program");
  if (!file.isEmpty()) mapColumns(file, {});
}

void MainWindow::mapColumns(const QString& path, const QString& reason) {
  struct Found {
    ForeignFacts facts;
    ImportSettings settings;
    QStringList faults;
  };
  ++surveys_;
  pool_.start([this, path, reason, given = options_.session.import] {
    auto found = std::make_shared<Found>();
    try {
      found->facts = foreignFacts(path.toStdString(), given ? &*given : nullptr);
      found->settings = given ? *given : settingsBeside(found->facts.file);
    } catch (const InputError& e) {
      for (const auto& sentence : e.sentences())
        found->faults << QString::fromStdString(sentence);
    } catch (const std::exception& e) {
      found->faults << QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(this, [this, path, reason, found] {
      --surveys_;
      if (!found->faults.isEmpty()) { // nothing in it can be named; a reason has been told already
        if (reason.isEmpty()) complain(found->faults);
        return;
      }
      if (auto* before = findChild<ImportDialog*>()) before->close();
      auto* dialog = new ImportDialog(path, found->facts, found->settings, reason, this);
      connect(dialog, &ImportDialog::saved, this, [this](const QString& file, const QString& settingsFile) {
        say(LogLevel::info, "What the columns are is kept in " + settingsFile + ".");
        options_.session.import.reset(); // from now on what lies beside the file
        for (const auto& document : documents_)
          document->session->forgetImport();
        open(file);
      });
      dialog->show(); // beside the window, which goes on
    });
  });
}

/// Where a file of another program could not be opened, its columns may still be named.
void MainWindow::onOpenFailed(const QStringList& sentences) {
  complain(sentences);
  const auto* session = qobject_cast<Session*>(sender());
  if (!session || session != session_) return;
  const QString path = session->asked();
  if (!path.isEmpty() && isForeign(path.toStdString()) && !path.endsWith(".toml") && !path.endsWith(".png") &&
      !path.endsWith(".mp4"))
    mapColumns(path, sentences.join("\n"));
}

/// Frames are read when they are drawn: there a file says what it lacks.
void MainWindow::onDrawingFailed(const QString& sentence) {
  complain({sentence});
  const Opened& current = session_->current();
  if (now_->shown || now_->columnsOffered || current.path.empty() || current.store->size() == 0 ||
      !isForeign(current.path))
    return;
  now_->columnsOffered = true;
  mapColumns(QString::fromStdString(current.path.string()), sentence);
}

/// A file without radii is drawn with some of their own, and its owner asked for the true ones.
void MainWindow::offerColumns() {
  const Frame& frame = *now_->shown;
  if (now_->columnsOffered || frame.size() == 0 || !frame.provenance.contains("format") ||
      frame.has(quantity::radius))
    return;
  now_->columnsOffered = true;
  mapColumns(QString::fromStdString(session_->current().path.string()),
             "The file holds no radii: the grains are drawn with a guess. Choose their column, or give one.");
}

} // namespace sandglass::desktop
