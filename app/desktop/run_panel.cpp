#include "app/desktop/run_panel.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include <algorithm>

namespace sandglass::desktop {

namespace {

struct Pace {
  const char* name;
  double ratio;
};
constexpr Pace paces[] = {{"as fast as it can", 0},
                          {"as the clock", 1},
                          {"10 times slower", 0.1},
                          {"100 times slower", 0.01},
                          {"1000 times slower", 1e-3}};

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("heading", true);
  return label;
}

QString describe(const EventSpec& event) {
  QStringList what;
  if (event.gravity)
    what << QString("gravity (%1, %2, %3) m/s²")
                .arg(event.gravity->x())
                .arg(event.gravity->y())
                .arg(event.gravity->z());
  if (event.drag) what << QString("drag %1 1/s").arg(*event.drag);
  for (const auto& wall : event.removeWalls)
    what << QString("wall %1 removed").arg(QString::fromStdString(wall));
  for (const auto& wall : event.paceWalls)
    what << QString("wall %1 at %2 times its pace")
                .arg(QString::fromStdString(wall))
                .arg(event.pace.value_or(1));
  for (const auto& [field, factor] : event.fields)
    what << QString("field %1 at %2 times its strength").arg(QString::fromStdString(field)).arg(factor);
  if (event.endStage) what << "stage ended";
  return QString("step %L1: %2").arg(static_cast<qlonglong>(event.step)).arg(what.join(", "));
}

} // namespace

RunPanel::RunPanel(QWidget* parent) : QWidget(parent) {
  setObjectName("runPanel");
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::Base);
  form_ = new QFormLayout(this);
  form_->setContentsMargins(12, 10, 12, 10);
  form_->setVerticalSpacing(7);
  form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  addStages();
  form_->addRow(heading("Change while it runs"));
  addGravityAndDrag();
  addWalls();
  addField();
  addEnds();
  setScene(std::nullopt);
  setProgress(std::nullopt, false);
  branch_->setEnabled(false);
}

void RunPanel::addStages() {
  form_->addRow(heading("Stages"));
  stages_ = new QListWidget(this);
  stages_->setObjectName("stages");
  stages_->setAccessibleName("Stages of the run");
  stages_->setFocusPolicy(Qt::TabFocus);
  stages_->setSelectionMode(QAbstractItemView::NoSelection);
  stages_->setMaximumHeight(92);
  form_->addRow(stages_);
  speed_ = new QComboBox(this);
  speed_->setObjectName("speedLimit");
  speed_->setToolTip("How fast simulated time may pass; the result is the same to the bit");
  for (const auto& pace : paces)
    speed_->addItem(pace.name);
  form_->addRow("Pace", speed_);
  connect(speed_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int k) { Q_EMIT speedLimitChosen(paces[k].ratio); });
}

void RunPanel::addGravityAndDrag() {
  auto* pull = new QHBoxLayout;
  for (std::size_t k = 0; k < 3; ++k) {
    auto* box = gravity_[k] = new QDoubleSpinBox(this);
    box->setObjectName(QString("gravity.%1").arg("xyz"[k]));
    box->setAccessibleName(QString("Gravity along %1, in metres per second squared").arg("xyz"[k]));
    box->setToolTip(QString("Gravity along %1 [m/s²]").arg("xyz"[k]));
    box->setDecimals(2);
    box->setRange(-1e6, 1e6);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setMinimumWidth(46);
    pull->addWidget(box, 1);
  }
  applyGravity_ = button("applyGravity", "Set", "Let grains fall so from the next step on");
  pull->addWidget(applyGravity_);
  form_->addRow("Gravity", pull);
  connect(applyGravity_, &QPushButton::clicked, this,
          [this] { Q_EMIT changeWanted({.gravity = gravity()}); });
  auto* slow = new QHBoxLayout;
  drag_ = new QDoubleSpinBox(this);
  drag_->setObjectName("drag");
  drag_->setRange(0, 1e9);
  drag_->setSuffix(" 1/s");
  drag_->setToolTip("Rate at which velocities and spins decay, until the next stage begins");
  applyDrag_ = button("applyDrag", "Set", "From the next step on, until the next stage begins");
  slow->addWidget(drag_, 1);
  slow->addWidget(applyDrag_);
  form_->addRow("Drag", slow);
  connect(applyDrag_, &QPushButton::clicked, this, [this] { Q_EMIT changeWanted({.drag = drag_->value()}); });
}

void RunPanel::addWalls() {
  auto* gate = new QHBoxLayout;
  walls_ = new QComboBox(this);
  walls_->setObjectName("wallToRemove");
  removeWall_ = button("removeWall", "Remove", "Take this wall or gate away before the next step");
  gate->addWidget(walls_, 1);
  gate->addWidget(removeWall_);
  form_->addRow("Wall", wall_ = gate);
  connect(removeWall_, &QPushButton::clicked, this,
          [this] { Q_EMIT changeWanted({.removeWalls = {walls_->currentText().toStdString()}}); });
  auto* move = new QHBoxLayout;
  movers_ = new QComboBox(this);
  movers_->setObjectName("wallToPace");
  movers_->setToolTip("A wall with a motion");
  wallPace_ =
      factor("wallPace", 0, 100, "Pace of its motion, as a multiple of what the scene says; 0 holds it");
  applyPace_ = button("applyPace", "Set", "From the next step on the motion goes at this pace");
  move->addWidget(movers_, 1);
  move->addWidget(wallPace_);
  move->addWidget(applyPace_);
  form_->addRow("Motion", motion_ = move);
  connect(applyPace_, &QPushButton::clicked, this, [this] {
    Q_EMIT changeWanted({.paceWalls = {movers_->currentText().toStdString()}, .pace = wallPace_->value()});
  });
}

void RunPanel::addField() {
  auto* blow = new QHBoxLayout;
  fields_ = new QComboBox(this);
  fields_->setObjectName("fieldToChange");
  fields_->setToolTip("A field of the scene: wind, vortex, gravity");
  fieldFactor_ =
      factor("fieldFactor", -1000, 1000, "Its strength, as a multiple of what the scene says; 0: off");
  applyField_ = button("applyField", "Set", "From the next step on the field has this strength");
  blow->addWidget(fields_, 1);
  blow->addWidget(fieldFactor_);
  blow->addWidget(applyField_);
  form_->addRow("Field", field_ = blow);
  connect(applyField_, &QPushButton::clicked, this, [this] {
    Q_EMIT changeWanted({.fields = {{fields_->currentText().toStdString(), fieldFactor_->value()}}});
  });
}

void RunPanel::addEnds() {
  auto* turn = new QHBoxLayout;
  endStage_ = button("endStage", "End stage", "The next stage begins after the next step");
  branch_ = button("branch", "Branch here", "What if: a new run that shares the past up to the frame shown");
  turn->addWidget(endStage_);
  turn->addWidget(branch_);
  form_->addRow(turn);
  connect(endStage_, &QPushButton::clicked, this, [this] { Q_EMIT changeWanted({.endStage = true}); });
  connect(branch_, &QPushButton::clicked, this, &RunPanel::branchWanted);
  events_ = new QLabel(this);
  events_->setObjectName("events");
  events_->setWordWrap(true);
  events_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  form_->addRow(events_);
}

QDoubleSpinBox* RunPanel::factor(const char* name, double low, double high, const QString& tip) {
  auto* box = new QDoubleSpinBox(this);
  box->setObjectName(name);
  box->setRange(low, high);
  box->setValue(1);
  box->setSingleStep(0.25);
  box->setPrefix(QString(QChar(0x00D7)) + " ");
  box->setToolTip(tip);
  return box;
}

QPushButton* RunPanel::button(const char* name, const QString& text, const QString& tip) {
  auto* made = new QPushButton(text, this);
  made->setObjectName(name);
  made->setToolTip(tip);
  return made;
}

Vec3 RunPanel::gravity() const {
  return {gravity_[0]->value(), gravity_[1]->value(), gravity_[2]->value()};
}

void RunPanel::setScene(const std::optional<Scene>& scene) {
  const bool first = !scene_ || !scene || scene_->file != scene->file;
  scene_ = scene;
  if (first) stage_.clear();
  if (scene_) {
    Vec3 now = scene_->gravity;
    for (const auto& event : scene_->events)
      if (event.gravity) now = *event.gravity;
    for (std::size_t k = 0; k < 3; ++k)
      gravity_[k]->setValue(now[static_cast<Eigen::Index>(k)]);
    QStringList names;
    for (const auto& wall : scene_->walls)
      names << QString::fromStdString(wall.name);
    walls_->clear();
    walls_->addItems(names);
    QStringList moving, offered;
    for (const auto& wall : scene_->walls)
      if (!wall.motion.kind.empty()) moving << QString::fromStdString(wall.name);
    for (int k = 0; k < movers_->count(); ++k)
      offered << movers_->itemText(k);
    QStringList blowing, known;
    for (const auto& field : scene_->fields)
      blowing << QString::fromStdString(field.name);
    for (int k = 0; k < fields_->count(); ++k)
      known << fields_->itemText(k);
    if (blowing != known) {
      fields_->clear();
      fields_->addItems(blowing);
      fieldFactor_->setValue(1);
    }
    if (moving != offered) {
      movers_->clear();
      movers_->addItems(moving);
      wallPace_->setValue(1);
    }
  }
  showRow(wall_, scene_ && !scene_->walls.empty());
  showRow(motion_, scene_ && movers_->count() > 0);
  showRow(field_, scene_ && fields_->count() > 0);
  showStages();
  showEvents();
}

void RunPanel::showRow(QLayout* row, bool shown) {
  if (auto* label = form_->labelForField(row)) label->setVisible(shown);
  for (int k = 0; k < row->count(); ++k)
    if (QWidget* widget = row->itemAt(k)->widget()) widget->setVisible(shown);
}

void RunPanel::setFrame(const Frame& frame) {
  QStringList there, now;
  for (const auto& wall : frame.walls)
    if (wall.active) there << QString::fromStdString(wall.name);
  for (int k = 0; k < walls_->count(); ++k)
    now << walls_->itemText(k);
  if (there != now) {
    const QString chosen = walls_->currentText();
    walls_->clear();
    walls_->addItems(there);
    walls_->setCurrentIndex(std::max(0, walls_->findText(chosen)));
    removeWall_->setEnabled(runs_ && walls_->count() > 0);
  }
  if (!runs_ && !frame.stage.empty() && frame.stage != stage_) {
    stage_ = frame.stage;
    showStages();
  }
}

void RunPanel::setProgress(const std::optional<Progress>& progress, bool runs) {
  const bool complete = progress && progress->fraction >= 1;
  for (QWidget* w : {static_cast<QWidget*>(applyGravity_), static_cast<QWidget*>(applyDrag_),
                     static_cast<QWidget*>(endStage_), static_cast<QWidget*>(removeWall_)})
    w->setEnabled(runs && (w != removeWall_ || walls_->count() > 0));
  applyPace_->setEnabled(runs && movers_->count() > 0);
  applyField_->setEnabled(runs && fields_->count() > 0);
  const std::string stage = progress ? progress->stage : stage_;
  if (stage == stage_ && runs == runs_ && complete == complete_) return;
  stage_ = stage;
  runs_ = runs;
  complete_ = complete;
  showStages();
}

void RunPanel::setSpeedLimit(double ratio) {
  for (int k = 0; k < speed_->count(); ++k)
    if (paces[k].ratio == ratio) speed_->setCurrentIndex(k);
}

void RunPanel::showStages() {
  stages_->clear();
  if (!scene_) return;
  bool before = std::any_of(scene_->stages.begin(), scene_->stages.end(),
                            [&](const StageSpec& s) { return s.name == stage_; });
  for (const auto& stage : scene_->stages) {
    const bool current = stage.name == stage_;
    const QString mark = complete_ || (before && !current) ? QString(QChar(0x2713))
                         : current                         ? QString(QChar(0x25B6))
                                                           : QString(QChar(0x00B7));
    auto* item = new QListWidgetItem(mark + "  " + QString::fromStdString(stage.name), stages_);
    if (current) {
      before = false;
      QFont bold = item->font();
      bold.setBold(!complete_);
      item->setFont(bold);
    }
  }
}

void RunPanel::showEvents() {
  QStringList lines;
  if (scene_)
    for (const auto& event : scene_->events)
      lines << describe(event);
  events_->setText(lines.join("\n"));
  events_->setVisible(!lines.isEmpty());
}

} // namespace sandglass::desktop
