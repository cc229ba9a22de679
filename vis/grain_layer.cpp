#include "vis/grain_layer.h"

#include <vtkCellArray.h>
#include <vtkIdTypeArray.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

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
  // VTK's triangle around each sphere covers a disc of its radius at its centre. From a near eye the outline,
  // the tangent cone, is wider by 1 / sqrt(1 - (r / distance)^2) and would be cut flat on three sides.
  actor_->GetShaderProperty()->AddGeometryShaderReplacement(
      "//VTK::Picking::Impl", true,
      "//VTK::Picking::Impl\n"
      "  if (cameraParallel == 0)\n"
      "    {\n"
      "    float sine = min(radiusVCGSOutput / length(centerVCGSOutput), 0.99);\n"
      "    float wider = 1.0 / sqrt(1.0 - sine * sine);\n"
      "    base1 *= wider;\n"
      "    base2 *= wider;\n"
      "    }\n",
      false);
  // The brightest spot has just the colour of the map: ambient + diffuse * |0.90 key + 0.38 fill| + specular
  // = 1.
  actor_->GetProperty()->SetAmbient(0.30);
  actor_->GetProperty()->SetDiffuse(0.63);
  actor_->GetProperty()->SetSpecular(0.04);
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
