#pragma once
// What surrounds a chart's axes: title and key above, axis titles, definition below, and the marks over the
// lines.

#include "analysis/result.h"
#include "vis/chart_style.h"

#include <vtkContextItem.h>

#include <string>
#include <vector>

class vtkChartXY;

namespace sandglass::vis {

/// Pixels that the surroundings of the axes take on each side.
struct ChartMargins {
  float left = 0, right = 0, top = 0, bottom = 0;
};

class ChartFrame : public vtkContextItem {
public:
  static ChartFrame* New();
  vtkTypeMacro(ChartFrame, vtkContextItem);

  analysis::Curve curve;
  std::string xTitle, yTitle;  ///< with unit and power of ten
  vtkChartXY* chart = nullptr; ///< painted before this item: marks are placed by its axes
  int width = 0, height = 0;
  std::array<double, 3> ground{1, 1, 1};
  float scale = 1; ///< of letters and lines, relative to a chart 540 pixels high

  ChartMargins margins() const;
  SeriesStyle styleOf(std::size_t series) const; ///< on this ground
  bool Paint(vtkContext2D* painter) override;

  /// The rectangle between the axes [pixel from the lower left corner]; once painted.
  struct PlotArea {
    float x0, x1, y0, y1;
  };
  PlotArea plotArea() const;

private:
  std::vector<std::string> definitionLines() const;
  bool hasKey() const;
  /// Series in the key, row by row: as many in each as the chart is wide enough for.
  std::vector<std::vector<std::size_t>> keyRows() const;
  void paintKey(vtkContext2D* painter, float top) const;
  void paintKeyRow(vtkContext2D* painter, const std::vector<std::size_t>& row, float y) const;
  void paintMarks(vtkContext2D* painter) const;
  void paintAxisTitles(vtkContext2D* painter) const;
};

} // namespace sandglass::vis
