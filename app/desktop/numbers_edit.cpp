#include "app/desktop/numbers_edit.h"

#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <QVBoxLayout>

#include <cmath>

namespace sandglass::desktop {

NumbersEdit::NumbersEdit(const char* name, int count, const QString& unit, const QString& tip,
                         bool mayBeEmpty)
    : count_(count), unit_(unit), mayBeEmpty_(mayBeEmpty), line_(new QLineEdit(this)),
      fault_(new QLabel(this)) {
  line_->setObjectName(name);
  line_->setToolTip(tip);
  line_->setAccessibleName(tip);
  if (mayBeEmpty) line_->setPlaceholderText(tip);
  fault_->setProperty("fault", true);
  fault_->setObjectName(QString(name) + ".fault");
  fault_->setWordWrap(true);
  fault_->hide();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(line_);
  column->addWidget(fault_);
  connect(line_, &QLineEdit::textEdited, this, [this] {
    read();
    if (isSound()) Q_EMIT edited();
  });
}

void NumbersEdit::read() {
  setFault({});
  const QString text = line_->text().trimmed();
  if (mayBeEmpty_ && text.isEmpty()) return values_.clear();
  const QStringList parts = text.split(',');
  if (parts.size() != count_)
    return setFault(count_ == 1 ? "one number is due"
                                : QString("%1 numbers with commas are due").arg(count_));
  std::vector<double> values;
  for (const QString& part : parts) {
    bool plain = false;
    double value = part.trimmed().toDouble(&plain);
    if (!plain && !unit_.isEmpty()) {
      try {
        value = parseQuantity(part.trimmed().toStdString(), unit_.toStdString());
        plain = true;
      } catch (const InputError&) { // the sentence below
      }
    }
    if (!plain || !std::isfinite(value))
      return setFault(QString("\"%1\" is no %2")
                          .arg(part.trimmed(), unit_.isEmpty() ? "number" : "length, such as \"2 mm\""));
    values.push_back(value);
  }
  values_ = std::move(values);
}

void NumbersEdit::breakRule(const QString& sentence) {
  if (!isSound() && !breaksRule_) return; // what is wrong with the text comes first
  setFault(sentence);
  breaksRule_ = !sentence.isEmpty();
}

void NumbersEdit::setFault(const QString& sentence) {
  breaksRule_ = false;
  fault_->setText(sentence);
  fault_->setVisible(!sentence.isEmpty());
}

QString NumbersEdit::textOf(double value) const {
  if (unit_ != "m" || value == 0) return QString::number(value, 'g', 6);
  return QString::number(1e3 * value, 'g', 6) + " mm";
}

void NumbersEdit::setValues(const std::vector<double>& values) {
  if (values == values_ && isSound()) return; // somebody may be typing
  values_ = values;
  QStringList texts;
  for (const double value : values)
    texts << textOf(value);
  line_->setText(texts.join(", "));
  setFault({});
}

} // namespace sandglass::desktop
