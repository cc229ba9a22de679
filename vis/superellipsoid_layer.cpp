#include "vis/superellipsoid_layer.h"

#include "vis/grain_layer.h"
#include "vis/superellipsoid_mapper.h"

#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSuperquadricSource.h>

namespace sandglass::vis {

SuperellipsoidLayer::SuperellipsoidLayer() {
  coordinates_->SetNumberOfComponents(3);
  turns_->SetName("turn");
  turns_->SetNumberOfComponents(4);
  axes_->SetName("axes");
  axes_->SetNumberOfComponents(3);
  squareness_->SetName("squareness");
  squareness_->SetNumberOfComponents(2);
  shape_->SetName("shape");
  colours_->SetName("colour");
  colours_->SetNumberOfComponents(3);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates_);
  points_->SetPoints(points);
  for (vtkDataArray* array : {static_cast<vtkDataArray*>(turns_), static_cast<vtkDataArray*>(axes_),
                              static_cast<vtkDataArray*>(squareness_), static_cast<vtkDataArray*>(shape_)})
    points_->GetPointData()->AddArray(array);
  points_->GetPointData()->SetScalars(colours_);

  vtkNew<SuperellipsoidMapper> mapper;
  mapper->SetInputData(points_);
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarModeToUsePointData();
  cast_->SetMapper(mapper);
  glyphs_->SetInputData(points_);
  glyphs_->SetColorModeToDirectScalars();
  glyphs_->SetScalarModeToUsePointData();
  glyphs_->SetScaleModeToNoDataScaling();
  glyphs_->SetOrientationModeToQuaternion();
  glyphs_->SetOrientationArray("turn");
  glyphs_->SourceIndexingOn();
  glyphs_->SetSourceIndexArray("shape");
  meshes_->SetMapper(glyphs_);
  for (vtkActor* actor : actors()) {
    setGrainSurface(actor->GetProperty());
    actor->VisibilityOff();
  }
}

void SuperellipsoidLayer::setSources(const std::vector<GrainShape>& shapes) {
  if (shapes == meshed_) return;
  meshed_ = shapes;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    constexpr int fineness = 64;
    vtkNew<vtkSuperquadricSource> source;
    source->ToroidalOff();
    source->SetAxisOfSymmetry(2);
    source->SetSize(1);
    source->SetScale(shapes[k].semiAxes.data());
    source->SetPhiRoundness(shapes[k].e1);
    source->SetThetaRoundness(shapes[k].e2);
    source->SetPhiResolution(fineness);
    source->SetThetaResolution(fineness);
    source->Update();
    glyphs_->SetSourceData(static_cast<int>(k), source->GetOutput());
  }
}

void SuperellipsoidLayer::show(const VisibleGrains& grains, const std::vector<std::size_t>& subset,
                               const std::vector<Rgb>& colours, bool asMeshes) {
  const auto n = static_cast<vtkIdType>(subset.size());
  cast_->SetVisibility(n > 0 && !asMeshes);
  meshes_->SetVisibility(n > 0 && asMeshes);
  if (n == 0) return;
  if (coordinates_->GetNumberOfTuples() != n) points_->SetVerts(vertexCells(n));
  for (vtkDataArray* array : {static_cast<vtkDataArray*>(coordinates_), static_cast<vtkDataArray*>(turns_),
                              static_cast<vtkDataArray*>(axes_), static_cast<vtkDataArray*>(squareness_),
                              static_cast<vtkDataArray*>(shape_), static_cast<vtkDataArray*>(colours_)}) {
    array->SetNumberOfTuples(n);
    array->Modified();
  }
  for (vtkIdType k = 0; k < n; ++k) {
    const std::size_t i = subset[static_cast<std::size_t>(k)];
    const auto s = static_cast<std::size_t>(grains.shape[i]);
    const GrainShape& shape = grains.shapes[s];
    const Eigen::Quaterniond& q = grains.orientation[i];
    turns_->SetTuple4(k, q.w(), q.x(), q.y(), q.z());
    squareness_->SetTuple2(k, shape.e1, shape.e2);
    shape_->SetValue(k, static_cast<int>(s));
    for (int axis = 0; axis < 3; ++axis) {
      coordinates_->SetTypedComponent(k, axis, static_cast<float>(grains.position[i][axis]));
      axes_->SetTypedComponent(k, axis, static_cast<float>(shape.semiAxes[axis]));
      colours_->SetTypedComponent(k, axis, colours[static_cast<std::size_t>(k)][axis]);
    }
  }
  if (asMeshes) setSources(grains.shapes);
  points_->GetPoints()->Modified();
  points_->Modified();
}

} // namespace sandglass::vis
