#pragma once
// The columns of another program's file, what each is taken for, and what the file does not say: units,
// radii, box, times, walls. Every change is tried at once on the first frame with grains; Save keeps it
// beside the file, where every command finds it.

#include "app/desktop/import_choices.h"

#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QThreadPool>
#include <QTimer>

namespace sandglass::desktop {

class ImportDialog : public QDialog {
  Q_OBJECT
public:
  /// `path` as it was opened (a file or a pattern); `reason`: why the dialog is there, may be empty.
  ImportDialog(const QString& path, const ForeignFacts& facts, const ImportSettings& settings,
               const QString& reason, QWidget* parent = nullptr);
  ~ImportDialog() override;

  bool isSettled() const { return !pause_.isActive() && tried_ == trial_; }
  bool isSound() const { return save_->isEnabled(); }
  QString verdict() const { return verdict_->text(); }

Q_SIGNALS:
  void saved(const QString& path, const QString& settingsFile);

private:
  QLineEdit* line(const char* name, const QString& text, const QString& hint, const QString& tip);
  QComboBox* unit(const char* name, const QString& now, const QStringList& offered, const QString& tip);
  void buildTable(const ImportChoices& choices);
  QFormLayout* buildUnits(const ImportChoices& choices);
  QFormLayout* buildSpace(const ImportChoices& choices);
  ImportChoices choices() const;
  void showMeanings(); ///< one column may take its quantity from another
  void later();        ///< tries the choices once nobody types
  void tryNow();
  void showTrial(const ImportTrial& trial);
  void complain(const QStringList& sentences);
  QString withoutFolder(QString text) const;
  void save();

  QString path_;
  ForeignFacts facts_;
  ImportSettings base_;
  std::map<std::string, std::string> meanings_; ///< those chosen
  QTableWidget* table_;
  std::vector<QComboBox*> quantities_; ///< a row each
  QComboBox *length_, *time_, *mass_, *periodic_, *shape_;
  QLineEdit *radius_, *radiusOf_, *lower_, *upper_, *timeStep_, *frameInterval_, *walls_;
  QLabel* why_ = nullptr; ///< the fault that opened the dialog
  QLabel* verdict_;
  QPushButton* save_;
  QTimer pause_;
  quint64 trial_ = 0, tried_ = 0; ///< numbers of trials
  QThreadPool pool_;
};

} // namespace sandglass::desktop
