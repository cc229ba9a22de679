#include "vis/wall_layer.h"

#include "vis/periodic_images.h"
#include "vis/text_style.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

#include <algorithm>

namespace sandglass::vis {

namespace {

vtkPolyData* dataOf(vtkActor* actor) {
  return vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputDataObject(0, 0));
}

void giveMapper(vtkActor* actor) {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkPolyData> data;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
}

} // namespace

WallLayer::WallLayer() {
  for (vtkActor* actor : actors())
    giveMapper(actor);
  // One colour whatever the light: then the order in which translucent faces are blended does not matter.
  faces_->GetProperty()->SetAmbient(1);
  faces_->GetProperty()->SetDiffuse(0);
  faces_->GetProperty()->SetInterpolationToPhong();
  // Like glass: clear where looked through squarely, denser towards the rim.
  faces_->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Light::Impl", true,
      "//VTK::Light::Impl\n"
      "  float slant = 1.0 - abs(normalVCVSOutput.z);\n"
      "  fragOutput0.a = min(1.0, fragOutput0.a * (0.6 + 2.4 * slant * slant));\n",
      false);
  faces_->ForceTranslucentOn();
  for (vtkActor* lines : {edges_.Get(), box_.Get()}) {
    lines->GetProperty()->SetAmbient(1); // lit, since a clip needs the place of a fragment, but in one colour
    lines->GetProperty()->SetDiffuse(0);
  }
}

void WallLayer::show(const Frame& frame, const View& view, const Camera& camera,
                     const Eigen::AlignedBox3d& box, float lineScale) {
  std::vector<std::shared_ptr<const WallShape>> wanted;
  if (view.walls)
    for (const auto& wall : frame.walls)
      if (wall.active || view.removedWalls) wanted.push_back(wall.shape);
  const std::vector<Vec3> shifts = imageShifts(frame.domain, view);
  if (wanted != shown_ || shifts != shifts_ || !box.isApprox(builtBox_)) {
    shown_ = wanted;
    shifts_ = shifts;
    rebuild(box);
  }
  const auto paint = [&](vtkActor* actor, double strength) {
    const auto ink = inkOn(view.background, strength);
    actor->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  };
  edges_->GetProperty()->SetLineWidth(1.6F * lineScale);
  box_->GetProperty()->SetLineWidth(1.0F * lineScale);
  faces_->GetProperty()->SetOpacity(view.wallOpacity);
  const bool light = inkOn(view.background, 1)[0] < 0.5; // the ground is light
  if (light)
    faces_->GetProperty()->SetColor(0.32, 0.42, 0.52);
  else
    faces_->GetProperty()->SetColor(0.66, 0.76, 0.86);
  paint(edges_, 0.75);
  paint(box_, 0.25);
  const auto& periodic = frame.domain.periodic;
  const bool anyPeriodic = std::any_of(periodic.begin(), periodic.end(), [](bool p) { return p; });
  faces_->SetVisibility(!shown_.empty() && view.wallOpacity > 0);
  edges_->SetVisibility(!shown_.empty() && view.wallEdges);
  box_->SetVisibility(view.walls && view.box && (anyPeriodic || frame.walls.empty()));
  clipFaces_.show(view, camera);
  clipEdges_.show(view, camera);
}

void WallLayer::rebuild(const Eigen::AlignedBox3d& box) {
  builtBox_ = box;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles, lines;
  for (const auto& shape : shown_) {
    const TriangleMesh mesh = shape->mesh(box);
    for (const Vec3& shift : shifts_) {
      const vtkIdType first = points->GetNumberOfPoints();
      for (const Vec3& p : mesh.points)
        points->InsertNextPoint(Vec3(p + shift).data());
      for (const auto& t : mesh.triangles) {
        const vtkIdType corners[] = {first + t[0], first + t[1], first + t[2]};
        triangles->InsertNextCell(3, corners);
      }
      for (const auto& e : mesh.edges) {
        const vtkIdType ends[] = {first + e[0], first + e[1]};
        lines->InsertNextCell(2, ends);
      }
    }
  }
  const auto fill = [](vtkActor* actor, vtkPoints* p, vtkCellArray* polygons, vtkCellArray* segments) {
    vtkPolyData* data = dataOf(actor);
    data->Initialize();
    data->SetPoints(p);
    if (polygons) data->SetPolys(polygons);
    if (segments) data->SetLines(segments);
    data->Modified();
  };
  fill(faces_, points, triangles, nullptr);
  if (points->GetNumberOfPoints() > 0) { // curved walls are round, edges stay sharp
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(dataOf(faces_));
    normals->SetFeatureAngle(30);
    normals->ConsistencyOff();
    normals->Update();
    dataOf(faces_)->ShallowCopy(normals->GetOutput());
  }
  fill(edges_, points, nullptr, lines);
  vtkNew<vtkFloatArray> upright; // any normal will do: VTK lights, and so locates, only lines that have one
  upright->SetNumberOfComponents(3);
  upright->SetNumberOfTuples(points->GetNumberOfPoints());
  upright->Fill(1);
  dataOf(edges_)->GetPointData()->SetNormals(upright);

  vtkNew<vtkPoints> corners;
  corners->SetDataTypeToDouble();
  vtkNew<vtkCellArray> outline;
  for (int c = 0; c < 8; ++c) {
    corners->InsertNextPoint(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)).data());
    for (int bit = 1; bit < 8; bit <<= 1) { // bit k of the corner's number is its side along axis k
      if (c & bit) continue;
      const vtkIdType ends[] = {c, c | bit};
      outline->InsertNextCell(2, ends);
    }
  }
  fill(box_, corners, nullptr, outline);
}

} // namespace sandglass::vis
