#pragma once
// What is written over a picture: title, time stamp, legend, scale bar, directions. One 2D item, so that the
// layout is in one place and nothing overlaps.

#include "vis/camera.h"
#include "vis/legend.h"

#include <vtkContextItem.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sandglass::vis {

struct OverlayContent {
  std::string title, time;        ///< empty: left out
  std::vector<Legend> legends;    ///< below each other at the right edge
  std::optional<CameraAxes> axes; ///< directions as seen by this camera
  double metresPerPixel = 0;      ///< at the target; 0: no scale bar
  std::array<double, 3> background{1, 1, 1};
  bool backed = true;        ///< a veil of the background behind title and time
  int width = 0, height = 0; ///< of what is painted
  int supersampling = 1;     ///< painted pixels for each pixel of the picture, in each direction
};

/// The part of the picture that the writing leaves free. `titled`: whether there is a title.
Frameable freeArea(const View& view, bool titled);

class Overlay : public vtkContextItem {
public:
  static Overlay* New();
  vtkTypeMacro(Overlay, vtkContextItem);
  OverlayContent content;
  bool Paint(vtkContext2D* painter) override;

private:
  void paintLegend(vtkContext2D* painter, const Legend& legend, float middle, float space) const;
  void paintEntries(vtkContext2D* painter, const Legend& legend, float middle) const;
  void paintAxes(vtkContext2D* painter, const CameraAxes& axes) const;
  void paintScaleBar(vtkContext2D* painter) const;
  float scale() const;
};

} // namespace sandglass::vis
