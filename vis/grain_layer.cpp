#include "vis/grain_layer.h"

#include <vtkCellArray.h>
#include <vtkIdTypeArray.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

#include <numeric>

namespace sandglass::vis {

GrainLayer::GrainLayer() {
  coordinates_->SetNumberOfComponents(3);
  radii_->SetName("radius");
  colours_->SetName("colour");
  colours_->SetNumberOfComponents(3);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates_);
  points_->SetPoints(points);
  points_->GetPointData()->AddArray(radii_);
  points_->GetPointData()->SetScalars(colours_);

  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(points_);
  mapper->SetScaleArray("radius");
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarModeToUsePointData();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->SetAmbient(0.22);
  actor_->GetProperty()->SetDiffuse(0.78);
  actor_->GetProperty()->SetSpecular(0.10);
  actor_->GetProperty()->SetSpecularPower(25);
}

void GrainLayer::show(const VisibleGrains& grains, const std::vector<std::size_t>& subset,
                      const std::vector<Rgb>& colours) {
  const auto n = static_cast<vtkIdType>(subset.size());
  const bool sameCount = coordinates_->GetNumberOfTuples() == n;
  coordinates_->SetNumberOfTuples(n);
  radii_->SetNumberOfTuples(n);
  colours_->SetNumberOfTuples(n);
  for (vtkIdType k = 0; k < n; ++k) {
    const std::size_t i = subset[static_cast<std::size_t>(k)];
    for (int axis = 0; axis < 3; ++axis) {
      coordinates_->SetTypedComponent(k, axis, static_cast<float>(grains.position[i][axis]));
      colours_->SetTypedComponent(k, axis, colours[static_cast<std::size_t>(k)][axis]);
    }
    radii_->SetValue(k, static_cast<float>(grains.radius[i]));
  }
  if (!sameCount) {
    vtkNew<vtkIdTypeArray> offsets, connectivity; // one vertex cell for each grain
    offsets->SetNumberOfValues(n + 1);
    connectivity->SetNumberOfValues(n);
    std::iota(offsets->GetPointer(0), offsets->GetPointer(0) + n + 1, vtkIdType{0});
    std::iota(connectivity->GetPointer(0), connectivity->GetPointer(0) + n, vtkIdType{0});
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, connectivity);
    points_->SetVerts(cells);
  }
  coordinates_->Modified();
  radii_->Modified();
  colours_->Modified();
  points_->GetPoints()->Modified();
  points_->Modified();
  actor_->SetVisibility(n > 0);
}

} // namespace sandglass::vis
