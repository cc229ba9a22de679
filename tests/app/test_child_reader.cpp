// Files read in a process of their own: meshes come through unharmed; garbage, greed and endlessness cost a
// sentence that begins with the file.
#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/sim/temporary_folder.h"
#include "vis/readers/child_reader.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>

using namespace sandglass;

namespace {

std::string square(const std::string& points = "4") {
  return R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints=")" +
         points + R"(" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0.25</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Polys></Piece></PolyData></VTKFile>
)";
}

std::string refusal(const std::filesystem::path& file, const vis::ReaderLimits& limits = {},
                    const std::filesystem::path& program = SANDGLASS_PROGRAM) {
  try {
    vis::readVtpApart(file, limits, program);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// A program that ignores what it is asked and runs this shell text.
std::filesystem::path script(const test::TemporaryFolder& folder, const std::string& text) {
  const std::filesystem::path file = folder / "reader.sh";
  std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

} // namespace

TEST_CASE("a mesh comes back from the child as it is in the file", "[readers]") {
  const test::TemporaryFolder folder("child-mesh");
  std::ofstream(folder / "square.vtp") << square();
  const TriangleMesh mesh = vis::readVtpApart(folder / "square.vtp", {}, SANDGLASS_PROGRAM);
  REQUIRE(mesh.points.size() == 4);
  CHECK(mesh.points[3] == Vec3(0, 1, 0.25));
  REQUIRE(mesh.triangles.size() == 2);
}

TEST_CASE("a wind on a grid comes back from the child, out of both forms of file", "[readers]") {
  const test::TemporaryFolder folder("child-wind");
  const std::string numbers = "0 0 0 1 0 0 0 2 0 1 2 0 0 0 3 1 0 3 0 2 3 1 2 3"; // u = x of 2 x 2 x 2 points
  std::ofstream(folder / "a.vti")
      << R"(<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian"><ImageData WholeExtent="0 1 0 1 0 1" )"
      << R"(Origin="0 0 0" Spacing="1 2 3"><Piece Extent="0 1 0 1 0 1"><PointData><DataArray type="Float64" Name="u" )"
      << R"(NumberOfComponents="3" format="ascii">)" << numbers
      << "</DataArray></PointData></Piece></ImageData></VTKFile>";
  std::ofstream(folder / "a.vtk") << "# vtk DataFile Version 3.0\nwind\nASCII\nDATASET STRUCTURED_POINTS\n"
                                     "DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 2 3\nPOINT_DATA 8\n"
                                     "VECTORS u double\n"
                                  << numbers << "\n";
  for (const char* name : {"a.vti", "a.vtk"}) {
    const FrameField grid = vis::readVtiApart(folder / name, {}, SANDGLASS_PROGRAM);
    CHECK(grid.points == std::array<int, 3>{2, 2, 2});
    CHECK(grid.spacing == Vec3(1, 2, 3));
    REQUIRE(grid.vectors.at("u").size() == 8);
    for (int k = 0; k < 8; ++k)
      CHECK(grid.vectors.at("u")[k] == Vec3(k % 2, k / 2 % 2 * 2, k / 4 * 3));
  }
  for (const char* name : {"a.vti", "a.vtk"}) {
    const auto bad = folder / (std::string("bad-") + name);
    std::ofstream(bad) << "noise";
    CHECK_THROWS_WITH(vis::readVtiApart(bad, {}, SANDGLASS_PROGRAM), Catch::StartsWith(bad.string()));
  }
}

TEST_CASE("garbage and torn files are refused by the child's sentence or for its end", "[readers]") {
  const test::TemporaryFolder folder("child-bad");
  for (int k = 0; k < 6; ++k) {
    RandomStream random(9, RandomPurpose::test, k);
    std::string bytes = square();
    if (k < 2) // noise from the first byte, and noise behind a sound beginning
      for (std::size_t i = k == 0 ? 0 : 120; i < bytes.size(); ++i)
        bytes[i] = static_cast<char>(256 * random.uniform());
    else
      bytes.resize(static_cast<std::size_t>(static_cast<double>(bytes.size()) * random.uniform()));
    std::ofstream(folder / "bad.vtp", std::ios::binary) << bytes;
    CHECK_THAT(refusal(folder / "bad.vtp"), Catch::StartsWith((folder / "bad.vtp").string()));
  }
  CHECK_THAT(refusal(folder / "absent.vtp"), Catch::StartsWith((folder / "absent.vtp").string()));
}

TEST_CASE("a file that asks for more memory than there may be ends its reader, not the run", "[readers]") {
  const test::TemporaryFolder folder("child-greed");
  std::ofstream(folder / "greedy.vtp") << square("400000000000");
  vis::ReaderLimits limits;
  limits.memory = std::size_t{2} << 30;
  CHECK_THAT(refusal(folder / "greedy.vtp", limits), Catch::StartsWith((folder / "greedy.vtp").string()));
}

TEST_CASE("readers that hang, never stop talking, crash or lie are stopped and told", "[readers]") {
  const test::TemporaryFolder folder("child-endless");
  std::ofstream(folder / "a.vtp") << square();
  vis::ReaderLimits limits;
  limits.wallSeconds = 1;
  limits.answer = 1 << 20;
  const auto start = std::chrono::steady_clock::now();
  CHECK_THAT(refusal(folder / "a.vtp", limits, script(folder, "while :; do :; done")),
             Catch::Contains("took longer than 1 s"));
  CHECK_THAT(refusal(folder / "a.vtp", limits, script(folder, "exec yes M")),
             Catch::Contains("and was stopped"));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(120));
  limits.wallSeconds = 120; // what ends by itself does so on a busy machine as well
  CHECK_THAT(refusal(folder / "a.vtp", limits, script(folder, "kill -SEGV $$")), Catch::Contains("gave up"));
  CHECK_THAT(refusal(folder / "a.vtp", limits, script(folder, "printf Mlies")),
             Catch::Contains("is no mesh"));
  // One point and a triangle that names three: counts in 8 bytes each, 24 bytes of zeros, corners 0 1 2.
  CHECK_THAT(refusal(folder / "a.vtp", limits,
                     script(folder, R"(printf 'M\001\0\0\0\0\0\0\0\001\0\0\0\0\0\0\0'; head -c 24 /dev/zero
printf '\0\0\0\0\001\0\0\0\002\0\0\0')")),
             Catch::Contains("names point 1 of 1"));
}
