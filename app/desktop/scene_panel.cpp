#include "app/desktop/scene_panel.h"

#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <QComboBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QLineEdit>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QStyle>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace sandglass::desktop {

namespace {

constexpr int restBeforeCheck = 250; ///< [ms] without a key

QPlainTextEdit* codeView(const char* name, const QString& hint) {
  auto* edit = new QPlainTextEdit;
  edit->setObjectName(name);
  edit->setUndoRedoEnabled(false); // the window's undo covers it
  QFont font("DejaVu Sans Mono");
  font.setStyleHint(QFont::Monospace);
  font.setPointSizeF(8.5);
  edit->setFont(font);
  edit->setLineWrapMode(QPlainTextEdit::NoWrap);
  edit->setPlaceholderText(hint);
  return edit;
}

QString tipOf(const ParameterSpec& spec) {
  QString tip = QString::fromStdString(spec.description);
  const std::string unit = spec.unit.empty() ? "1" : spec.unit;
  if (spec.type == ParameterType::number || spec.type == ParameterType::vector ||
      spec.type == ParameterType::numbers) {
    if (unit != "1") tip += QString("; %1").arg(QString::fromStdString(quantityExample(unit)));
    if (std::abs(spec.minimum) < 1e15)
      tip += QString(spec.openMinimum ? "; above %1" : "; from %1")
                 .arg(QString::fromStdString(quantityText(spec.minimum, unit)));
    if (std::abs(spec.maximum) < 1e15)
      tip += QString(" to %1").arg(QString::fromStdString(quantityText(spec.maximum, unit)));
  }
  if (!spec.optional && !spec.fallback) tip += "; must be given";
  return tip;
}

QString labelOf(const SceneField& field) {
  return QString::fromStdString(field.spec.name).replace('_', ' ');
}

} // namespace

ScenePanel::ScenePanel(QWidget* parent) : QWidget(parent) {
  setObjectName("scene");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  tabs_ = new QTabWidget(this);
  tabs_->setObjectName("sceneTabs");
  tabs_->setDocumentMode(true);
  auto* formPage = new QWidget;
  auto* formColumn = new QVBoxLayout(formPage);
  formColumn->setContentsMargins(0, 0, 0, 0);
  formColumn->setSpacing(0);
  all_ = new QCheckBox("also keys that are not given");
  all_->setObjectName("allKeys");
  all_->setContentsMargins(8, 4, 8, 4);
  scroll_ = new QScrollArea;
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  formColumn->addWidget(all_);
  formColumn->addWidget(scroll_, 1);
  tabs_->addTab(formPage, "Form");
  tabs_->addTab(written_ = codeView("sceneText", "No scene is open."), "Text");
  tabs_->addTab(resolved_ = codeView("sceneResolved", "No scene is open."), "In SI units");
  resolved_->setReadOnly(true);
  state_ = new QLabel(this);
  state_->setObjectName("sceneState");
  state_->setWordWrap(true);
  state_->setMargin(6);
  locked_ = new QLabel(this);
  locked_->setWordWrap(true);
  locked_->setMargin(6);
  locked_->hide();
  column->addWidget(locked_);
  column->addWidget(tabs_, 1);
  column->addWidget(state_);

  pause_.setSingleShot(true);
  pause_.setInterval(restBeforeCheck);
  connect(&pause_, &QTimer::timeout, this, [this] { checker_.check(text_, file_, preview_); });
  connect(&checker_, &SceneChecker::ready, this, &ScenePanel::takeOutcome);
  connect(all_, &QCheckBox::toggled, this, [this] {
    shape_.clear();
    showForm();
  });
  connect(written_, &QPlainTextEdit::textChanged, this, [this] {
    if (!writing_) edit(written_->toPlainText(), "text");
  });
}

void ScenePanel::setScene(const QString& text, const QString& file, bool preview) {
  file_ = file;
  preview_ = preview;
  faults_.clear();
  shape_.clear();
  resolved_->clear();
  scroll_->verticalScrollBar()->setValue(0);
  setText(text);
}

void ScenePanel::setEditable(bool on, const QString& reason) {
  locked_->setText(reason);
  locked_->setVisible(!on && !reason.isEmpty());
  if (std::exchange(editable_, on) == on) return;
  written_->setReadOnly(!on);
  for (auto& [path, row] : rows_)
    row.editor->setEnabled(on);
}

void ScenePanel::setText(const QString& text) {
  text_ = text;
  if (written_->toPlainText() != text) {
    writing_ = true;
    const int cursor = written_->textCursor().position(), at = written_->verticalScrollBar()->value();
    written_->setPlainText(text);
    QTextCursor place = written_->textCursor();
    place.setPosition(std::min(cursor, static_cast<int>(text.size())));
    written_->setTextCursor(place);
    written_->verticalScrollBar()->setValue(at);
    writing_ = false;
  }
  showForm();
  all_->setVisible(!text.isEmpty());
  if (text.isEmpty())
    state_->setText("No scene: open one, or a run. Files of frames alone cannot be run.");
  else
    pause_.start();
}

void ScenePanel::edit(const QString& after, const QString& what) {
  if (after == text_) return;
  const QString before = text_;
  preview_ = true;
  setText(after);
  Q_EMIT edited(before, after, what);
}

const SceneField* ScenePanel::find(const std::string& path) const {
  for (const auto& table : tables_)
    for (const auto& field : table.fields)
      if (field.path == path) return &field;
  return nullptr;
}

void ScenePanel::changeField(const std::string& path, const QString& shown) {
  const SceneField* field = find(path);
  if (!field || !editable_) return;
  const std::string toml = tomlValue(shown.toStdString(), field->spec);
  if (toml == field->text) return;
  edit(QString::fromStdString(withValue(text_.toStdString(), *field, toml)), QString::fromStdString(path));
}

void ScenePanel::changeKind(const std::string& path, const QString& kind) {
  if (!editable_) return;
  try {
    edit(QString::fromStdString(withKind(text_.toStdString(), path, kind.toStdString())),
         QString::fromStdString(path));
  } catch (const InputError&) {
    // The text is no TOML now; the check says so.
  }
}

QWidget* ScenePanel::editorFor(const SceneField& field) {
  const QString shown = QString::fromStdString(field.given ? shownValue(field.text, field.spec) : "");
  const std::string path = field.path;
  QWidget* editor = nullptr;
  const bool boolean = field.spec.type == ParameterType::boolean;
  if (boolean || (field.spec.type == ParameterType::text && !field.spec.choices.empty())) {
    auto* combo = new QComboBox;
    if (!field.selects) combo->addItem("");
    if (boolean) combo->addItems({"true", "false"});
    for (const auto& choice : field.spec.choices)
      combo->addItem(QString::fromStdString(choice));
    combo->setCurrentIndex(combo->findText(shown));
    combo->setFocusPolicy(Qt::StrongFocus);
    connect(combo, QOverload<int>::of(&QComboBox::activated), this,
            [this, path, combo, selects = field.selects] {
              if (selects)
                changeKind(path, combo->currentText());
              else
                changeField(path, combo->currentText());
            });
    editor = combo;
  } else {
    auto* line = new QLineEdit(shown);
    line->setCursorPosition(0); // the beginning of a long value is what tells
    if (field.spec.fallback && !field.given) line->setPlaceholderText("left out: the default");
    connect(line, &QLineEdit::textEdited, this,
            [this, path](const QString& text) { changeField(path, text); });
    editor = line;
  }
  editor->setObjectName("field." + QString::fromStdString(path));
  editor->setAccessibleName(QString::fromStdString(path));
  editor->setToolTip(tipOf(field.spec));
  editor->setEnabled(editable_);
  editor->setMinimumWidth(90);
  return editor;
}

QWidget* ScenePanel::tableWidget(const SceneTable& table) {
  auto* box = new QGroupBox(QString::fromStdString(table.title));
  box->setToolTip(QString::fromStdString(table.description));
  auto* form = new QFormLayout(box);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->setVerticalSpacing(4);
  for (const auto& field : table.fields) {
    const bool due = !field.spec.optional && !field.spec.fallback;
    if (!field.given && !due && !all_->isChecked()) continue;
    if (field.text.starts_with("\"\"\"")) continue; // several lines: in the text
    Row row{field, editorFor(field), new QLabel};
    row.fault->setProperty("fault", true);
    row.fault->setWordWrap(true);
    row.fault->hide();
    auto* cell = new QVBoxLayout;
    cell->setSpacing(1);
    cell->addWidget(row.editor);
    cell->addWidget(row.fault);
    auto* label = new QLabel(labelOf(field) + (due && !field.given ? " *" : ""));
    label->setToolTip(tipOf(field.spec));
    label->setBuddy(row.editor);
    form->addRow(label, cell);
    rows_[field.path] = row;
  }
  if (form->rowCount() == 0) {
    delete box;
    return nullptr;
  }
  return box;
}

void ScenePanel::showForm() {
  try {
    tables_ = outlineScene(text_.toStdString());
  } catch (const InputError&) {
    return; // the form stays as it was until the text is TOML again; the check tells the line
  }
  std::string shape;
  for (const auto& table : tables_)
    for (const auto& field : table.fields)
      shape += field.path + (field.given ? "+;" : "-;");
  if (text_.isEmpty()) tables_.clear();
  if (shape == shape_ && !rows_.empty()) { // the same keys: only values may differ
    for (const auto& table : tables_)
      for (const auto& field : table.fields) {
        const auto row = rows_.find(field.path);
        if (row == rows_.end()) continue;
        const QString shown = QString::fromStdString(field.given ? shownValue(field.text, field.spec) : "");
        if (auto* line = qobject_cast<QLineEdit*>(row->second.editor)) {
          if (!line->hasFocus() && line->text() != shown) {
            line->setText(shown);
            line->setCursorPosition(0);
          }
        } else if (auto* combo = qobject_cast<QComboBox*>(row->second.editor)) {
          combo->setCurrentIndex(combo->findText(shown));
        }
      }
    return;
  }
  // A key that was just typed appears in the form: whoever types there must not lose the place.
  const auto* focus = qobject_cast<QWidget*>(focusWidget());
  const QString focused = focus && focus->objectName().startsWith("field.") ? focus->objectName() : QString();
  const auto* typing = qobject_cast<const QLineEdit*>(focus);
  const QString typed = typing ? typing->text() : QString();
  const int cursor = typing ? typing->cursorPosition() : 0;
  shape_ = shape;
  rows_.clear();
  const int at = scroll_->verticalScrollBar()->value();
  auto* page = new QWidget;
  page->setObjectName("sceneForm");
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(8, 4, 8, 8);
  for (const auto& table : tables_)
    if (auto* widget = tableWidget(table)) column->addWidget(widget);
  column->addStretch(1);
  if (QWidget* before = scroll_->takeWidget()) before->deleteLater(); // a key may be on its way through it
  scroll_->setWidget(page);
  scroll_->verticalScrollBar()->setValue(at);
  if (auto* again = focused.isEmpty() ? nullptr : page->findChild<QWidget*>(focused)) {
    again->setFocus();
    if (auto* line = qobject_cast<QLineEdit*>(again); line && typing) {
      const QSignalBlocker blocker(line);
      line->setText(typed);
      line->setCursorPosition(cursor);
    }
  }
  showFaults();
}

void ScenePanel::takeOutcome() {
  auto outcome = checker_.take();
  if (!outcome || outcome->text != text_) return;
  faults_ = outcome->faults;
  if (outcome->scene) resolved_->setPlainText(outcome->resolved);
  showFaults();
  Q_EMIT checked(*outcome);
}

void ScenePanel::showFaults() {
  for (auto& [path, row] : rows_) {
    row.fault->hide();
    row.fault->clear();
  }
  QStringList elsewhere;
  for (const auto& sentence : faults_) {
    const auto row = rows_.find(pathOfFault(sentence.toStdString(), tables_));
    if (row == rows_.end()) {
      elsewhere << sentence;
      continue;
    }
    QString text = row->second.fault->text();
    const int key = sentence.indexOf(QString::fromStdString(": " + row->first));
    text += (text.isEmpty() ? "" : "\n") + sentence.mid(key + 2);
    row->second.fault->setText(text);
    row->second.fault->show();
  }
  state_->setProperty("fault", !faults_.isEmpty());
  if (text_.isEmpty())
    state_->clear();
  else if (faults_.isEmpty())
    state_->setText(QString(QChar(0x2713)) + " The scene is sound.");
  else
    state_->setText(
        QString("%1 %2 in the scene%3")
            .arg(faults_.size())
            .arg(faults_.size() == 1 ? "fault" : "faults")
            .arg(elsewhere.isEmpty() ? "; see the fields." : ":\n" + elsewhere.mid(0, 4).join("\n")));
  state_->style()->unpolish(state_); // the sheet looks at the property
  state_->style()->polish(state_);
}

} // namespace sandglass::desktop
