#include "vis/gl/external_window.h"

#include "tests/bench/stock_vtk.h"

#include "sim/base/error.h"
#include "vis/read_back.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSuperquadricSource.h>

namespace sandglass::bench {

struct StockVtk::Impl {
  StockMapper kind;
  vtkSmartPointer<vis::ExternalWindow> window = vtkSmartPointer<vis::ExternalWindow>::New();
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkActor> actor;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkFloatArray> radius, speed, turn;
  vtkNew<vtkIntArray> shape;
  vtkNew<vtkPoints> points;
  vtkSmartPointer<vtkMapper> mapper;
  bool first = true;

  void start(const Frame& frame) {
    const auto n = static_cast<vtkIdType>(frame.size());
    radius->SetName("radius");
    speed->SetName("speed");
    turn->SetName("turn");
    turn->SetNumberOfComponents(4);
    shape->SetName("shape");
    vtkNew<vtkCellArray> cells;
    for (vtkIdType i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      radius->InsertNextValue(static_cast<float>(frame.scalar(quantity::radius)[k]));
      speed->InsertNextValue(static_cast<float>(frame.vector(quantity::velocity)[k].norm()));
      if (!frame.orientation.empty()) {
        const auto& q = frame.orientation[k];
        turn->InsertNextTuple4(q.w(), q.x(), q.y(), q.z());
        shape->InsertNextValue(static_cast<int>(frame.scalar(quantity::shape)[k]));
      }
      cells->InsertNextCell(1, &i);
    }
    points->SetNumberOfPoints(n);
    data->SetPoints(points);
    data->SetVerts(cells);
    data->GetPointData()->AddArray(radius);
    data->GetPointData()->AddArray(turn);
    data->GetPointData()->AddArray(shape);
    data->GetPointData()->SetScalars(speed);
    mapper = makeMapper(frame);
    mapper->SetScalarRange(0, 1);
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
    renderer->SetBackground(1, 1, 1);
    window->AddRenderer(renderer);
    window->SetSize(1280, 720);
  }

  vtkSmartPointer<vtkMapper> makeMapper(const Frame& frame) {
    if (kind == StockMapper::spheres) {
      auto spheres = vtkSmartPointer<vtkOpenGLSphereMapper>::New();
      spheres->SetInputData(data);
      spheres->SetScaleArray("radius");
      return spheres;
    }
    if (kind == StockMapper::gaussianPoints) {
      auto splats = vtkSmartPointer<vtkPointGaussianMapper>::New();
      splats->SetInputData(data);
      splats->SetScaleArray("radius");
      splats->EmissiveOff();
      return splats;
    }
    auto glyphs = vtkSmartPointer<vtkGlyph3DMapper>::New();
    glyphs->SetInputData(data);
    glyphs->SetScaleModeToNoDataScaling();
    glyphs->SetOrientationModeToQuaternion();
    glyphs->SetOrientationArray("turn");
    glyphs->SourceIndexingOn();
    glyphs->SetSourceIndexArray("shape");
    for (std::size_t k = 0; k < frame.shapes.size(); ++k) {
      constexpr int fineness = 8;
      vtkNew<vtkSuperquadricSource> source;
      source->ToroidalOff();
      source->SetAxisOfSymmetry(2);
      source->SetSize(1);
      source->SetScale(frame.shapes[k].semiAxes.data());
      source->SetPhiRoundness(frame.shapes[k].e1);
      source->SetThetaRoundness(frame.shapes[k].e2);
      source->SetPhiResolution(fineness);
      source->SetThetaResolution(fineness);
      source->Update();
      glyphs->SetSourceData(static_cast<int>(k), source->GetOutput());
    }
    return glyphs;
  }
};

StockVtk::StockVtk(StockMapper kind) : impl_(std::make_unique<Impl>()) {
  impl_->kind = kind;
  std::string reason;
  auto context = vis::makeOsmesaContext(reason);
  if (!context) throw Error("no OSMesa: " + reason);
  impl_->window->setContext(std::move(context));
  impl_->window->SetMultiSamples(0);
}

StockVtk::~StockVtk() = default;

vis::Image StockVtk::draw(const Frame& frame, double degrees) {
  Impl& d = *impl_;
  const bool first = d.first;
  if (first) d.start(frame);
  d.first = false;
  for (std::size_t i = 0; i < frame.size(); ++i)
    d.points->SetPoint(static_cast<vtkIdType>(i), frame.position[i].data());
  d.points->Modified();
  d.data->Modified();
  if (first) {
    d.renderer->GetActiveCamera()->SetPosition(0.45, -1, 0.42);
    d.renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    d.renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
    d.renderer->ResetCamera();
  }
  d.renderer->GetActiveCamera()->Azimuth(degrees);
  d.renderer->ResetCameraClippingRange();
  d.window->Render();
  return vis::readBack(d.window);
}

} // namespace sandglass::bench
