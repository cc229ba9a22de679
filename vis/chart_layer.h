#pragma once
// A Curve as a VTK chart: lines with markers or dashes, error bars or bands, and around it title, key, marks
// and the definition line.

#include "analysis/result.h"

#include <vtkContextActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace sandglass::vis {

class ChartLayer {
public:
  ChartLayer();
  vtkRenderer* renderer() const { return renderer_; }

  /// Replaces what is shown.
  void show(const analysis::Curve& curve, int width, int height);

private:
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkContextActor> actor_;
};

} // namespace sandglass::vis
