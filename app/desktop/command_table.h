#pragma once
// Every action of the user is one row here; menus, tool bar, short cuts, tool tips and the cheat sheet are
// made from the rows.

#include <QAction>
#include <QKeySequence>
#include <QMenuBar>
#include <QString>
#include <QToolBar>

#include <functional>
#include <map>
#include <vector>

namespace sandglass::desktop {

struct Command {
  QString id;   ///< "run.start": names the action in the program and in tests
  QString menu; ///< title of its menu, "&Run"
  QString name; ///< as the menu shows it
  QList<QKeySequence> keys;
  QString toolTip; ///< one sentence
  QString icon;    ///< name of a drawing in style.h; empty: none
  bool inToolBar = false;
  bool checkable = false, checked = false;
  bool beginsGroup = false;          ///< a line above it
  std::function<void(bool)> perform; ///< the argument is the new state of a checkable one
};

class CommandTable {
public:
  /// Actions belong to `window`.
  CommandTable(QWidget* window, std::vector<Command> rows);

  QAction* action(const QString& id) const; ///< there must be one
  void refreshIcons() const;                ///< the theme has changed
  const std::vector<Command>& rows() const { return rows_; }

  void fill(QMenuBar* bar) const;
  void fill(QToolBar* bar) const;
  /// Rows with their keys as HTML, by menu; `gestures` (what, how) follow.
  QString cheatSheet(const std::vector<std::pair<QString, QString>>& gestures) const;

private:
  std::vector<Command> rows_;
  std::map<QString, QAction*> actions_;
};

} // namespace sandglass::desktop
