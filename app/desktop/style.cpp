#include "app/desktop/style.h"

#include <QFontDatabase>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QProxyStyle>
#include <QStyleFactory>
#include <QStyleOption>

#include <functional>
#include <map>
#include <utility>

namespace sandglass::desktop {

namespace {

const QColor accent(31, 111, 120), sand(214, 160, 72);

constexpr double textSize = 9.5, headingSize = 15; ///< [pt]

/// What the sheet's @names stand for.
struct Colours {
  QString window, paper, raised, line, hover, pressed, pressedLine, title, accent, fault, faultPaper,
      faultLine, ink, faint, trough;
};

const Colours lightColours{"#f3f4f2", "#ffffff", "#ffffff", "#dfe2de", "#eaf2f2",
                           "#d5e7e8", "#b4d0d2", "#e9ebe8", "#1f6f78", "#b42318",
                           "#fdecea", "#f3b8b1", "#343a40", "#adb2b8", "#e4e7e4"};
const Colours darkColours{"#24272b", "#2b2f34", "#2f343a", "#43494f", "#38434a",
                          "#2f545a", "#4c7f86", "#33383e", "#6bc0c9", "#ffa79e",
                          "#4a2522", "#7d3b35", "#e3e6e8", "#767d84", "#43494f"};

Ink currentInk{QColor(52, 58, 64),  QColor(173, 178, 184), Qt::white,
               QColor(180, 35, 24), QColor(154, 103, 0),   1};

const char* const sheet = R"(
QWidget { font-size: @textpt; }
QMainWindow, QDialog { background: @window; }
QMainWindow::separator { background: @line; width: 5px; height: 5px; }
QToolBar { background: @raised; border: none; border-bottom: 1px solid @line; padding: 4px 8px; spacing: 3px; }
QToolBar QToolButton { padding: 5px 9px; border-radius: 5px; border: 1px solid transparent; }
QToolBar QToolButton:hover { background: @hover; }
QToolBar QToolButton:pressed, QToolBar QToolButton:checked { background: @pressed; border-color: @pressedLine; }
QMenuBar { background: @raised; padding: 2px 6px; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; }
QMenuBar::item:selected { background: @hover; }
QStatusBar { background: @raised; border-top: 1px solid @line; }
QStatusBar::item { border: none; }
QDockWidget { font-weight: 600; }
QDockWidget::title { background: @title; padding: 6px 10px; text-align: left; }
QDockWidget > QWidget { background: @paper; }
QLabel[heading="true"] { font-weight: 600; color: @accent; padding-top: 4px; }
QLabel[pageTitle="true"] { font-weight: 600; font-size: @headingpt; color: @ink; padding-top: 6px; }
QLabel[fault="true"] { color: @fault; }
#startPageContent, #sceneForm { background: @paper; }
QToolButton[card="true"] { background: @paper; border: 1px solid @line; border-radius: 8px; padding: 8px; }
QToolButton[card="true"]:hover, QToolButton[card="true"]:focus { border: 2px solid @accent; padding: 7px; }
QPushButton[link="true"] { color: @accent; border: none; text-align: left; padding: 2px 0; }
QPushButton[link="true"]:focus, QPushButton[link="true"]:hover { text-decoration: underline; }
QGroupBox { font-weight: 600; border: 1px solid @line; border-radius: 5px; margin-top: 9px; padding-top: 5px; }
QGroupBox::title { subcontrol-origin: margin; left: 9px; padding: 0 4px; color: @accent; }
#chartBar { background: @paper; }
#chartBar QToolButton { border: none; padding: 2px 3px; border-radius: 4px; }
#chartBar QToolButton:hover, #chartBar QToolButton:focus { background: @hover; }
#chartBar QToolButton:checked { background: @pressed; font-weight: 600; }
#banner { background: @faultPaper; border: none; border-bottom: 1px solid @faultLine; }
#banner QLabel { color: @fault; }
#timeBar { background: @raised; border-top: 1px solid @line; }
QProgressBar { background: @trough; border: none; border-radius: 3px; }
QProgressBar::chunk { background: @accent; border-radius: 3px; }
QToolButton#live { padding: 3px 10px; border: 1px solid @line; border-radius: 4px; background: @paper; }
QToolButton#live:checked { background: #1f6f78; color: #ffffff; border-color: #1f6f78; }
QPlainTextEdit, QTreeWidget { border: none; background: @paper; }
)";

QString sheetWith(const Colours& c, double textScale) {
  QString text = sheet;
  // The font of the application does not reach widgets that the sheet has styled.
  text.replace("@text", QString::number(textSize * textScale, 'f', 2));
  text.replace("@heading", QString::number(headingSize * textScale, 'f', 2));
  // Longer names first: one may begin another.
  const std::pair<const char*, const QString*> names[] = {{"@pressedLine", &c.pressedLine},
                                                          {"@faultPaper", &c.faultPaper},
                                                          {"@faultLine", &c.faultLine},
                                                          {"@pressed", &c.pressed},
                                                          {"@window", &c.window},
                                                          {"@raised", &c.raised},
                                                          {"@accent", &c.accent},
                                                          {"@trough", &c.trough},
                                                          {"@paper", &c.paper},
                                                          {"@hover", &c.hover},
                                                          {"@title", &c.title},
                                                          {"@fault", &c.fault},
                                                          {"@faint", &c.faint},
                                                          {"@line", &c.line},
                                                          {"@ink", &c.ink}};
  for (const auto& [name, value] : names)
    text.replace(name, *value);
  return text;
}

/// Fusion outlines check boxes darker than the window, which is nothing on a dark one.
class Outlined : public QProxyStyle {
public:
  Outlined() : QProxyStyle(QStyleFactory::create("Fusion")) {}
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    if (element != PE_IndicatorCheckBox && element != PE_IndicatorItemViewItemCheck) return;
    painter->save();
    painter->setPen(currentInk.faint);
    painter->setBrush(Qt::NoBrush);
    painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
    painter->restore();
  }
};

using Draw = std::function<void(QPainter&)>;

/// On a field of 24 by 24.
QIcon drawn(const Draw& draw) {
  QIcon result;
  for (const int size : {16, 20, 24, 32, 48})
    for (const bool enabled : {true, false}) {
      QPixmap pixmap(size, size);
      pixmap.fill(Qt::transparent);
      QPainter painter(&pixmap);
      painter.setRenderHint(QPainter::Antialiasing);
      painter.scale(size / 24.0, size / 24.0);
      if (!enabled) painter.setOpacity(0.3);
      draw(painter);
      painter.end();
      result.addPixmap(pixmap, enabled ? QIcon::Normal : QIcon::Disabled);
    }
  return result;
}

Draw filled(const QColor& colour, const std::vector<QPolygonF>& shapes) {
  return [=](QPainter& p) {
    p.setPen(QPen(colour, 1.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    p.setBrush(colour);
    for (const auto& shape : shapes)
      p.drawPolygon(shape);
  };
}

Draw lines(const QColor& colour, const std::vector<QPolygonF>& shapes) {
  return [=](QPainter& p) {
    p.setPen(QPen(colour, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    for (const auto& shape : shapes)
      p.drawPolyline(shape);
  };
}

QPolygonF polygon(std::initializer_list<QPointF> points) {
  return QPolygonF(QVector<QPointF>(points));
}

QPolygonF box(double x, double y, double width, double height) {
  return polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
}

/// An hourglass.
void drawApp(QPainter& p) {
  const QPolygonF upper = polygon({{5, 3}, {19, 3}, {12.6, 12}, {11.4, 12}}),
                  lower = polygon({{11.4, 12}, {12.6, 12}, {19, 21}, {5, 21}});
  p.setPen(QPen(accent, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  p.setBrush(QColor(231, 242, 243));
  p.drawPolygon(upper);
  p.drawPolygon(lower);
  p.setPen(Qt::NoPen);
  p.setBrush(sand);
  p.drawPolygon(polygon({{8.4, 7}, {15.6, 7}, {12, 12}}));
  p.drawPolygon(polygon({{12, 15.5}, {17, 20.2}, {7, 20.2}}));
}

std::map<QString, Draw> drawings() {
  const QColor ink = currentInk.text;
  return {
      {"open", lines(ink, {polygon({{3, 19}, {3, 5}, {9, 5}, {11, 8}, {19, 8}, {19, 11}}),
                           polygon({{3, 19}, {6.5, 11}, {22, 11}, {18.5, 19}, {3, 19}})})},
      {"run", filled(QColor(38, 132, 86), {polygon({{7, 4.5}, {19, 12}, {7, 19.5}})})},
      {"pause", filled(ink, {box(6.5, 5, 3.4, 14), box(14, 5, 3.4, 14)})},
      {"step", filled(ink, {polygon({{5, 5}, {14.5, 12}, {5, 19}}), box(17, 5, 1.8, 14)})},
      {"stop", filled(QColor(176, 58, 46), {box(6, 6, 12, 12)})},
      {"fit", lines(ink, {polygon({{4, 9}, {4, 4}, {9, 4}}), polygon({{15, 4}, {20, 4}, {20, 9}}),
                          polygon({{20, 15}, {20, 20}, {15, 20}}), polygon({{9, 20}, {4, 20}, {4, 15}})})},
      {"save", lines(ink, {polygon({{12, 4}, {12, 14.5}}), polygon({{7.5, 10.5}, {12, 15}, {16.5, 10.5}}),
                           polygon({{4, 16}, {4, 20}, {20, 20}, {20, 16}})})},
      {"back", lines(ink, {polygon({{15, 5}, {8, 12}, {15, 19}})})},
      {"forward", lines(ink, {polygon({{9, 5}, {16, 12}, {9, 19}})})},
      {"help",
       [ink](QPainter& p) {
         QFont font = p.font();
         font.setPixelSize(17);
         font.setBold(true);
         p.setFont(font);
         p.setPen(ink);
         p.drawText(QRectF(0, 0, 24, 24), Qt::AlignCenter, "?");
       }},
      {"app", drawApp},
  };
}

} // namespace

QIcon icon(const QString& name) {
  return drawn(drawings().at(name));
}

const Ink& ink() {
  return currentInk;
}

void setStyle(QApplication& app, Theme theme, double textScale) {
  const bool dark = theme == Theme::dark;
  const Colours& c = dark ? darkColours : lightColours;
  currentInk = {c.ink,    c.faint, c.paper, c.fault, dark ? QColor(240, 190, 90) : QColor(154, 103, 0),
                textScale};
  // Each of these calls goes through all widgets: only what changes is set.
  static bool fusion = false;
  if (!std::exchange(fusion, true)) QApplication::setStyle(new Outlined);
  QPalette palette;
  palette.setColor(QPalette::Window, c.window);
  palette.setColor(QPalette::Base, c.paper);
  palette.setColor(QPalette::AlternateBase, c.window);
  palette.setColor(QPalette::Button, dark ? c.raised : QString("#fafaf9"));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(role, c.ink);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, c.faint);
  palette.setColor(QPalette::PlaceholderText, c.faint);
  palette.setColor(QPalette::Highlight, accent);
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::ToolTipBase, c.paper);
  palette.setColor(QPalette::ToolTipText, c.ink);
  if (QApplication::palette() != palette) QApplication::setPalette(palette);
  QFont font = QFontDatabase::systemFont(QFontDatabase::GeneralFont);
  font.setPointSizeF(textSize * textScale);
  QApplication::setFont(font);
  if (const QString text = sheetWith(c, textScale); app.styleSheet() != text) app.setStyleSheet(text);
  QApplication::setWindowIcon(icon("app"));
}

} // namespace sandglass::desktop
