#include "app/desktop/point_panel.h"

#include <QHeaderView>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>

namespace sandglass::desktop {

PointPanel::PointPanel(const QString& hint, QWidget* parent)
    : QWidget(parent), seed_(new QComboBox(this)), values_(new QTreeWidget(this)),
      chart_(new ChartPanel("point", hint, this)) {
  setObjectName("pointPanel");
  seed_->setObjectName("pointSeed");
  seed_->setAccessibleName("Seed whose run is shown");
  values_->setObjectName("pointValues");
  values_->setAccessibleName("Parameters and results of the point");
  values_->setRootIsDecorated(false);
  auto* split = new QSplitter(Qt::Vertical, this);
  split->addWidget(values_);
  split->addWidget(chart_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(seed_);
  column->addWidget(split, 1);
  connect(seed_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this](int k) {
    if (k >= 0) Q_EMIT runChosen(run());
  });
  clear();
}

int PointPanel::run() const {
  return seed_->currentIndex() < 0 ? 0 : seed_->currentData().toInt();
}

void PointPanel::clear() {
  const QSignalBlocker blocker(seed_);
  seed_->clear();
  seed_->hide();
  values_->clear();
  values_->hide();
}

void PointPanel::show(const SweepData& data, int point) {
  clear();
  std::vector<const analysis::SweepRow*> rows;
  for (const auto& row : data.rows)
    if (row.point == point) rows.push_back(&row);
  if (rows.empty()) return;
  QStringList head{QString("point %1").arg(point)};
  {
    const QSignalBlocker blocker(seed_);
    for (const auto* row : rows) {
      const QString name = QString("seed %1").arg(row->seed);
      head << name;
      const char* status = row->status == analysis::SweepStatus::failed    ? " (failed)"
                           : row->status == analysis::SweepStatus::waiting ? " (not run yet)"
                                                                           : "";
      seed_->addItem(name + status, row->run);
    }
    seed_->setVisible(true);
  }
  head << "unit";
  values_->setColumnCount(head.size());
  values_->setHeaderLabels(head);
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    QStringList line{QString::fromStdString(data.columns[k].name)};
    for (const auto* row : rows)
      line << QString::fromStdString(cellText(data, *row, k));
    line << (data.columns[k].unit == "1" ? QString() : QString::fromStdString(data.columns[k].unit));
    auto* item = new QTreeWidgetItem(values_, line);
    item->setToolTip(0, QString::fromStdString(data.columns[k].description));
  }
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!rows[k]->fault.empty()) {
      auto* item = new QTreeWidgetItem(values_, {"fault"});
      item->setText(static_cast<int>(k) + 1, QString::fromStdString(rows[k]->fault));
      item->setToolTip(static_cast<int>(k) + 1, QString::fromStdString(rows[k]->fault));
    }
  for (int k = 0; k < head.size(); ++k)
    values_->resizeColumnToContents(k);
  values_->setVisible(true);
}

} // namespace sandglass::desktop
