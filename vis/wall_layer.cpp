#include "vis/wall_layer.h"

#include "vis/text_style.h"

#include <vtkCellArray.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

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

void clip(vtkActor* actor, const std::vector<ClipPlane>& clips) {
  actor->GetMapper()->RemoveAllClippingPlanes();
  for (const auto& c : clips) {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(c.point.data());
    plane->SetNormal(c.normal.data());
    actor->GetMapper()->AddClippingPlane(plane);
  }
}

} // namespace

WallLayer::WallLayer() {
  for (vtkActor* actor : actors())
    giveMapper(actor);
  faces_->GetProperty()->SetAmbient(0.45);
  faces_->GetProperty()->SetDiffuse(0.55);
  faces_->GetProperty()->SetInterpolationToFlat();
  faces_->ForceTranslucentOn();
  for (vtkActor* lines : {edges_.Get(), box_.Get()})
    lines->GetProperty()->LightingOff();
  edges_->GetProperty()->SetLineWidth(1.6F);
  box_->GetProperty()->SetLineWidth(1.0F);
}

void WallLayer::show(const Frame& frame, const View& view, const Eigen::AlignedBox3d& box) {
  std::vector<std::shared_ptr<const WallShape>> wanted;
  if (view.walls)
    for (const auto& wall : frame.walls)
      if (wall.active || view.removedWalls) wanted.push_back(wall.shape);
  if (wanted != shown_ || !box.isApprox(builtBox_)) {
    shown_ = wanted;
    rebuild(box);
  }
  const auto paint = [&](vtkActor* actor, double strength) {
    const auto ink = inkOn(view.background, strength);
    actor->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  };
  faces_->GetProperty()->SetOpacity(view.wallOpacity);
  paint(faces_, 0.5);
  paint(edges_, 0.75);
  paint(box_, 0.25);
  const auto& periodic = frame.domain.periodic;
  const bool anyPeriodic = std::any_of(periodic.begin(), periodic.end(), [](bool p) { return p; });
  faces_->SetVisibility(!shown_.empty() && view.wallOpacity > 0);
  edges_->SetVisibility(!shown_.empty());
  box_->SetVisibility(view.walls && (anyPeriodic || frame.walls.empty()));
  for (vtkActor* actor : {faces_.Get(), edges_.Get()})
    clip(actor, view.clips);
}

void WallLayer::rebuild(const Eigen::AlignedBox3d& box) {
  builtBox_ = box;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles, lines;
  for (const auto& shape : shown_) {
    const TriangleMesh mesh = shape->mesh(box);
    const vtkIdType first = points->GetNumberOfPoints();
    for (const auto& p : mesh.points)
      points->InsertNextPoint(p.data());
    for (const auto& t : mesh.triangles) {
      const vtkIdType corners[] = {first + t[0], first + t[1], first + t[2]};
      triangles->InsertNextCell(3, corners);
    }
    for (const auto& e : mesh.edges) {
      const vtkIdType ends[] = {first + e[0], first + e[1]};
      lines->InsertNextCell(2, ends);
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
  fill(edges_, points, nullptr, lines);

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
