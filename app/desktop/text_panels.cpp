#include "app/desktop/text_panels.h"

#include "sim/base/log.h"

#include <QFont>
#include <QHBoxLayout>
#include <QToolButton>

namespace sandglass::desktop {

namespace {

constexpr int longestLog = 5000; ///< lines
constexpr int longestBanner = 4; ///< sentences; all of them are in the log

QPlainTextEdit* codeView(const QString& hint) {
  auto* edit = new QPlainTextEdit;
  edit->setReadOnly(true);
  QFont font("DejaVu Sans Mono");
  font.setStyleHint(QFont::Monospace);
  font.setPointSizeF(8.5);
  edit->setFont(font);
  edit->setLineWrapMode(QPlainTextEdit::NoWrap);
  edit->setPlaceholderText(hint);
  return edit;
}

} // namespace

ScenePanel::ScenePanel(QWidget* parent) : QTabWidget(parent) {
  setObjectName("scene");
  setDocumentMode(true);
  addTab(written_ = codeView("No scene is open."), "As written");
  addTab(resolved_ = codeView("No scene is open."), "In SI units, complete");
}

void ScenePanel::setScene(const QString& written, const QString& resolved) {
  written_->setPlainText(written);
  resolved_->setPlainText(resolved);
}

LogPanel::LogPanel(QWidget* parent) : QPlainTextEdit(parent) {
  setObjectName("log");
  setReadOnly(true);
  setMaximumBlockCount(longestLog);
}

void LogPanel::add(int level, const QString& text) {
  const char* colour = level == static_cast<int>(LogLevel::error)     ? "#b42318"
                       : level == static_cast<int>(LogLevel::warning) ? "#9a6700"
                                                                      : "#3d444b";
  appendHtml(QString("<span style='color:%1'>%2</span>").arg(colour, text.toHtmlEscaped()));
}

Banner::Banner(QWidget* parent) : QFrame(parent), text_(new QLabel(this)) {
  setObjectName("banner");
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton(this);
  close->setText(QString(QChar(0x2715)));
  close->setAutoRaise(true);
  close->setToolTip("Close");
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 8, 8, 8);
  row->addWidget(text_, 1);
  row->addWidget(close, 0, Qt::AlignTop);
  hide();
}

void Banner::setSentences(const QStringList& sentences) {
  QStringList shown = sentences.mid(0, longestBanner);
  if (sentences.size() > longestBanner)
    shown << QString("... and %1 more: see the log.").arg(sentences.size() - longestBanner);
  text_->setText(shown.join("\n"));
  setVisible(!sentences.isEmpty());
}

} // namespace sandglass::desktop
