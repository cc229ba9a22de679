// The explorer of a sweep in the window: a chosen point shows its last frame, curves and parameters; an
// opened one becomes a run in a tab of its own, computed again where its frames were not kept.

#include "app/desktop/chart_panel.h"
#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/point_panel.h"
#include "app/desktop/sweep_panel.h"
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"

#include <QFileDialog>
#include <QStatusBar>

namespace sandglass::desktop {

void MainWindow::connectSweep() {
  connect(sweep_->diagram(), &PhaseDiagram::pointChosen, this, &MainWindow::choosePoint);
  connect(sweep_, &SweepPanel::openWanted, this, &MainWindow::openPoint);
  connect(sweep_, &SweepPanel::refreshed, this, [this](const std::shared_ptr<const SweepData>& data) {
    session_->setSweep(data);
    const int point = sweep_->diagram()->chosen();
    if (point > 0) choosePoint(point);
  });
  connect(sweep_, &SweepPanel::csvWanted, this, [this] {
    const QString file = QFileDialog::getSaveFileName(this, "Save the table", "sweep.csv", "CSV (*.csv)");
    if (!file.isEmpty()) saveSweepTable(file);
  });
  connect(sweep_, &SweepPanel::pngWanted, this, [this] {
    const QString file =
        QFileDialog::getSaveFileName(this, "Save the diagram", "phase_diagram.png", "PNG (*.png)");
    if (file.isEmpty()) return;
    if (sweep_->diagram()->save(file))
      statusBar()->showMessage("Saved " + file);
    else
      complain({file + ": the diagram cannot be written there; check the folder"});
  });
  connect(point_, &PointPanel::runChosen, this, &MainWindow::showSweepRun);
}

void MainWindow::showSweep() {
  const auto& data = session_->current().sweep;
  sweep_->setVisible(data != nullptr);
  point_->clear();
  charts_.at("point")->clear(charts_.at("point")->property("hint").toString());
  if (!data) return;
  sweep_->setSweep(data);
  picture_->setHint(QString::fromStdString(data->title),
                    "Choose a point of the diagram: its last frame is shown here.");
  docks_.at("point")->show();
  docks_.at("point")->raise();
  sweep_->diagram()->choose(0);
}

void MainWindow::choosePoint(int point) {
  if (!session_->current().sweep) return;
  point_->show(*session_->current().sweep, point);
  showSweepRun(point_->run());
}

/// What the table keeps of a run; read in a worker.
void MainWindow::showSweepRun(int run) {
  const auto sweep = session_->current().sweep;
  if (!sweep || run == 0) return;
  Document* document = now_;
  ++sweepReading_;
  pool_.start([this, document, sweep, run] {
    auto data = std::make_shared<SweepRunData>();
    QString fault;
    try {
      *data = readSweepRun(sweep->folder, run);
    } catch (const std::exception& e) {
      fault = QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(this, [this, document, sweep, run, data, fault] {
      --sweepReading_;
      if (document != now_ || session_->current().sweep != sweep || point_->run() != run) return;
      if (!fault.isEmpty()) return complain({fault});
      auto* chart = charts_.at("point");
      if (data->curves.empty())
        chart->clear("The table keeps no curves of this run.");
      else
        chart->setCurves(std::move(data->curves));
      now_->preview = data->last;
      now_->previewScene = data->scene;
      if (data->last) return requestPicture();
      now_->shown.reset();
      picture_->clear();
      picture_->setHint("No frame", "The table keeps none of this run; open it to compute it again.");
    });
  });
}

void MainWindow::openPoint(int point) {
  const auto sweep = session_->current().sweep;
  if (!sweep) return;
  int run = 0;
  for (const auto& row : sweep->rows)
    if (row.point == point && (run == 0 || row.run == point_->run())) run = row.run;
  newTab();
  statusBar()->showMessage(QString("Opening run %1 of the sweep ...").arg(run));
  session_->openSweepRun(sweep->folder, run);
}

void MainWindow::saveSweepTable(const QString& file) {
  const auto sweep = session_->current().sweep;
  pool_.start([this, sweep, file] {
    QString fault;
    try {
      writeAtomically(file.toStdString(), analysis::SweepTable(sweep->folder).csv());
    } catch (const std::exception& e) {
      fault = QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(this, [this, file, fault] {
      if (!fault.isEmpty()) return complain({fault});
      statusBar()->showMessage("Saved " + file);
    });
  });
}

} // namespace sandglass::desktop
