#include "vis/readers/vtk_frame.h"

#include "sim/base/error.h"
#include "sim/io/import/reader_table.h"
#include "vis/gl/vtk_messages.h"
#include "vis/readers/child_reader.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkDataSetReader.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <fstream>

namespace sandglass::vis {

namespace {

constexpr std::string_view legacyMark = "# vtk DataFile";

bool isXmlOf(std::string_view head, std::string_view type) {
  const std::size_t at = head.find("<VTKFile");
  if (at == std::string_view::npos || at > 1024) return false;
  const std::string_view element = head.substr(at, head.find('>', at) - at);
  return element.find(type) != std::string_view::npos;
}

template <class Reader> vtkSmartPointer<vtkDataSet> readWith(const std::filesystem::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  if constexpr (std::is_same_v<Reader, vtkDataSetReader>) {
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllFieldsOn();
  }
  reader->Update();
  return reader->GetOutput();
}

std::string headOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

void addArray(vtkDataArray* array, std::size_t rows, RawFrame& frame) {
  constexpr int mostComponents = 4; // tensors have no place in a frame
  if (!array || !array->GetName() || array->GetNumberOfTuples() != static_cast<vtkIdType>(rows)) return;
  const int parts = array->GetNumberOfComponents();
  if (parts < 1 || parts > mostComponents) return;
  for (int c = 0; c < parts; ++c) {
    RawColumn column;
    column.name = parts == 1 ? array->GetName() : fmt::format("{}:{}", array->GetName(), c);
    column.numbers.resize(rows);
    for (std::size_t k = 0; k < rows; ++k)
      column.numbers[k] = array->GetComponent(static_cast<vtkIdType>(k), c);
    frame.columns.push_back(std::move(column));
  }
}

/// One file, one frame. What the child sent for it waits for the first read().
class VtkFormat final : public FrameFormat {
public:
  explicit VtkFormat(const ImportFile& file) : file_(file.path()) {
    if (!file.size() || file_.empty())
      throw InputError(fmt::format("{}: a packed VTK file cannot be read; unpack it", file.name()));
  }
  std::optional<FrameMark> next() override {
    if (walked_) return std::nullopt;
    walked_ = true;
    frame_ = readVtkApart(file_);
    FrameMark mark;
    mark.time = frame_->time;
    return mark;
  }
  RawFrame read(const FrameMark&) override {
    if (!frame_) return readVtkApart(file_);
    RawFrame frame = std::move(*frame_);
    frame_.reset();
    return frame;
  }

private:
  std::filesystem::path file_;
  bool walked_ = false;
  std::optional<RawFrame> frame_;
};

} // namespace

RawFrame readVtkFrame(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("{}: the file cannot be opened; check its name", file.string()));
  keepVtkMessages();
  takeVtkError();
  const std::string head = headOf(file);
  const vtkSmartPointer<vtkDataSet> data = head.starts_with(legacyMark) ? readWith<vtkDataSetReader>(file)
                                           : isXmlOf(head, "PolyData")
                                               ? readWith<vtkXMLPolyDataReader>(file)
                                               : readWith<vtkXMLUnstructuredGridReader>(file);
  if (const std::string error = takeVtkError(); !error.empty())
    throw InputError(fmt::format("{}: VTK cannot read it: {}", file.string(), error));
  auto* points = vtkPointSet::SafeDownCast(data);
  if (!points || !points->GetPoints())
    throw InputError(fmt::format("{}: it holds no points (it is a {}), but grains are points", file.string(),
                                 data ? data->GetClassName() : "file without data"));
  const auto rows = static_cast<std::size_t>(points->GetNumberOfPoints());
  if (auto* poly = vtkPolyData::SafeDownCast(data);
      poly && rows > 0 && poly->GetNumberOfPolys() + poly->GetNumberOfStrips() > 0 &&
      poly->GetNumberOfVerts() == 0)
    throw InputError(fmt::format("{}: it holds {} polygons and no grains; show it as a wall with --walls",
                                 file.string(), poly->GetNumberOfPolys() + poly->GetNumberOfStrips()));
  RawFrame frame;
  frame.rows = rows;
  for (int c = 0; c < 3; ++c) {
    RawColumn column{std::string(1, "xyz"[c]), std::vector<double>(rows), {}};
    for (std::size_t k = 0; k < rows; ++k)
      column.numbers[k] = points->GetPoint(static_cast<vtkIdType>(k))[c];
    frame.columns.push_back(std::move(column));
  }
  vtkPointData* arrays = points->GetPointData();
  for (int a = 0; a < arrays->GetNumberOfArrays(); ++a)
    addArray(arrays->GetArray(a), rows, frame);
  for (const char* name : {"TIME", "TimeValue", "time", "Time"})
    if (auto* time = points->GetFieldData()->GetArray(name); time && time->GetNumberOfTuples() == 1 &&
                                                             time->GetNumberOfComponents() == 1 &&
                                                             std::isfinite(time->GetTuple1(0)))
      frame.time = time->GetTuple1(0);
  return frame;
}

void registerFrameReaders() {
  registerReader({"VTK file (legacy, VTP, VTU)", "'# vtk DataFile' or '<VTKFile type=' (VTK)",
                  [](std::string_view head) {
                    return head.starts_with(legacyMark) || isXmlOf(head, "PolyData") ||
                           isXmlOf(head, "UnstructuredGrid");
                  },
                  [](const ImportFile& file, const ImportSettings&) -> std::unique_ptr<FrameFormat> {
                    return std::make_unique<VtkFormat>(file);
                  }});
}

} // namespace sandglass::vis
