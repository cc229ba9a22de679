#include "app/desktop/import_dialog.h"

#include "app/desktop/background.h"
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/import/column_names.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSignalBlocker>
#include <QStyle>
#include <QVBoxLayout>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr int rest = 250; ///< [ms] without a key before choices are tried
constexpr int nice = 5;
const char* const asTheFileSays = "as the file says";

QString rangeOf(const ForeignColumn& column) {
  if (!column.words.empty()) {
    QStringList words;
    for (const auto& word : column.words)
      words << QString::fromStdString(word);
    return words.join(", ");
  }
  QString text = QString::number(column.smallest, 'g', 5);
  if (column.largest != column.smallest) text += " to " + QString::number(column.largest, 'g', 5);
  if (column.notFinite > 0) text += QString(", %L1 no numbers").arg(column.notFinite);
  return text;
}

/// Sentences of the command line end with the option that would help; here there are fields.
QString withoutOptions(QString text) {
  static const QRegularExpression advice("; (give|name it)[^;\n]*--[^;\n]*");
  return text.remove(advice);
}

void hold(QComboBox* box, const std::string& quantity) {
  const QString data = QString::fromStdString(quantity);
  if (box->findData(data) < 0) box->insertItem(1, quantityInWords(quantity), data);
  box->setCurrentIndex(box->findData(data));
}

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("heading", true);
  return label;
}

} // namespace

ImportDialog::ImportDialog(const QString& path, const ForeignFacts& facts, const ImportSettings& settings,
                           const QString& reason, QWidget* parent)
    : QDialog(parent), path_(path), facts_(facts), base_(settings) {
  setObjectName("importDialog");
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle("Columns of " + QFileInfo(path).fileName());
  resize(860, 700);
  pool_.setMaxThreadCount(1);
  const ImportChoices now = choicesOf(settings, facts);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(9);
  auto* about = new QLabel(QString("%1: %2 columns; frame %3 with %L4 grains.")
                               .arg(QString::fromStdString(facts.format))
                               .arg(facts.columns.size())
                               .arg(facts.frame)
                               .arg(facts.grains));
  column->addWidget(about);
  if (!reason.isEmpty()) {
    why_ = new QLabel(withoutOptions(withoutFolder(reason)));
    why_->setObjectName("importReason");
    why_->setProperty("fault", true);
    why_->setWordWrap(true);
    column->addWidget(why_);
  }
  buildTable(now);
  column->addWidget(table_, 1);
  auto* below = new QHBoxLayout;
  below->setSpacing(22);
  below->addLayout(buildUnits(now), 1);
  below->addLayout(buildSpace(now), 1);
  column->addLayout(below);
  verdict_ = new QLabel;
  verdict_->setObjectName("importVerdict");
  verdict_->setWordWrap(true);
  verdict_->setMinimumHeight(54);
  verdict_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  verdict_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(verdict_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  save_ = buttons->addButton("Save and open", QDialogButtonBox::AcceptRole);
  save_->setObjectName("importSave");
  save_->setToolTip("Writes " + QString::fromStdString(importFileFor(path.toStdString(), facts).string()));
  save_->setDefault(true);
  save_->setEnabled(false);
  connect(buttons, &QDialogButtonBox::accepted, this, &ImportDialog::save);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  pause_.setSingleShot(true);
  pause_.setInterval(rest);
  connect(&pause_, &QTimer::timeout, this, &ImportDialog::tryNow);
  showMeanings();
  tryNow();
}

ImportDialog::~ImportDialog() {
  pool_.waitForDone();
}

void ImportDialog::buildTable(const ImportChoices& choices) {
  meanings_ = choices.meanings;
  table_ = new QTableWidget(static_cast<int>(facts_.columns.size()), 3);
  table_->setObjectName("importColumns");
  table_->setHorizontalHeaderLabels({"Column of the file", "Values", "Taken for"});
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
  table_->horizontalHeader()->setSectionResizeMode(2, QHeaderView::Interactive);
  table_->setColumnWidth(2, 300);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setFocusPolicy(Qt::NoFocus); // the boxes in it have it
  for (std::size_t k = 0; k < facts_.columns.size(); ++k) {
    const int row = static_cast<int>(k);
    const ForeignColumn& column = facts_.columns[k];
    table_->setItem(row, 0, new QTableWidgetItem(QString::fromStdString(column.name)));
    table_->setItem(row, 1, new QTableWidgetItem(rangeOf(column)));
    auto* box = new QComboBox;
    box->setObjectName("meaning." + QString::fromStdString(column.name));
    box->setAccessibleName("What the column " + QString::fromStdString(column.name) + " is taken for");
    box->setFocusPolicy(Qt::StrongFocus);
    box->addItem(quantityInWords(""), QString());
    for (const auto& quantity : importQuantities())
      box->addItem(quantityInWords(quantity), QString::fromStdString(quantity));
    if (box->findData(QString::fromStdString(column.name)) < 0)
      box->addItem(quantityInWords(column.name), QString::fromStdString(column.name));
    connect(box, QOverload<int>::of(&QComboBox::activated), this, [this, box, name = column.name] {
      const std::string chosen = box->currentData().toString().toStdString();
      if (chosen == quantityOfColumn(name, {}))
        meanings_.erase(name);
      else
        meanings_[name] = chosen;
      showMeanings();
      later();
    });
    table_->setCellWidget(row, 2, box);
    quantities_.push_back(box);
  }
}

QLineEdit* ImportDialog::line(const char* name, const QString& text, const QString& hint,
                              const QString& tip) {
  auto* made = new QLineEdit(text);
  made->setObjectName(name);
  made->setPlaceholderText(hint);
  made->setToolTip(tip);
  made->setAccessibleName(tip);
  connect(made, &QLineEdit::textEdited, this, &ImportDialog::later);
  return made;
}

QComboBox* ImportDialog::unit(const char* name, const QString& now, const QStringList& offered,
                              const QString& tip) {
  auto* made = new QComboBox;
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setAccessibleName(tip);
  made->setEditable(true);
  made->addItems(offered);
  made->setCurrentText(now.isEmpty() ? offered.front() : now);
  connect(made, &QComboBox::currentTextChanged, this, &ImportDialog::later);
  return made;
}

QFormLayout* ImportDialog::buildUnits(const ImportChoices& now) {
  auto* form = new QFormLayout;
  form->setVerticalSpacing(6);
  form->setHorizontalSpacing(10);
  form->addRow(heading("Units of the numbers in the file"));
  form->addRow("Length",
               length_ = unit("importLength", now.length, {"m", "cm", "mm", "um"}, "Unit of lengths"));
  form->addRow("Time", time_ = unit("importTime", now.time, {"s", "ms", "us"}, "Unit of times"));
  form->addRow("Mass", mass_ = unit("importMass", now.mass, {"kg", "g", "mg"}, "Unit of masses"));
  form->addRow(heading("Times, where the file says none"));
  form->addRow("Of a step",
               timeStep_ = line("importTimeStep", now.timeStep, "such as 1e-5 s", "Time of a step"));
  form->addRow("Between frames", frameInterval_ = line("importInterval", now.frameInterval, "such as 1 ms",
                                                       "Time between two frames"));
  walls_ = line("importWalls", now.walls.join("; "), "STL, VTP or a scene; several with ;",
                "Files of walls that stand beside the grains");
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  auto* add = new QPushButton("Add...");
  add->setObjectName("importAddWall");
  add->setAutoDefault(false);
  connect(add, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, "Walls", QFileInfo(path_).path(),
                                                      "Walls (*.stl *.vtp *.toml);;All files (*)");
    if (file.isEmpty()) return;
    walls_->setText(walls_->text().isEmpty() ? file : walls_->text() + "; " + file);
    later();
  });
  row->addWidget(walls_, 1);
  row->addWidget(add);
  form->addRow("Walls", row);
  return form;
}

QFormLayout* ImportDialog::buildSpace(const ImportChoices& now) {
  auto* form = new QFormLayout;
  form->setVerticalSpacing(6);
  form->setHorizontalSpacing(10);
  form->addRow(heading("Sizes, where the file has none"));
  form->addRow("Radius",
               radius_ = line("importRadius", now.radius, "such as 1.5 mm", "Radius of all grains"));
  form->addRow("By species", radiusOf_ = line("importRadiusOf", now.radiusOf, "1 = 1 mm, 2 = 2 mm",
                                              "Radius of the grains of each species"));
  shape_ = new QComboBox;
  shape_->setObjectName("importShape");
  shape_->addItems({asTheFileSays, "semi-axes", "diameters"});
  shape_->setCurrentText(now.shape.isEmpty() ? asTheFileSays : now.shape);
  shape_->setToolTip("What shapex, shapey and shapez are");
  connect(shape_, QOverload<int>::of(&QComboBox::activated), this, &ImportDialog::later);
  const bool shaped = std::any_of(facts_.columns.begin(), facts_.columns.end(),
                                  [](const ForeignColumn& c) { return c.quantity.starts_with("shape"); });
  if (shaped)
    form->addRow("Shapes", shape_);
  else
    shape_->setParent(this), shape_->hide();
  form->addRow(heading("Box"));
  QString lower = "none in the file", upper = lower;
  if (facts_.box) {
    const auto corner = [](const Vec3& v) {
      return QString("%1, %2, %3 in the file").arg(v.x()).arg(v.y()).arg(v.z());
    };
    lower = corner(facts_.box->lower);
    upper = corner(facts_.box->upper);
  }
  form->addRow("Lower corner",
               lower_ = line("importLower", now.lower, lower, "Lower corner, such as 0, 0, -1 cm"));
  form->addRow("Upper corner",
               upper_ = line("importUpper", now.upper, upper, "Upper corner, such as 1 cm, 1 cm, 8 cm"));
  periodic_ = new QComboBox;
  periodic_->setObjectName("importPeriodic");
  periodic_->setToolTip("Directions in which the box repeats");
  periodic_->addItems({asTheFileSays, "none", "x", "y", "z", "xy", "xz", "yz", "xyz"});
  periodic_->setCurrentText(now.periodic.isEmpty() ? asTheFileSays : now.periodic);
  connect(periodic_, QOverload<int>::of(&QComboBox::activated), this, &ImportDialog::later);
  form->addRow("Repeats along", periodic_);
  return form;
}

ImportChoices ImportDialog::choices() const {
  const auto orFile = [](const QComboBox* box) {
    return box->currentText() == asTheFileSays ? QString() : box->currentText();
  };
  ImportChoices c;
  c.meanings = meanings_;
  c.length = length_->currentText();
  c.time = time_->currentText();
  c.mass = mass_->currentText();
  c.radius = radius_->text();
  c.radiusOf = radiusOf_->text();
  c.lower = lower_->text();
  c.upper = upper_->text();
  c.periodic = orFile(periodic_);
  c.timeStep = timeStep_->text();
  c.frameInterval = frameInterval_->text();
  c.shape = orFile(shape_);
  c.walls = walls_->text().split(';', Qt::SkipEmptyParts);
  return c;
}

void ImportDialog::showMeanings() {
  ImportSettings settings;
  for (const auto& [column, quantity] : meanings_)
    if (quantity.empty())
      settings.ignored.push_back(column);
    else
      settings.columns.try_emplace(quantity, column);
  for (std::size_t k = 0; k < quantities_.size(); ++k) {
    const QSignalBlocker blocker(quantities_[k]);
    const auto chosen = meanings_.find(facts_.columns[k].name);
    hold(quantities_[k],
         chosen != meanings_.end() ? chosen->second : quantityOfColumn(facts_.columns[k].name, settings));
  }
}

void ImportDialog::later() {
  save_->setEnabled(false);
  pause_.start();
}

void ImportDialog::tryNow() {
  const quint64 number = ++trial_;
  ImportSettings settings;
  try {
    settings = settingsOf(choices(), base_);
  } catch (const InputError& e) {
    tried_ = trial_;
    QStringList sentences;
    for (const auto& sentence : e.sentences())
      sentences << QString::fromStdString(sentence);
    return complain(sentences);
  }
  pool_.start([this, number, settings, facts = facts_] {
    lowerPriority(nice);
    ImportTrial trial;
    QStringList faults;
    try {
      trial = tryImport(facts, settings);
    } catch (const InputError& e) {
      for (const auto& sentence : e.sentences())
        faults << QString::fromStdString(sentence);
    } catch (const std::exception& e) {
      faults << QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(this, [this, number, trial, faults] {
      if (number != trial_) return;
      tried_ = number;
      if (faults.isEmpty())
        showTrial(trial);
      else
        complain(faults);
    });
  });
}

void ImportDialog::showTrial(const ImportTrial& trial) {
  QStringList lines{QString(QChar(0x2713)) + " " + trial.sentence};
  for (const auto& missing : trial.missing)
    lines << "Missing: " + missing + ".";
  for (const auto& granted : trial.granted)
    lines << "Taken for granted: " + withoutOptions(withoutFolder(granted)) + ".";
  if (why_) why_->hide(); // it no longer holds
  verdict_->setProperty("fault", false);
  style()->polish(verdict_);
  verdict_->setText(lines.join("\n"));
  save_->setEnabled(true);
}

/// The title of the dialog names the file; its folder would fill the line.
QString ImportDialog::withoutFolder(QString text) const {
  return text.replace(QString::fromStdString(facts_.file), QFileInfo(path_).fileName());
}

void ImportDialog::complain(const QStringList& sentences) {
  verdict_->setProperty("fault", true);
  style()->polish(verdict_);
  verdict_->setText(QString(QChar(0x2717)) + " " + withoutOptions(withoutFolder(sentences.join("\n"))));
  save_->setEnabled(false);
}

void ImportDialog::save() {
  if (!isSettled() || !isSound()) return;
  try {
    const auto file = importFileFor(path_.toStdString(), facts_);
    writeAtomically(file, writeImportSettings(settingsOf(choices(), base_)));
    Q_EMIT saved(path_, QString::fromStdString(file.string()));
    accept();
  } catch (const std::exception& e) {
    complain({QString::fromUtf8(e.what())});
  }
}

} // namespace sandglass::desktop
