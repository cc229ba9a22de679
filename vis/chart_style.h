#pragma once
// How the series of a chart tell themselves apart: by colour (Okabe and Ito 2008, safe for colour-blind eyes)
// and by dash or marker.

#include "analysis/result.h"
#include "vis/colour_map.h"

namespace sandglass::vis {

struct SeriesStyle {
  Rgb colour;
  int line = 0;   ///< of vtkPen
  int marker = 0; ///< of vtkPlotPoints; 0: none
  float size = 7; ///< of markers
};

/// Scattered series stand behind one that is a line, which may be empty: the second series of a chart is the
/// first kind of point.
SeriesStyle styleOf(const analysis::Series& series, std::size_t index);

/// Series of so few points show each of them.
inline constexpr std::size_t markedPoints = 40;

/// Size of fonts and lines relative to a chart 540 pixels high.
float chartScale(int width, int height);

} // namespace sandglass::vis
