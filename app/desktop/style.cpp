#include "app/desktop/style.h"

#include <QFontDatabase>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QStyleFactory>

#include <functional>
#include <map>

namespace sandglass::desktop {

namespace {

const QColor ink(52, 58, 64), faint(173, 178, 184), accent(31, 111, 120), sand(214, 160, 72);

const char* const sheet = R"(
QMainWindow, QDialog { background: #f3f4f2; }
QMainWindow::separator { background: #e1e3e0; width: 5px; height: 5px; }
QToolBar { background: #ffffff; border: none; border-bottom: 1px solid #dfe2de; padding: 4px 8px; spacing: 3px; }
QToolBar QToolButton { padding: 5px 9px; border-radius: 5px; border: 1px solid transparent; }
QToolBar QToolButton:hover { background: #eaf2f2; }
QToolBar QToolButton:pressed, QToolBar QToolButton:checked { background: #d5e7e8; border-color: #b4d0d2; }
QMenuBar { background: #ffffff; padding: 2px 6px; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; }
QMenuBar::item:selected { background: #eaf2f2; }
QStatusBar { background: #ffffff; border-top: 1px solid #dfe2de; }
QStatusBar::item { border: none; }
QDockWidget { font-weight: 600; }
QDockWidget::title { background: #e9ebe8; padding: 6px 10px; text-align: left; }
QDockWidget > QWidget { background: #ffffff; }
QLabel[heading="true"] { font-weight: 600; color: #1f6f78; padding-top: 4px; }
#banner { background: #fdecea; border: none; border-bottom: 1px solid #f3b8b1; }
#banner QLabel { color: #8a1c12; }
#timeBar { background: #ffffff; border-top: 1px solid #dfe2de; }
QProgressBar { background: #e4e7e4; border: none; border-radius: 3px; }
QProgressBar::chunk { background: #1f6f78; border-radius: 3px; }
QToolButton#live { padding: 3px 10px; border: 1px solid #c9cdc9; border-radius: 4px; background: #ffffff; }
QToolButton#live:checked { background: #1f6f78; color: #ffffff; border-color: #1f6f78; }
QPlainTextEdit { border: none; background: #ffffff; }
)";

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

const std::map<QString, Draw>& drawings() {
  static const std::map<QString, Draw> all{
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
       [](QPainter& p) {
         QFont font = p.font();
         font.setPixelSize(17);
         font.setBold(true);
         p.setFont(font);
         p.setPen(ink);
         p.drawText(QRectF(0, 0, 24, 24), Qt::AlignCenter, "?");
       }},
      {"app", drawApp},
  };
  return all;
}

} // namespace

QIcon icon(const QString& name) {
  return drawn(drawings().at(name));
}

void setStyle(QApplication& app) {
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  palette.setColor(QPalette::Window, QColor(243, 244, 242));
  palette.setColor(QPalette::Base, Qt::white);
  palette.setColor(QPalette::AlternateBase, QColor(247, 248, 246));
  palette.setColor(QPalette::Button, QColor(250, 250, 249));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(role, ink);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, faint);
  palette.setColor(QPalette::Highlight, accent);
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::ToolTipBase, Qt::white);
  palette.setColor(QPalette::ToolTipText, ink);
  QApplication::setPalette(palette);
  QFont font = QFontDatabase::systemFont(QFontDatabase::GeneralFont);
  font.setPointSizeF(9.5);
  QApplication::setFont(font);
  app.setStyleSheet(sheet);
  QApplication::setWindowIcon(icon("app"));
}

} // namespace sandglass::desktop
