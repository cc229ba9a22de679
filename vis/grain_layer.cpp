#include "vis/grain_layer.h"

#include <vtkIdTypeArray.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

#include <cmath>
#include <numeric>

namespace sandglass::vis {

void setGrainSurface(vtkProperty* surface) {
  // The brightest spot has just the colour of the map: ambient + diffuse * |0.90 key + 0.38 fill| + specular
  // = 1.
  surface->SetAmbient(0.30);
  surface->SetDiffuse(0.63);
  surface->SetSpecular(0.04);
  surface->SetSpecularPower(25);
}

vtkSmartPointer<vtkCellArray> vertexCells(vtkIdType count) {
  vtkNew<vtkIdTypeArray> offsets, connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(count);
  std::iota(offsets->GetPointer(0), offsets->GetPointer(0) + count + 1, vtkIdType{0});
  std::iota(connectivity->GetPointer(0), connectivity->GetPointer(0) + count, vtkIdType{0});
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

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
  setGrainSurface(actor_->GetProperty());
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
    const double radius =
        grains.isSphere(i)
            ? grains.radius[i]
            : std::cbrt(grains.shapes[static_cast<std::size_t>(grains.shape[i])].semiAxes.prod());
    radii_->SetValue(k, static_cast<float>(radius));
  }
  if (!sameCount) points_->SetVerts(vertexCells(n));
  coordinates_->Modified();
  radii_->Modified();
  colours_->Modified();
  points_->GetPoints()->Modified();
  points_->Modified();
  actor_->SetVisibility(n > 0);
}

} // namespace sandglass::vis
