#include "app/desktop/sweep_panel.h"

#include "sim/base/error.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <set>

namespace sandglass::desktop {

namespace {

constexpr int lookInterval = 2000; ///< [ms] between looks at a table that grows
const char* const every = "all";

std::size_t columnOf(const QComboBox* box) {
  return static_cast<std::size_t>(box->currentData().toULongLong());
}

} // namespace

SweepPanel::SweepPanel(QWidget* parent) : QWidget(parent) {
  setObjectName("sweepPanel");
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::Base);
  pool_.setMaxThreadCount(1);
  const auto box = [&](const char* name, const char* text) {
    auto* made = new QComboBox(this);
    made->setObjectName(name);
    made->setAccessibleName(text);
    connect(made, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this] {
      offerHeld();
      redraw();
    });
    return made;
  };
  x_ = box("sweepX", "Column across");
  y_ = box("sweepY", "Column upwards");
  colour_ = box("sweepColour", "Column of the colour");
  auto* columns = new QHBoxLayout;
  for (const auto& [text, made] : {std::pair{"Across", x_}, {"Up", y_}, {"Colour", colour_}}) {
    columns->addWidget(new QLabel(text, this));
    columns->addWidget(made, 1);
  }
  form_ = new QFormLayout;
  critical_ = new QCheckBox("critical rotation", this);
  critical_->setObjectName("sweepCritical");
  critical_->setToolTip("The rotation at which the paraboloid of a close-packed bed touches the floor");
  disagreement_ = new QCheckBox("disagreement of seeds", this);
  disagreement_->setObjectName("sweepDisagreement");
  disagreement_->setToolTip("Pies where seeds end in different states, bars as long as numbers differ");
  critical_->setChecked(true);
  disagreement_->setChecked(true);
  open_ = new QPushButton("Open run", this);
  open_->setObjectName("sweepOpen");
  open_->setToolTip(
      "The run behind the chosen point in a new tab, computed again where its frames were not kept");
  open_->setEnabled(false);
  auto* csv = new QPushButton("CSV", this);
  csv->setObjectName("sweepCsv");
  csv->setToolTip("Save the table");
  auto* png = new QPushButton("PNG", this);
  png->setObjectName("sweepPng");
  png->setToolTip("Save the diagram");
  auto* marks = new QHBoxLayout;
  marks->addWidget(critical_);
  marks->addWidget(disagreement_);
  marks->addStretch(1);
  for (auto* button : {open_, csv, png})
    marks->addWidget(button);
  diagram_ = new PhaseDiagram(this);
  state_ = new QLabel(this);
  state_->setObjectName("sweepState");
  state_->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 8, 10, 8);
  column->addLayout(columns);
  column->addLayout(form_);
  column->addLayout(marks);
  column->addWidget(diagram_, 1);
  column->addWidget(state_);

  connect(critical_, &QCheckBox::toggled, diagram_, &PhaseDiagram::setCriticalShown);
  connect(disagreement_, &QCheckBox::toggled, diagram_, &PhaseDiagram::setDisagreementShown);
  connect(diagram_, &PhaseDiagram::pointChosen, this, [this] { open_->setEnabled(true); });
  connect(diagram_, &PhaseDiagram::pointOpened, this, &SweepPanel::openWanted);
  connect(open_, &QPushButton::clicked, this, [this] {
    if (diagram_->chosen() > 0) Q_EMIT openWanted(diagram_->chosen());
  });
  connect(csv, &QPushButton::clicked, this, &SweepPanel::csvWanted);
  connect(png, &QPushButton::clicked, this, &SweepPanel::pngWanted);
  look_.setInterval(lookInterval);
  connect(&look_, &QTimer::timeout, this, &SweepPanel::look);
}

SweepPanel::~SweepPanel() {
  pool_.waitForDone();
}

void SweepPanel::setSweep(std::shared_ptr<const SweepData> data) {
  const bool other =
      !data_ || !data || data_->folder != data->folder || data_->columns.size() != data->columns.size();
  data_ = std::move(data);
  if (other) {
    diagram_->choose(0);
    open_->setEnabled(false);
    offerColumns();
  }
  redraw();
  showState();
  if (data_ && data_->waiting > 0)
    look_.start();
  else
    look_.stop();
}

void SweepPanel::offerColumns() {
  const QSignalBlocker a(x_), b(y_), c(colour_);
  for (auto* box : {x_, y_, colour_})
    box->clear();
  if (!data_ || data_->columns.empty()) return;
  const auto fill = [this](QComboBox* box, const std::vector<std::size_t>& columns, std::size_t chosen) {
    for (const auto k : columns) {
      const auto& column = data_->columns[k];
      box->addItem(QString::fromStdString(column.name), static_cast<qulonglong>(k));
      box->setItemData(box->count() - 1, QString::fromStdString(column.description), Qt::ToolTipRole);
      if (k == chosen) box->setCurrentIndex(box->count() - 1);
    }
  };
  const SweepChoice first = firstChoice(*data_);
  fill(x_, columnsFor(*data_, false), first.x);
  fill(y_, columnsFor(*data_, false), first.y);
  fill(colour_, columnsFor(*data_, true), first.colour);
  offerHeld();
}

/// A box for each axis that the diagram does not show: all of it, or one value.
void SweepPanel::offerHeld() {
  if (!data_) return;
  const auto before = choice().only;
  while (form_->rowCount() > 0)
    form_->removeRow(0);
  held_.clear();
  for (std::size_t k = 0; k < data_->axes; ++k) {
    if (k == columnOf(x_) || k == columnOf(y_)) continue;
    std::vector<std::string> values;
    for (const auto& row : data_->rows)
      if (const auto text = cellText(*data_, row, k);
          std::find(values.begin(), values.end(), text) == values.end())
        values.push_back(text);
    auto* box = new QComboBox(this);
    box->setObjectName(QString("sweepHeld.%1").arg(QString::fromStdString(data_->columns[k].name)));
    box->addItem(every);
    for (const auto& value : values)
      box->addItem(QString::fromStdString(value));
    if (const auto was = before.find(k); was != before.end())
      box->setCurrentText(QString::fromStdString(was->second));
    connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &SweepPanel::redraw);
    form_->addRow(QString::fromStdString(data_->columns[k].name), box);
    held_[k] = box;
  }
}

SweepChoice SweepPanel::choice() const {
  SweepChoice choice{columnOf(x_), columnOf(y_), columnOf(colour_), {}};
  for (const auto& [column, box] : held_)
    if (box->currentIndex() > 0) choice.only[column] = box->currentText().toStdString();
  return choice;
}

void SweepPanel::redraw() {
  if (data_ && x_->count() > 0) diagram_->show(data_, choice());
}

void SweepPanel::showState() {
  if (!data_) return state_->clear();
  const std::size_t all = data_->rows.size();
  QString text = QString("%1: %L2 of %L3 runs done")
                     .arg(QString::fromStdString(data_->title))
                     .arg(all - data_->waiting - data_->failed)
                     .arg(all);
  if (data_->failed > 0) text += QString(", %L1 failed").arg(data_->failed);
  if (data_->waiting > 0)
    text +=
        QString("; sandglass sweep %1 goes on with it").arg(QString::fromStdString(data_->folder.string()));
  state_->setText(text);
}

void SweepPanel::look() {
  if (!data_ || !isVisible() || pool_.activeThreadCount() > 0) return;
  const auto before = data_;
  pool_.start([this, before] {
    std::shared_ptr<const SweepData> now;
    try {
      now = readSweepData(before->folder);
    } catch (const Error&) { // it is being written; the next look will tell
    }
    QMetaObject::invokeMethod(this, [this, before, now] {
      if (!now || data_ != before ||
          (now->waiting == before->waiting && now->rows.size() == before->rows.size()))
        return;
      setSweep(now);
      Q_EMIT refreshed(now);
    });
  });
}

} // namespace sandglass::desktop
