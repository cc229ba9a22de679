#include "vis/slice_layer.h"

#include "sim/base/error.h"
#include "vis/text_style.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCutter.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkLookupTable.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkStreamTracer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

namespace {

template <class Map> std::string namesOf(const Map& map) {
  std::string list;
  for (const auto& [name, values] : map)
    list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

const FrameField& fieldOf(const Frame& frame, const std::string& name) {
  if (frame.fields.empty())
    throw InputError(
        fmt::format("the frame at {:.6g} s holds no field to slice; coarse-grain it first", frame.time));
  if (name.empty()) return frame.fields.front();
  const auto found = std::find_if(frame.fields.begin(), frame.fields.end(),
                                  [&](const FrameField& f) { return f.name == name; });
  if (found != frame.fields.end()) return *found;
  std::string known;
  for (const auto& field : frame.fields)
    known += (known.empty() ? "" : ", ") + field.name;
  throw InputError(
      fmt::format("the frame at {:.6g} s has no field '{}'; it has: {}", frame.time, name, known));
}

const std::vector<Vec3>& vectorOf(const FrameField& field, const std::string& name) {
  const auto found = field.vectors.find(name);
  if (found == field.vectors.end())
    throw InputError(fmt::format("the field '{}' has no vector '{}'; it has: {}", field.name, name,
                                 namesOf(field.vectors)));
  return found->second;
}

struct Quantity {
  std::vector<double> values;
  std::string name, unit;
};

/// An array, the magnitude of a vector, or a component such as "velocity.z".
Quantity quantityOf(const FrameField& field, std::string name) {
  if (name.empty() && !field.scalars.empty()) name = field.scalars.begin()->first;
  const auto unit = [&](const std::string& array) {
    const auto found = field.units.find(array);
    return found == field.units.end() ? std::string() : found->second;
  };
  if (const auto found = field.scalars.find(name); found != field.scalars.end())
    return {found->second, name, unit(name)};
  Quantity result{std::vector<double>(field.size()), name, ""};
  if (const auto found = field.vectors.find(name); found != field.vectors.end()) {
    for (std::size_t k = 0; k < field.size(); ++k)
      result.values[k] = found->second[k].norm();
    result.unit = unit(name);
    return result;
  }
  if (name.size() > 2 && name[name.size() - 2] == '.' && name.back() >= 'x' && name.back() <= 'z') {
    const std::string base = name.substr(0, name.size() - 2);
    const auto& vectors = vectorOf(field, base);
    for (std::size_t k = 0; k < field.size(); ++k)
      result.values[k] = vectors[k][name.back() - 'x'];
    result.unit = unit(base);
    return result;
  }
  throw InputError(fmt::format("the field '{}' has no array '{}'; it has the scalars {} and the vectors {}",
                               field.name, name, namesOf(field.scalars), namesOf(field.vectors)));
}

vtkSmartPointer<vtkPolyData> surfaceOf(vtkImageData* image, const FrameField& field,
                                       const FieldSlice& slice) {
  const bool flat = *std::min_element(field.points.begin(), field.points.end()) == 1;
  if (flat) {
    vtkNew<vtkDataSetSurfaceFilter> surface;
    surface->SetInputData(image);
    surface->Update();
    return surface->GetOutput();
  }
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(slice.point.data());
  plane->SetNormal(slice.normal.data());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(image);
  cutter->SetCutFunction(plane);
  cutter->Update();
  return cutter->GetOutput();
}

/// Without the cells that have a corner where there is nothing: NaN.
void dropEmptyCells(vtkPolyData* surface) {
  vtkDataArray* values = surface->GetPointData()->GetScalars();
  if (!values) return;
  surface->BuildLinks();
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell) {
    surface->GetCellPoints(cell, corners);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
      if (!std::isfinite(values->GetTuple1(corners->GetId(k)))) {
        surface->DeleteCell(cell);
        break;
      }
  }
  surface->RemoveDeletedCells();
}

vtkSmartPointer<vtkLookupTable> tableOf(const Legend& legend) {
  constexpr int steps = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(steps);
  table->SetTableRange(legend.low, legend.high > legend.low ? legend.high : legend.low + 1);
  for (int k = 0; k < steps; ++k) {
    const Rgb c = legend.map.at((k + 0.5) / steps);
    table->SetTableValue(k, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  return table;
}

/// Lines from some 60 points spread over the surface, a third of the field's extent each way.
void addStreamlines(std::vector<Solid>& lines, vtkImageData* image, vtkPolyData* surface, const View& view) {
  constexpr vtkIdType wanted = 60;
  const vtkIdType every = std::max<vtkIdType>(1, surface->GetNumberOfPoints() / wanted);
  vtkNew<vtkPoints> places;
  for (vtkIdType k = every / 2; k < surface->GetNumberOfPoints(); k += every)
    places->InsertNextPoint(surface->GetPoint(k));
  vtkNew<vtkPolyData> seeds;
  seeds->SetPoints(places);
  image->GetPointData()->SetActiveVectors(view.slice.streamlines.c_str());
  vtkNew<vtkStreamTracer> tracer;
  tracer->SetInputData(image);
  tracer->SetSourceData(seeds);
  tracer->SetIntegrationDirectionToBoth();
  tracer->SetIntegratorTypeToRungeKutta4();
  tracer->SetMaximumPropagation(image->GetLength() / 3);
  tracer->SetComputeVorticity(false);
  tracer->Update();
  vtkPolyData* traced = tracer->GetOutput();
  const auto ink = inkOn(view.background, 0.85);
  const Rgb colour{static_cast<std::uint8_t>(255 * ink[0]), static_cast<std::uint8_t>(255 * ink[1]),
                   static_cast<std::uint8_t>(255 * ink[2])};
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < traced->GetNumberOfCells(); ++cell) {
    traced->GetCellPoints(cell, corners);
    std::vector<Vec3> line;
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
      Vec3 p;
      traced->GetPoint(corners->GetId(k), p.data());
      if (!isClipped(view, p)) line.push_back(p);
    }
    addLine(lines, line, 1e-3 * image->GetLength(), colour);
  }
}

} // namespace

vtkSmartPointer<vtkImageData> imageOf(const FrameField& field) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(field.points.data());
  image->SetOrigin(field.origin.data());
  image->SetSpacing(field.spacing.data());
  const auto add = [&](const std::string& name, int components) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(field.size()));
    image->GetPointData()->AddArray(array);
    return array->GetPointer(0);
  };
  for (const auto& [name, values] : field.scalars)
    std::copy(values.begin(), values.end(), add(name, 1));
  for (const auto& [name, values] : field.vectors) {
    double* out = add(name, 3);
    for (const Vec3& v : values)
      for (int k = 0; k < 3; ++k)
        *out++ = std::isfinite(v[k]) ? v[k] : 0; // lines end where nothing flows
  }
  return image;
}

SliceLayer::SliceLayer() {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->InterpolateScalarsBeforeMappingOn();
  mapper->SetColorModeToMapScalars();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->SetAmbient(1); // the colours of the legend, whatever the light
  actor_->GetProperty()->SetDiffuse(0);
  actor_->VisibilityOff();
}

std::optional<Legend> SliceLayer::show(const Frame& frame, const View& view, const Camera& camera,
                                       std::vector<Solid>& lines) {
  const FieldSlice& slice = view.slice;
  actor_->SetVisibility(slice.shown);
  if (!slice.shown) return std::nullopt;
  const FrameField& field = fieldOf(frame, slice.field);
  const Quantity quantity = quantityOf(field, slice.quantity);
  Legend legend{quantity.name, quantity.unit, ColourMap(slice.map), slice.low, slice.high, {}, 0};
  if (slice.range == ColourRange::frame) {
    legend.low = std::numeric_limits<double>::infinity();
    legend.high = -legend.low;
    for (const double v : quantity.values)
      if (std::isfinite(v)) legend.low = std::min(legend.low, v), legend.high = std::max(legend.high, v);
    if (!(legend.low <= legend.high)) legend.low = 0, legend.high = 1;
  }
  const auto image = imageOf(field);
  vtkNew<vtkDoubleArray> values;
  values->SetName("slice");
  values->SetNumberOfTuples(static_cast<vtkIdType>(field.size()));
  std::copy(quantity.values.begin(), quantity.values.end(), values->GetPointer(0));
  image->GetPointData()->SetScalars(values);
  const auto surface = surfaceOf(image, field, slice);
  dropEmptyCells(surface);
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor_->GetMapper());
  mapper->SetInputData(surface);
  mapper->SetLookupTable(tableOf(legend));
  mapper->UseLookupTableScalarRangeOn();
  actor_->GetProperty()->SetOpacity(slice.opacity);
  clip_.show(view, camera);
  if (!slice.streamlines.empty()) {
    vectorOf(field, slice.streamlines);
    addStreamlines(lines, image, surface, view);
  }
  return legend;
}

} // namespace sandglass::vis
