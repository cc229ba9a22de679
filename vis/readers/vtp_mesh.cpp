#include "vis/readers/vtp_mesh.h"

#include "sim/base/error.h"
#include "sim/walls/mesh_file.h"
#include "vis/gl/vtk_messages.h"
#include "vis/readers/child_reader.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>

namespace sandglass::vis {

TriangleMesh readVtpMesh(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("{}: the file cannot be opened; check its name", file.string()));
  keepVtkMessages();
  takeVtkError();
  vtkNew<vtkXMLPolyDataReader> reader;
  if (!reader->CanReadFile(file.c_str()))
    throw InputError(fmt::format(
        "{}: byte 0: this is no VTK XML file of type PolyData, which a VTP is; convert it", file.string()));
  reader->SetFileName(file.c_str());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(reader->GetOutputPort());
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  triangles->Update();
  vtkPolyData* data = triangles->GetOutput();
  if (const std::string error = takeVtkError(); !error.empty())
    throw InputError(fmt::format("{}: it cannot be read as a VTP: {}", file.string(), error));
  if (reader->GetErrorCode() != 0 || !data->GetPoints() || data->GetNumberOfPolys() == 0)
    throw InputError(
        fmt::format("{}: no polygons can be read from it, but a wall needs one at least", file.string()));
  TriangleMesh mesh;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    Vec3 p;
    data->GetPoint(i, p.data());
    if (!p.allFinite())
      throw InputError(fmt::format("{}: point {} is ({}, {}, {}), but finite numbers are due", file.string(),
                                   i, p.x(), p.y(), p.z()));
    mesh.points.push_back(p);
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray* polygons = data->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(corners);) {
    if (corners->GetNumberOfIds() != 3) continue;
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const vtkIdType id = corners->GetId(k);
      if (id < 0 || id >= data->GetNumberOfPoints())
        throw InputError(
            fmt::format("{}: a polygon names point {} of {}", file.string(), id, data->GetNumberOfPoints()));
      triangle[k] = static_cast<int>(id);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

void registerMeshReaders() {
  registerMeshReader(".vtp", [](const std::filesystem::path& file) { return readVtpApart(file); });
}

} // namespace sandglass::vis
