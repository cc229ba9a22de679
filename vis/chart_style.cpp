#include "vis/chart_style.h"

#include <vtkPen.h>
#include <vtkPlotPoints.h>

#include <algorithm>

namespace sandglass::vis {

namespace {

/// Kinds of points: each has a symbol, or a size, of its own as well.
SeriesStyle pointStyle(std::size_t kind) {
  static const SeriesStyle styles[] = {
      {{140, 140, 140}, vtkPen::NO_PEN, vtkPlotPoints::SQUARE, 4},
      {{86, 180, 233}, vtkPen::NO_PEN, vtkPlotPoints::SQUARE, 9},
      {{0, 158, 115}, vtkPen::NO_PEN, vtkPlotPoints::CIRCLE, 10},
      {{213, 94, 0}, vtkPen::NO_PEN, vtkPlotPoints::DIAMOND, 11},
      {{200, 130, 0}, vtkPen::NO_PEN, vtkPlotPoints::CROSS, 11},
      {{170, 60, 130}, vtkPen::NO_PEN, vtkPlotPoints::PLUS, 14},
      {{60, 60, 60}, vtkPen::NO_PEN, vtkPlotPoints::CROSS, 5},
  };
  return styles[kind % std::size(styles)];
}

} // namespace

SeriesStyle styleOf(const analysis::Series& series, std::size_t index) {
  if (series.ring) return {{185, 185, 185}, vtkPen::NO_PEN, vtkPlotPoints::CIRCLE, 18};
  if (series.scatter) return pointStyle(index == 0 ? 0 : index - 1);
  static constexpr Rgb colours[] = {{0, 114, 178}, {213, 94, 0},   {0, 158, 115}, {204, 121, 167},
                                    {230, 159, 0}, {86, 180, 233}, {60, 60, 60}};
  static constexpr int lines[] = {vtkPen::SOLID_LINE, vtkPen::DASH_LINE, vtkPen::DASH_DOT_LINE,
                                  vtkPen::DENSE_DOT_LINE};
  static constexpr int markers[] = {vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND,
                                    vtkPlotPoints::CROSS};
  SeriesStyle style{colours[index % std::size(colours)], lines[index % std::size(lines)], vtkPlotPoints::NONE,
                    7};
  if (series.x.size() <= markedPoints) style.marker = markers[index % std::size(markers)];
  return style;
}

float chartScale(int width, int height) {
  return std::max(0.72F, std::min(static_cast<float>(width) / 860, static_cast<float>(height) / 540));
}

} // namespace sandglass::vis
