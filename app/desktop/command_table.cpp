#include "app/desktop/command_table.h"

#include "app/desktop/style.h"

#include <QMenu>

namespace sandglass::desktop {

namespace {

constexpr int mostLines = 34; ///< of a column of the cheat sheet: as many as a small screen is high

QString keysOf(const Command& row) {
  QStringList keys;
  for (const auto& key : row.keys)
    keys << key.toString(QKeySequence::NativeText);
  return keys.join(" or ");
}

QString plain(QString name) {
  return name.remove('&').remove("...");
}

QString line(const QString& what, const QString& how) {
  return QString(
             "<tr><td style='padding:2px 22px 2px 0'>%1</td><td style='padding:2px 0'><b>%2</b></td></tr>")
      .arg(what.toHtmlEscaped(), how.toHtmlEscaped());
}

} // namespace

CommandTable::CommandTable(QWidget* window, std::vector<Command> rows) : rows_(std::move(rows)) {
  for (const auto& row : rows_) {
    auto* action = new QAction(row.name, window);
    if (!row.icon.isEmpty()) action->setIcon(icon(row.icon));
    action->setObjectName(row.id);
    action->setShortcuts(row.keys);
    action->setCheckable(row.checkable);
    action->setChecked(row.checked);
    const QString keys = keysOf(row);
    action->setToolTip(keys.isEmpty() ? row.toolTip : QString("%1 (%2)").arg(row.toolTip, keys));
    action->setStatusTip(row.toolTip);
    QObject::connect(action, &QAction::triggered, window, row.perform);
    window->addAction(action);
    actions_[row.id] = action;
  }
}

QAction* CommandTable::action(const QString& id) const {
  return actions_.at(id);
}

void CommandTable::refreshIcons() const {
  for (const auto& row : rows_)
    if (!row.icon.isEmpty()) actions_.at(row.id)->setIcon(icon(row.icon));
}

void CommandTable::fill(QMenuBar* bar) const {
  std::map<QString, QMenu*> menus;
  for (const auto& row : rows_) {
    QMenu*& menu = menus[row.menu];
    if (!menu) {
      menu = bar->addMenu(row.menu);
      menu->setToolTipsVisible(true);
    }
    if (row.beginsGroup) menu->addSeparator();
    menu->addAction(actions_.at(row.id));
  }
}

void CommandTable::fill(QToolBar* bar) const {
  QString menu;
  for (const auto& row : rows_) {
    if (!row.inToolBar) continue;
    if (!menu.isEmpty() && menu != row.menu) bar->addSeparator();
    menu = row.menu;
    bar->addAction(actions_.at(row.id));
  }
}

QString CommandTable::cheatSheet(const std::vector<std::pair<QString, QString>>& gestures) const {
  QStringList titles, blocks;
  for (const auto& row : rows_) {
    if (row.keys.isEmpty()) continue;
    if (!titles.contains(row.menu)) {
      titles << row.menu;
      blocks << QString();
    }
    blocks[titles.indexOf(row.menu)] += line(plain(row.name), keysOf(row));
  }
  titles << "Mouse";
  blocks << QString();
  for (const auto& [what, how] : gestures)
    blocks.last() += line(what, how);

  const QString column = "<td style='padding-right:30px'>";
  QString html = "<table><tr>" + column;
  int lines = 0;
  for (int k = 0; k < titles.size(); ++k) {
    const int more = blocks[k].count("<tr>") + 2;
    if (lines > 0 && lines + more > mostLines) {
      html += "</td>" + column;
      lines = 0;
    }
    lines += more;
    html += QString("<h3>%1</h3><table>%2</table>").arg(plain(titles[k]).toHtmlEscaped(), blocks[k]);
  }
  return html + "</td></tr></table>";
}

} // namespace sandglass::desktop
