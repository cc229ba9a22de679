// Walls from ParaView's polygon files: triangles come in, other files are refused with a sentence.
#include "sim/base/error.h"
#include "tests/sim/temporary_folder.h"
#include "vis/readers/vtp_mesh.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace sandglass;

namespace {

/// A unit square as one polygon of four corners.
const std::string square = R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Polys></Piece></PolyData></VTKFile>
)";

} // namespace

TEST_CASE("polygons of a VTP become triangles", "[readers]") {
  const test::TemporaryFolder folder("vtp-mesh");
  std::ofstream(folder / "square.vtp") << square;
  const TriangleMesh mesh = vis::readVtpMesh(folder / "square.vtp");
  REQUIRE(mesh.points.size() == 4);
  REQUIRE(mesh.triangles.size() == 2);
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).z();
  CHECK(area == Approx(1.0)); // both turn the way of the polygon
}

TEST_CASE("what is no VTP is refused with a sentence that begins with its name", "[readers]") {
  const test::TemporaryFolder folder("vtp-bad");
  std::ofstream(folder / "torn.vtp") << square.substr(0, 300);
  std::ofstream(folder / "other.vtp") << "solid a\nendsolid a\n";
  std::string empty = square;
  empty.replace(empty.find("NumberOfPolys=\"1\""), 17, "NumberOfPolys=\"0\"");
  std::ofstream(folder / "empty.vtp") << empty;
  for (const char* name : {"torn.vtp", "other.vtp", "empty.vtp", "absent.vtp"})
    CHECK_THROWS_WITH(vis::readVtpMesh(folder / name), Catch::StartsWith((folder / name).string()));
}
