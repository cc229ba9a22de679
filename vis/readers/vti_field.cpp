#include "vis/readers/vti_field.h"

#include "sim/base/error.h"
#include "sim/fields/flow_file.h"
#include "vis/gl/vtk_messages.h"
#include "vis/readers/child_reader.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkXMLImageDataReader.h>

namespace sandglass::vis {

FrameField readVtiField(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("{}: the file cannot be opened; check its name", file.string()));
  keepVtkMessages();
  takeVtkError();
  vtkNew<vtkXMLImageDataReader> reader;
  vtkNew<vtkStructuredPointsReader> legacy;
  const bool old = file.extension() == ".vtk";
  legacy->SetFileName(file.c_str());
  if (old ? legacy->IsFileStructuredPoints() == 0 : !reader->CanReadFile(file.c_str()))
    throw InputError(fmt::format("{}: byte 0: this is no VTK {}, which a field is", file.string(),
                                 old ? "legacy file of STRUCTURED_POINTS" : "XML file of type ImageData"));
  if (old) {
    legacy->ReadAllVectorsOn();
    legacy->ReadAllScalarsOn();
    legacy->Update();
  } else {
    reader->SetFileName(file.c_str());
    reader->Update();
  }
  if (const std::string error = takeVtkError(); !error.empty())
    throw InputError(fmt::format("{}: it cannot be read as {}: {}", file.string(),
                                 old ? "structured points" : "a VTI", error));
  vtkImageData* image = old ? legacy->GetOutput() : reader->GetOutput();
  FrameField field;
  field.name = file.stem().string();
  for (int k = 0; k < 3; ++k) {
    field.points[k] = image->GetDimensions()[k];
    field.spacing[k] = image->GetSpacing()[k];
    field.origin[k] = image->GetOrigin()[k] + image->GetExtent()[2 * k] * field.spacing[k];
  }
  vtkPointData* data = image->GetPointData();
  for (int a = 0; a < data->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = data->GetArray(a);
    if (!array || !array->GetName() || array->GetNumberOfTuples() != static_cast<vtkIdType>(field.size()))
      continue;
    if (array->GetNumberOfComponents() == 1) {
      auto& values = field.scalars[array->GetName()];
      for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
        values.push_back(array->GetTuple1(k));
    } else if (array->GetNumberOfComponents() == 3) {
      auto& values = field.vectors[array->GetName()];
      for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k)
        values.emplace_back(array->GetTuple3(k)[0], array->GetTuple3(k)[1], array->GetTuple3(k)[2]);
    }
  }
  // What analysis writes: "unit velocity" = "m/s" as field data.
  const std::string prefix = "unit ";
  for (int a = 0; a < image->GetFieldData()->GetNumberOfArrays(); ++a) {
    auto* text = vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray(a));
    if (!text || !text->GetName() || text->GetNumberOfValues() != 1) continue;
    const std::string name = text->GetName();
    if (name.starts_with(prefix)) field.units[name.substr(prefix.size())] = text->GetValue(0);
  }
  if (field.scalars.empty() && field.vectors.empty())
    throw InputError(fmt::format(
        "{}: it holds no scalar or vector at its points, so there is nothing to draw", file.string()));
  return field;
}

void registerFlowReaders() {
  for (const char* extension : {".vti", ".vtk"})
    registerFlowReader(extension, [](const std::filesystem::path& file) { return readVtiApart(file); });
}

FrameField frameField(const analysis::Field& field) {
  return {field.name, field.count, field.origin, field.spacing, field.scalars, field.vectors, field.units};
}

} // namespace sandglass::vis
