#include "vis/chart_style.h"

#include <vtkPen.h>
#include <vtkPlotPoints.h>

#include <algorithm>

namespace sandglass::vis {

SeriesStyle styleOf(const analysis::Series& series, std::size_t index) {
  static constexpr Rgb colours[] = {{0, 114, 178}, {213, 94, 0},   {0, 158, 115}, {204, 121, 167},
                                    {230, 159, 0}, {86, 180, 233}, {60, 60, 60}};
  static constexpr int lines[] = {vtkPen::SOLID_LINE, vtkPen::DASH_LINE, vtkPen::DASH_DOT_LINE,
                                  vtkPen::DENSE_DOT_LINE};
  static constexpr int markers[] = {vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND,
                                    vtkPlotPoints::CROSS};
  SeriesStyle style{colours[index % std::size(colours)], lines[index % std::size(lines)],
                    vtkPlotPoints::NONE};
  if (series.x.size() <= markedPoints) style.marker = markers[index % std::size(markers)];
  return style;
}

float chartScale(int width, int height) {
  return std::max(0.72F, std::min(static_cast<float>(width) / 860, static_cast<float>(height) / 540));
}

} // namespace sandglass::vis
