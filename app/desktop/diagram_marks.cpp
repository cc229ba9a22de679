#include "app/desktop/diagram_marks.h"

#include "vis/colour_map.h"

#include <QPolygonF>

#include <cmath>

namespace sandglass::desktop {

namespace {

const QColor none(190, 190, 190);

QColor qcolour(const vis::Rgb& c) {
  return {c[0], c[1], c[2]};
}

} // namespace

QColor classColour(int which) {
  static const vis::ColourMap map("discrete");
  return which < 0 ? none : qcolour(map.ofIndex(which));
}

QColor numberColour(double share) {
  static const vis::ColourMap map("viridis");
  return std::isfinite(share) ? qcolour(map.at(share)) : none;
}

QPainterPath shapeOf(int which) {
  QPainterPath path;
  const auto polygon = [&](std::initializer_list<QPointF> corners) {
    path.addPolygon(QPolygonF(QVector<QPointF>(corners)));
    path.closeSubpath();
  };
  switch (which < 0 ? 0 : which % 6) {
  case 1:
    path.addRect(-0.44, -0.44, 0.88, 0.88);
    break;
  case 2:
    path.addEllipse(QPointF(0, 0), 0.5, 0.5);
    break;
  case 3:
    polygon({{0, -0.56}, {0.56, 0}, {0, 0.56}, {-0.56, 0}});
    break;
  case 4:
    polygon({{0, -0.55}, {0.52, 0.4}, {-0.52, 0.4}});
    break;
  case 5:
    polygon({{0, 0.55}, {0.52, -0.4}, {-0.52, -0.4}});
    break;
  default:
    polygon({{-0.5, -0.18},
             {-0.18, -0.5},
             {0.18, -0.5},
             {0.5, -0.18},
             {0.5, 0.18},
             {0.18, 0.5},
             {-0.18, 0.5},
             {-0.5, 0.18}});
    break;
  }
  return path;
}

} // namespace sandglass::desktop
