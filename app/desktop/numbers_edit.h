#pragma once
// A line for a few numbers, "1 cm, 0, 2 mm"; what is wrong with it stands below as a sentence while it is
// typed.

#include <QLabel>
#include <QLineEdit>
#include <QString>
#include <QWidget>

#include <vector>

namespace sandglass::desktop {

class NumbersEdit : public QWidget {
  Q_OBJECT
public:
  /// `count` numbers in `unit` ("m": lengths, with any unit of length or plain metres; "": plain numbers).
  /// `mayBeEmpty`: nothing at all is sound too. The line has the object name `name`.
  NumbersEdit(const char* name, int count, const QString& unit, const QString& tip, bool mayBeEmpty = false);

  const std::vector<double>& values() const { return values_; } ///< the last sound ones
  bool isSound() const { return fault_->text().isEmpty(); }
  void setValues(const std::vector<double>& values); ///< does not emit changed(); keeps equal text as it is
  /// A sentence for numbers that are sound in themselves and break a rule; empty: they keep it.
  void breakRule(const QString& sentence);

Q_SIGNALS:
  void edited(); ///< by hand, and the numbers are sound

private:
  void read();
  void setFault(const QString& sentence);
  QString textOf(double value) const;

  int count_;
  QString unit_;
  bool mayBeEmpty_;
  QLineEdit* line_;
  QLabel* fault_;
  std::vector<double> values_;
  bool breaksRule_ = false;
};

} // namespace sandglass::desktop
