#include "vis/solid_layer.h"

#include "vis/grain_layer.h"
#include "vis/superellipsoid_mapper.h"

#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSuperquadricSource.h>

namespace sandglass::vis {

SolidLayer::SolidLayer() {
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

void SolidLayer::setSources(const std::vector<Solid>& solids) {
  std::vector<GrainShape> wanted; // VTK wants the sources in order and without gaps
  for (const Solid& solid : solids) {
    const auto source = static_cast<std::size_t>(solid.source);
    if (source >= wanted.size()) wanted.resize(source + 1);
    wanted[source] = solid.shape;
  }
  if (wanted == meshed_) return;
  meshed_ = wanted;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    constexpr int fineness = 64;
    vtkNew<vtkSuperquadricSource> source;
    source->ToroidalOff();
    source->SetAxisOfSymmetry(2);
    source->SetSize(1);
    source->SetScale(wanted[k].semiAxes.data());
    source->SetPhiRoundness(wanted[k].e1);
    source->SetThetaRoundness(wanted[k].e2);
    source->SetPhiResolution(fineness);
    source->SetThetaResolution(fineness);
    source->Update();
    glyphs_->SetSourceData(static_cast<int>(k), source->GetOutput());
  }
}

void SolidLayer::show(const std::vector<Solid>& solids, bool asMeshes) {
  const auto n = static_cast<vtkIdType>(solids.size());
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
    const Solid& solid = solids[static_cast<std::size_t>(k)];
    const Eigen::Quaterniond& q = solid.turn;
    turns_->SetTuple4(k, q.w(), q.x(), q.y(), q.z());
    squareness_->SetTuple2(k, solid.shape.e1, solid.shape.e2);
    shape_->SetValue(k, solid.source);
    for (int axis = 0; axis < 3; ++axis) {
      coordinates_->SetTypedComponent(k, axis, static_cast<float>(solid.position[axis]));
      axes_->SetTypedComponent(k, axis, static_cast<float>(solid.shape.semiAxes[axis]));
      colours_->SetTypedComponent(k, axis, solid.colour[axis]);
    }
  }
  if (asMeshes) setSources(solids);
  points_->GetPoints()->Modified();
  points_->Modified();
}

} // namespace sandglass::vis
