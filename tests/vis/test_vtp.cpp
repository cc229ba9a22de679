// What `convert` writes for older readers is read by the packaged VTK, value for value.

#include "sim/base/random.h"
#include "sim/io/run_folder.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

using namespace sandglass;
using namespace sandglass::test;

namespace {

Frame randomFrame(std::size_t grains, std::int64_t step) {
  RandomStream random(3, RandomPurpose::test, static_cast<std::uint64_t>(step));
  Frame f;
  f.time = 0.1 * static_cast<double>(step);
  f.step = step;
  f.scalars[quantity::radius] = {};
  f.vectors[quantity::velocity] = {};
  for (std::size_t i = 0; i < grains; ++i) {
    f.id.push_back((std::int64_t{1} << 40) + static_cast<std::int64_t>(i)); // more than 32 bits
    f.position.emplace_back(random.normal(), random.normal(), random.normal());
    f.scalars[quantity::radius].push_back(random.uniform());
    f.vectors[quantity::velocity].emplace_back(random.normal(), 1e-300, -0.0);
  }
  f.provenance = {{"scene", "00ff"}, {"note", "<\"a & b\"> \xc3\xbc"}};
  return f;
}

vtkSmartPointer<vtkPolyData> readVtp(const std::filesystem::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  REQUIRE(reader->CanReadFile(file.c_str()));
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

void requireSame(vtkPolyData* data, const Frame& frame) {
  REQUIRE(data->GetNumberOfPoints() == static_cast<vtkIdType>(frame.size()));
  REQUIRE(data->GetNumberOfVerts() == static_cast<vtkIdType>(frame.size()));
  CHECK(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == frame.time);
  auto* note = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("note"));
  REQUIRE(note != nullptr);
  CHECK(note->GetValue(0) == frame.provenance.at("note"));
  vtkPointData* arrays = data->GetPointData();
  REQUIRE(arrays->GetNumberOfArrays() == 3);
  if (frame.size() > 0) {
    CHECK(data->GetPoints()->GetDataType() == VTK_DOUBLE);
  }
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const auto k = static_cast<vtkIdType>(i);
    REQUIRE(Vec3(data->GetPoint(k)) == frame.position[i]);
    REQUIRE(static_cast<std::int64_t>(arrays->GetArray("id")->GetComponent(k, 0)) == frame.id[i]); // < 2^53
    REQUIRE(arrays->GetArray("radius")->GetComponent(k, 0) == frame.scalar(quantity::radius)[i]);
    for (int c = 0; c < 3; ++c)
      REQUIRE(arrays->GetArray("velocity")->GetComponent(k, c) == frame.vector(quantity::velocity)[i][c]);
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    data->GetVerts()->GetCellAtId(k, count, points);
    REQUIRE((count == 1 && points[0] == k));
  }
}

class ListSource final : public FrameSource {
public:
  explicit ListSource(std::vector<Frame> frames) : frames_(std::move(frames)) {}
  std::size_t size() const override { return frames_.size(); }
  double time(std::size_t index) const override { return frames_[index].time; }
  FramePtr load(std::size_t index) const override { return std::make_shared<Frame>(frames_[index]); }
  std::string name() const override { return "list"; }

private:
  std::vector<Frame> frames_;
};

} // namespace

TEST_CASE("VTK reads a .vtp file value for value", "[vis][io]") {
  const TemporaryFolder folder("vtp");
  for (const std::size_t grains : {0u, 1u, 1000u}) {
    const Frame frame = randomFrame(grains, 7);
    exportVtp(frame, folder / "a.vtp");
    requireSame(readVtp(folder / "a.vtp"), frame);
  }
}

TEST_CASE("A .pvd names each frame with its time", "[vis][io]") {
  const TemporaryFolder folder("pvd");
  const std::vector<Frame> frames{randomFrame(3, 0), randomFrame(0, 1), randomFrame(20, 3)};
  ListSource source(frames);
  exportPvd(source, folder / "run & co.pvd");
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromFile((folder / "run & co.pvd").c_str()));
  REQUIRE(root != nullptr);
  CHECK(std::string(root->GetAttribute("type")) == "Collection");
  vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
  REQUIRE(collection->GetNumberOfNestedElements() == 3);
  for (int i = 0; i < 3; ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    CHECK(std::stod(entry->GetAttribute("timestep")) == frames[i].time);
    requireSame(readVtp(folder.path() / entry->GetAttribute("file")), frames[i]);
  }
}
