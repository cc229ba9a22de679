#pragma once
// The log, and the banner in which errors appear above the picture.

#include <QFrame>
#include <QLabel>
#include <QPlainTextEdit>

namespace sandglass::desktop {

class LogPanel : public QPlainTextEdit {
  Q_OBJECT
public:
  explicit LogPanel(QWidget* parent = nullptr);
  void add(int level, const QString& text); ///< level: of LogLevel
};

/// Sentences in a coloured strip; stays until it is closed or replaced, and never asks anything.
class Banner : public QFrame {
  Q_OBJECT
public:
  explicit Banner(QWidget* parent = nullptr);
  void setSentences(const QStringList& sentences);
  QString text() const { return text_->text(); }

private:
  QLabel* text_;
};

} // namespace sandglass::desktop
