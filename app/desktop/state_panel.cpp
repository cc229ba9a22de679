#include "app/desktop/state_panel.h"

#include "analysis/vortex/vortex_rules.h"

#include <QHeaderView>
#include <QTabWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace sandglass::desktop {

namespace {

constexpr int columns = 5; ///< names, and the widest table's numbers

/// A number as somebody wants to read it: codes of states and answers of rules in words.
QString cell(const analysis::Table& table, std::size_t column, double value) {
  if (!std::isfinite(value)) return "";
  const std::string& name = table.columns[column].name;
  if (table.name == "vortex_states" && name == "state")
    return analysis::nameOf(static_cast<analysis::VortexState>(std::lround(value)));
  if (name == "holds") return value > 0 ? QString(QChar(0x2713)) + " yes" : QString("no");
  return QString::number(value, 'g', 4);
}

QString heading(const analysis::Axis& axis) {
  const QString name = QString::fromStdString(axis.name);
  return axis.unit.empty() ? name : name + " [" + QString::fromStdString(axis.unit) + "]";
}

} // namespace

StatePanel::StatePanel(const QString& hint, QWidget* parent)
    : QWidget(parent), sentence_(new QLabel(this)), evidence_(new QTreeWidget(this)),
      chart_(new ChartPanel("states", hint, this)) {
  setObjectName("statePanel");
  sentence_->setObjectName("stateSentence");
  sentence_->setWordWrap(true);
  sentence_->setMargin(6);
  sentence_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  evidence_->setObjectName("evidence");
  evidence_->setAccessibleName("Evidence for the state, and thresholds");
  evidence_->setColumnCount(columns);
  evidence_->setHeaderHidden(true);
  evidence_->setRootIsDecorated(true);
  evidence_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  auto* pages = new QTabWidget(this);
  pages->setObjectName("statePages");
  pages->addTab(evidence_, "Evidence");
  pages->addTab(chart_, "Curves");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(sentence_);
  column->addWidget(pages, 1);
  clear();
}

void StatePanel::clear() {
  sentence_->hide();
  evidence_->clear();
}

void StatePanel::show(const analysis::Results& results) {
  QStringList sentences;
  for (const auto& sentence : results.sentences)
    sentences << QString::fromStdString(sentence);
  sentence_->setText(sentences.join("\n"));
  sentence_->setVisible(!sentences.isEmpty());
  QStringList closed; // as somebody left it
  for (int k = 0; k < evidence_->topLevelItemCount(); ++k)
    if (!evidence_->topLevelItem(k)->isExpanded()) closed << evidence_->topLevelItem(k)->text(0);
  evidence_->clear();
  for (const auto& table : results.tables)
    addTable(table);
  for (int k = 0; k < evidence_->topLevelItemCount(); ++k) {
    auto* item = evidence_->topLevelItem(k);
    item->setExpanded(!closed.contains(item->text(0)));
  }
}

void StatePanel::addTable(const analysis::Table& table) {
  QStringList head{QString::fromStdString(table.title)};
  for (const auto& axis : table.columns)
    head << heading(axis);
  auto* top = new QTreeWidgetItem(evidence_, head);
  QFont bold = top->font(0);
  bold.setBold(true);
  for (int k = 0; k < head.size(); ++k)
    top->setFont(k, bold);
  top->setToolTip(0, QString::fromStdString(table.definition));
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    QStringList row{r < table.rowNames.size() ? QString::fromStdString(table.rowNames[r])
                                              : QString::number(r)};
    for (std::size_t k = 0; k < table.rows[r].size(); ++k)
      row << cell(table, k, table.rows[r][k]);
    auto* item = new QTreeWidgetItem(top, row);
    item->setToolTip(0, QString::fromStdString(table.definition));
  }
}

} // namespace sandglass::desktop
