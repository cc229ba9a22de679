#pragma once
// A Curve as a VTK chart: lines with markers or dashes, error bars or bands, and around it title, key, marks
// and the definition line.

#include "analysis/result.h"
#include "vis/chart_frame.h"
#include "vis/chart_range.h"
#include "vis/renderer.h"

#include <vtkContextActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace sandglass::vis {

class ChartLayer {
public:
  ChartLayer();
  vtkRenderer* renderer() const { return renderer_; }

  /// Replaces what is shown.
  void show(const analysis::Curve& curve, int width, int height, const ChartLook& look = {});
  /// Of what was painted last.
  ChartPlace place() const;

private:
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkContextActor> actor_;
  vtkSmartPointer<ChartFrame> frame_;
  ChartRange range_;
};

} // namespace sandglass::vis
