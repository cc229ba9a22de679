#include "app/desktop/text_panels.h"

#include "app/desktop/style.h"
#include "sim/base/log.h"

#include <QHBoxLayout>
#include <QToolButton>

namespace sandglass::desktop {

namespace {

constexpr int longestLog = 5000; ///< lines
constexpr int longestBanner = 4; ///< sentences; all of them are in the log

} // namespace

LogPanel::LogPanel(QWidget* parent) : QPlainTextEdit(parent) {
  setObjectName("log");
  setReadOnly(true);
  setMaximumBlockCount(longestLog);
}

void LogPanel::add(int level, const QString& text) {
  const bool error = level == static_cast<int>(LogLevel::error);
  const bool warning = level == static_cast<int>(LogLevel::warning);
  const QColor colour = error ? ink().error : warning ? ink().warning : ink().text;
  const QString mark = error ? "error: " : warning ? "warning: " : ""; // nothing by colour alone
  appendHtml(QString("<span style='color:%1'>%2</span>").arg(colour.name(), (mark + text).toHtmlEscaped()));
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
