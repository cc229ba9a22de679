// What the window shows of the frame: picture, analyses, curves, the picked grain.

#include "app/desktop/accuracy_panel.h"
#include "app/desktop/chart_panel.h"
#include "app/desktop/inspector_panel.h"
#include "app/desktop/main_window.h"
#include "app/desktop/picture_view.h"
#include "app/desktop/run_panel.h"
#include "app/desktop/scene_panel.h"
#include "app/desktop/state_panel.h"
#include "app/desktop/text_panels.h"
#include "app/desktop/undo_commands.h"
#include "app/desktop/view_panel.h"
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "vis/chart.h"
#include "vis/survey.h"

#include <QFileDialog>
#include <QSignalBlocker>
#include <QStatusBar>

#include <algorithm>
#include <cmath>

namespace sandglass::desktop {

namespace {

constexpr int grainsWhileMoving = 4000; ///< drawn while the camera moves
constexpr int viewChange = 2;           ///< id of undo commands
constexpr qint64 oneMove = 600;         ///< [ms] within which changes of the view are one step of undo

} // namespace

void MainWindow::requestPicture(bool interactive) {
  if (!session_->isOpen()) return;
  const auto& store = session_->current().store;
  PictureOrder order;
  order.interactive = interactive;
  const auto index = time_->chosen();
  if (index && store->size() > 0) {
    order.left.index = std::min(*index, store->size() - 1);
    order.left.source = store;
  } else if (session_->liveFrame()) {
    order.left.frame = session_->liveFrame();
  } else if (!(order.left.frame = now_->preview)) {
    return;
  }
  vis::View& view = now_->view;
  if (range_.known && view.colouring.range == vis::ColourRange::run) {
    view.colouring.low = range_.limits[0];
    view.colouring.high = range_.limits[1];
  }
  const QSize pixels = picture_->pixels();
  view.width = pixels.width();
  view.height = pixels.height();
  order.view = view;
  order.left.run = store;
  order.left.name = runName(*now_);
  if (now_->beside) order.right = besideOrder();
  if (interactive) order.view.maximumGrains = grainsWhileMoving;
  order.number = ++ordered_;
  drawing_->draw(std::move(order));
}

void MainWindow::onPicture() {
  auto picture = drawing_->takePicture();
  if (!picture) return;
  drawn_ = picture->number;
  if (!session_->isOpen()) return;
  const bool other = picture->frame != now_->shown;
  const bool otherBeside = picture->right != now_->shownBeside;
  now_->shown = picture->frame;
  now_->shownBeside = picture->right;
  picture_->show(std::move(*picture));
  if (otherBeside && now_->grainBeside) inspect();
  if (!other) return;
  const Frame& frame = *now_->shown;
  viewPanel_->setFrame(frame);
  offerColumns();
  run_->setFrame(frame);
  accuracy_->setFrame(frame);
  time_->setTime(QString("t = %1 s    %L2 grains").arg(frame.time, 0, 'f', 4).arg(frame.size()));
  if (!sincePictures_.isValid()) sincePictures_.start();
  ++picturesSince_;
  if (sincePictures_.elapsed() > 2000) {
    accuracy_->setPicturesPerSecond(1e3 * picturesSince_ / static_cast<double>(sincePictures_.elapsed()));
    picturesSince_ = 0;
    sincePictures_.restart();
  }
  commands_->action("file.savePicture")->setEnabled(true);
  const bool canBranch = !session_->current().runFolder.empty() && session_->current().scene;
  commands_->action("run.branch")->setEnabled(canBranch);
  run_->setCanBranch(canBranch);
  refreshPanels(std::exchange(outdated_, false));
}

void MainWindow::refreshPanels(bool restart) {
  if (now_->grain >= 0 && !now_->grainBeside) inspect();
  requestAnalyses(restart);
}

void MainWindow::requestAnalyses(bool restart) {
  if (!now_ || !now_->shown || now_->shown->size() < 2) return;
  const bool beside = session_->runs() && !session_->isPaused();
  for (const auto& analysis : panelAnalyses()) {
    auto* panel = charts_.at(QString::fromStdString(analysis.id));
    const QWidget* seen = analysis.id == "states" ? static_cast<QWidget*>(states_) : panel;
    if (!seen->isVisible() || seen->visibleRegion().isEmpty()) continue; // hidden, or behind another tab
    if (analysis.asksQuantity) panel->offerQuantities(grainScalarNames(*now_->shown));
    AnalysisInput input;
    input.frame = now_->shown;
    input.frames = session_->current().store;
    input.scene = session_->current().sweep ? now_->previewScene : session_->current().scene;
    input.quantity = panel->quantity().toStdString();
    input.knobs = panel->knobs().toStdString();
    analyses_->compute(analysis, std::move(input), restart, beside);
  }
}

void MainWindow::takeAnalyses() {
  for (auto& [id, outcome] : analyses_->take()) {
    auto* panel = charts_.at(id);
    panel->setPinName(curveName());
    if (id == "states" && outcome.results)
      states_->show(*outcome.results);
    else if (id == "states")
      states_->clear();
    if (outcome.results && !outcome.results->curves.empty())
      panel->setCurves(std::move(outcome.results->curves));
    else
      panel->clear(outcome.fault.isEmpty() ? "Nothing to draw." : outcome.fault);
  }
}

QString MainWindow::curveName() const {
  const QString name = QString::fromStdString(runName(*now_));
  return now_->shown ? QString("%1, %2 s").arg(name).arg(now_->shown->time, 0, 'g', 4) : name;
}

void MainWindow::refreshCurves() {
  if (!std::exchange(curvesOutdated_, false) || !session_->isOpen()) return;
  const Opened& current = session_->current();
  if (!current.scene) return;
  const auto show = [&](const char* id, std::optional<analysis::Curve> curve, const QString& hint) {
    auto* panel = charts_.at(id);
    panel->setPinName(QString::fromStdString(current.runFolder.filename().string()));
    if (curve)
      panel->setCurve(std::move(*curve));
    else
      panel->clear(hint);
  };
  const auto hint = [&](const char* what, const char* kind) {
    const auto& probes = current.scene->probes;
    const bool asked = std::any_of(probes.begin(), probes.end(),
                                   [&](const ProbeSpec& probe) { return probe.what.kind == kind; });
    return asked ? QString("%1: nothing yet. It is drawn as the scene runs.").arg(what)
                 : QString("%1 is not asked for: give the scene a [[probe]] with kind = \"%2\".")
                       .arg(what, kind);
  };
  show("energies", current.series.energies(*current.scene), hint("Energy", "energies"));
  show("flow", current.series.flowRate(*current.scene), hint("Flow rate", "flow_rate"));
}

bool MainWindow::isSettled() const {
  return !session_->isOpening() && drawn_ == ordered_ &&
         std::all_of(charts_.begin(), charts_.end(), [](const auto& c) { return c.second->isCurrent(); }) &&
         analyses_->isIdle() && scene_->isSettled() && inspector_->isSettled() && sweepReading_ == 0 &&
         surveys_ == 0;
}

void MainWindow::onPicked(qint64 grain, int half) {
  now_->grain = grain;
  now_->grainBeside = half == 1 && now_->beside && now_->shownBeside;
  if (!now_->shown || grain < 0) {
    inspector_->show(-1, nullptr, nullptr);
    return statusBar()->showMessage("No grain there.");
  }
  const Frame& frame = now_->grainBeside ? *now_->shownBeside : *now_->shown;
  const auto at = std::find(frame.id.begin(), frame.id.end(), grain);
  if (at == frame.id.end()) return;
  if (docks_.at("inspector")->toggleViewAction()->isChecked()) docks_.at("inspector")->raise();
  inspect();
  const auto k = static_cast<std::size_t>(at - frame.id.begin());
  const Vec3& x = frame.position[k];
  QString text = QString("Grain %1    at (%2, %3, %4) m").arg(grain).arg(x.x()).arg(x.y()).arg(x.z());
  for (const auto& [name, values] : frame.scalars)
    text += QString("    %1 %2 %3")
                .arg(QString::fromStdString(name))
                .arg(values[k])
                .arg(QString::fromStdString(unitOf(name)));
  for (const auto& [name, values] : frame.vectors)
    text += QString("    |%1| %2 %3")
                .arg(QString::fromStdString(name))
                .arg(values[k].norm())
                .arg(QString::fromStdString(unitOf(name)));
  statusBar()->showMessage(text);
}

void MainWindow::onPickedIn(const std::vector<std::int64_t>& grains) {
  if (!now_->shown) return;
  if (grains.empty()) return statusBar()->showMessage("No grain's centre is in the rectangle.");
  now_->view.selection.grains = grains;
  now_->view.selection.use = vis::Selection::Use::highlight;
  keepView("choose grains");
  viewPanel_->setView(now_->view);
  requestPicture();
  inspector_->showMany(grains, now_->shown);
  if (docks_.at("inspector")->toggleViewAction()->isChecked()) docks_.at("inspector")->raise();
  statusBar()->showMessage(
      QString("%L1 grains chosen; the others are pale. Esc chooses none.").arg(grains.size()));
}

void MainWindow::chooseNone() {
  if (now_->view.selection.grains.empty()) return;
  now_->view.selection.grains.clear();
  keepView("choose no grains");
  viewPanel_->setView(now_->view);
  requestPicture();
  inspect();
}

void MainWindow::keepView(const QString& what) {
  Document* document = now_;
  now_->undo.push(new ChangeCommand<vis::View>(
      viewChange, what, now_->kept, now_->view,
      [this, document](const vis::View& view) {
        document->view = document->kept = view;
        if (document == now_) applyView(view);
      },
      oneMove));
  now_->kept = now_->view;
}

void MainWindow::applyView(const vis::View& view) {
  picture_->forgetWheel();
  now_->view = view;
  viewPanel_->setView(view);
  const QSignalBlocker blocker(commands_->action("view.orthographic"));
  commands_->action("view.orthographic")->setChecked(view.camera.orthographic);
  scanRunRange();
  requestPicture();
}

void MainWindow::exportCurve(const analysis::Curve& curve, const QString& suffix) {
  const QString name = QString::fromStdString(curve.name.empty() ? "curve" : curve.name) + "." + suffix;
  const QString file = QFileDialog::getSaveFileName(this, "Save the curve", name,
                                                    QString("%1 (*.%2)").arg(suffix.toUpper(), suffix));
  if (file.isEmpty()) return;
  analysis::Curve whole = curve;
  const Opened& current = session_->current();
  whole.provenance["source"] =
      std::filesystem::absolute(current.runFolder.empty() ? current.path : current.runFolder).string();
  if (suffix == "png") return drawing_->saveChart(std::move(whole), file);
  try {
    writeAtomically(file.toStdString(), analysis::toCsv(whole));
    statusBar()->showMessage("Saved " + file);
    say(LogLevel::info, "The curve is saved in " + file + ".");
  } catch (const std::exception& e) {
    complain({QString::fromUtf8(e.what())});
  }
}

void MainWindow::scanRunRange() {
  const vis::View& view = now_->view;
  const std::string quantity = view.colouring.quantity;
  const auto store = session_->isOpen() ? session_->current().store : nullptr;
  if (view.colouring.range != vis::ColourRange::run || quantity.empty() || !store) return;
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
  const vis::View& view = now_->view;
  if (view.colouring.range != vis::ColourRange::run || view.colouring.quantity.empty()) return;
  scanRunRange(); // a run that has just begun has a store of its own
  try {
    for (const double value : grainScalar(frame, view.colouring.quantity)) {
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
