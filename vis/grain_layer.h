#pragma once
// Grains as sphere impostors: one actor for all, each a quad whose shader draws a lit sphere of true size and
// depth. From frame to frame only the arrays change.

#include "vis/colour_map.h"
#include "vis/visible_grains.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

class vtkProperty;

namespace sandglass::vis {

/// How grains of any shape reflect the light.
void setGrainSurface(vtkProperty* surface);

/// One vertex cell for each of `count` points: VTK's impostors draw nothing without.
vtkSmartPointer<vtkCellArray> vertexCells(vtkIdType count);

class GrainLayer {
public:
  GrainLayer();
  vtkActor* actor() const { return actor_; }

  /// Shows `subset` of `grains` in `colours` (one for each of the subset). A grain that is no sphere is shown
  /// as one of about its volume.
  void show(const VisibleGrains& grains, const std::vector<std::size_t>& subset,
            const std::vector<Rgb>& colours);

private:
  vtkNew<vtkActor> actor_;
  vtkNew<vtkPolyData> points_;
  vtkNew<vtkFloatArray> coordinates_, radii_;
  vtkNew<vtkUnsignedCharArray> colours_;
};

} // namespace sandglass::vis
