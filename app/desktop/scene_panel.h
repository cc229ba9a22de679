#pragma once
// The scene as a form and as text. Both edit the same text; after a short rest it is checked, faults stand as
// sentences at their fields, and a sound scene goes out.

#include "app/desktop/scene_checker.h"
#include "app/desktop/scene_outline.h"

#include <QCheckBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QTabWidget>
#include <QTimer>
#include <QWidget>

#include <map>

namespace sandglass::desktop {

class ScenePanel : public QWidget {
  Q_OBJECT
public:
  explicit ScenePanel(QWidget* parent = nullptr);

  /// Shows another scene and checks it; `file` is for messages and for what the scene names. Empty: none.
  /// `preview`: prepare what it looks like even before somebody edits it.
  void setScene(const QString& text, const QString& file, bool preview);
  void setEditable(bool on, const QString& reason); ///< a scene that runs cannot be edited
  void setText(const QString& text);                ///< as if somebody had typed it; for undo
  QString text() const { return text_; }
  bool isSettled() const { return !pause_.isActive() && checker_.isIdle(); }
  const QStringList& faults() const { return faults_; }

Q_SIGNALS:
  void edited(const QString& before, const QString& after, const QString& what); ///< by the user
  void checked(const SceneChecker::Outcome& outcome); ///< sound or not; of the newest text

private:
  /// What the form shows for one key.
  struct Row {
    SceneField field;
    QWidget* editor = nullptr;
    QLabel* fault = nullptr;
  };
  void edit(const QString& after, const QString& what);
  void changeField(const std::string& path, const QString& shown);
  void changeKind(const std::string& path, const QString& kind);
  void showForm();
  QWidget* tableWidget(const SceneTable& table);
  QWidget* editorFor(const SceneField& field);
  void showFaults();
  void takeOutcome();
  const SceneField* find(const std::string& path) const;

  QString text_, file_;
  std::vector<SceneTable> tables_;
  std::map<std::string, Row> rows_;
  QStringList faults_;
  SceneChecker checker_;
  QTimer pause_;
  bool editable_ = true, writing_ = false, preview_ = true;
  std::string shape_; ///< paths of the form shown: it is built anew when they change

  QTabWidget* tabs_;
  QScrollArea* scroll_;
  QCheckBox* all_;
  QPlainTextEdit *written_, *resolved_;
  QLabel *state_, *locked_;
};

} // namespace sandglass::desktop
