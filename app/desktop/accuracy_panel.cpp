#include "app/desktop/accuracy_panel.h"

#include "app/desktop/time_bar.h"

#include <QHeaderView>

#include <algorithm>
#include <chrono>
#include <cstdlib>

namespace sandglass::desktop {

namespace {

constexpr double longEnough = 0.8; ///< [s wall] between two values of the ratio

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

AccuracyPanel::AccuracyPanel(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("accuracy");
  setHeaderLabels({"Speed and accuracy", ""});
  header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  setSelectionMode(QAbstractItemView::NoSelection);
  auto* knobs = new QTreeWidgetItem(this, {"Knobs of the scene"});
  level_ = row(knobs, "level", "fills in the knobs that the scene leaves out");
  contact_ = row(knobs, "steps in a contact", "more: more accurate collisions, slower");
  step_ = row(knobs, "time step", "what the run takes");
  stiffness_ = row(knobs, "stiffness scale", "softer: longer steps, deeper overlaps");
  arithmetic_ =
      row(knobs, "precision and arithmetic",
          "mixed: pairs in single precision; fast: roots and quotients to two units in the last place");
  skin_ = row(knobs, "list skin", "share of the mean diameter; speed alone");
  limit_ = row(knobs, "overlap allowed", "share of the smaller radius at which the run stops");
  auto* measured = new QTreeWidgetItem(this, {"Measured"});
  speed_ = row(measured, "speed", "grains times steps in a second");
  ratio_ = row(measured, "simulated a second", "simulated time in a second of wall time");
  left_ = row(measured, "time left", "an estimate");
  overlap_ =
      row(measured, "deepest overlap", "of the frame shown, over the diameter; needs contacts in the frames");
  pictures_ = row(measured, "pictures", "new ones in a second");
  expandAll();
}

QTreeWidgetItem* AccuracyPanel::row(QTreeWidgetItem* group, const QString& name, const QString& tip) {
  auto* item = new QTreeWidgetItem(group, {name, QString(QChar(0x2013))});
  item->setToolTip(0, tip);
  item->setToolTip(1, tip);
  return item;
}

void AccuracyPanel::setScene(const std::optional<Scene>& scene) {
  lastTime_ = -1;
  for (auto* item : {speed_, ratio_, left_, overlap_, pictures_, step_})
    item->setText(1, QChar(0x2013));
  if (!scene) return;
  const AccuracySpec& a = scene->accuracy;
  level_->setText(1, QString::fromStdString(a.level));
  contact_->setText(1, QString::number(a.stepsPerContact));
  if (a.timeStep) step_->setText(1, QString("%1 s, fixed by the scene").arg(*a.timeStep));
  stiffness_->setText(1, QString::number(a.stiffnessScale));
  arithmetic_->setText(1, QString("%1, %2").arg(a.mixedPrecision ? "mixed" : "double",
                                                a.fastArithmetic ? "fast" : "portable"));
  skin_->setText(1, QString::number(a.skin));
  limit_->setText(1, QString::number(a.maximumOverlap));
}

void AccuracyPanel::setProgress(const Progress& p) {
  speed_->setText(1, QString("%1 million grain-steps/s").arg(p.grainStepsPerSecond / 1e6, 0, 'f', 2));
  left_->setText(1, p.secondsLeft >= 0 ? durationText(p.secondsLeft) : QString(QChar(0x2013)));
  const double now = wallSeconds();
  if (lastTime_ >= 0 && p.time >= lastTime_ && now - lastWall_ < longEnough) return;
  if (lastTime_ >= 0 && p.time >= lastTime_)
    ratio_->setText(1, QString("%1 s").arg((p.time - lastTime_) / (now - lastWall_), 0, 'g', 3));
  lastTime_ = p.time;
  lastWall_ = now;
}

void AccuracyPanel::setFrame(const Frame& frame) {
  if (const auto step = frame.provenance.find("step_size"); step != frame.provenance.end())
    step_->setText(1, QString("%1 s").arg(std::strtod(step->second.c_str(), nullptr), 0, 'g', 4));
  if (frame.contacts.empty() || !frame.scalars.contains(quantity::radius))
    return overlap_->setText(1, QChar(0x2013));
  const auto& radius = frame.scalars.at(quantity::radius);
  double deepest = 0;
  for (const auto& contact : frame.contacts)
    deepest = std::max(deepest, contact.overlap);
  const double diameter = 2 * *std::max_element(radius.begin(), radius.end());
  overlap_->setText(1, QString("%1 %").arg(100 * deepest / diameter, 0, 'g', 3));
}

void AccuracyPanel::setPicturesPerSecond(double rate) {
  pictures_->setText(1, QString("%1 a second").arg(rate, 0, 'f', 1));
}

} // namespace sandglass::desktop
