// Frames of other programs: what each format means, settings, sequences, packed files.

#include "sim/base/error.h"
#include "sim/io/import/foreign_facts.h"
#include "sim/io/import/import_settings.h"
#include "sim/io/import/reader_table.h"
#include "sim/io/run_folder.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>
#include <zlib.h>
#include <zstd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

using namespace sandglass;
using namespace sandglass::test;
using Catch::Contains;

namespace {

std::unique_ptr<FrameSource> opened(const std::string& bytes, const ImportSettings& settings = {}) {
  constexpr std::uint64_t unpacked = 1 << 20;
  auto source = openForeign(std::make_shared<const ImportFile>("frames", bytes, unpacked), settings);
  while (!source->complete())
    source->refresh();
  return source;
}

bool mentions(const FrameSource& source, const std::string& words) {
  for (const auto& remark : source.remarks())
    if (remark.find(words) != std::string::npos) return true;
  return false;
}

/// Two grains in a box of 10 x 10 x 80, the second frame without the first of them, rows not in order of ids.
const char* const dump = "ITEM: TIMESTEP\n100\n"
                         "ITEM: NUMBER OF ATOMS\n2\n"
                         "ITEM: BOX BOUNDS pp ff ff\n0 10\n0 10\n0 80\n"
                         "ITEM: ATOMS id type x y z vx vy vz radius proc\n"
                         "7 2 11 2 3 0.5 0 -1 0.75 0\n"
                         "3 1 1 2 3.5 0 0 0 0.5 0\n"
                         "ITEM: TIMESTEP\n200\n"
                         "ITEM: NUMBER OF ATOMS\n1\n"
                         "ITEM: BOX BOUNDS pp ff ff\n0 10\n0 10\n0 80\n"
                         "ITEM: ATOMS id type x y z vx vy vz radius proc\n"
                         "7 2 2 2 3 0.5 0 -1 0.75 0\n";

} // namespace

TEST_CASE("A LAMMPS dump: ids in order, positions in the box, species named as in the file", "[import]") {
  ImportSettings settings;
  settings.timeStep = 1e-3;
  const auto source = opened(dump, settings);
  REQUIRE(source->size() == 2);
  CHECK(source->time(0) == Approx(0.1));
  CHECK(source->time(1) == Approx(0.2));
  const FramePtr frame = source->load(0);
  CHECK(frame->step == 100);
  CHECK(frame->id == std::vector<std::int64_t>{3, 7});
  CHECK(frame->position[1] == Vec3(1, 2, 3)); // 11 is one period beyond 1
  CHECK(frame->domain.periodic == std::array<bool, 3>{true, false, false});
  CHECK(frame->domain.upper == Vec3(10, 10, 80));
  CHECK(frame->scalar(quantity::radius) == std::vector<double>{0.5, 0.75});
  CHECK(frame->speciesNames == std::vector<std::string>{"1", "2"});
  CHECK(frame->scalar(quantity::species) == std::vector<double>{0, 1});
  CHECK(frame->vector(quantity::velocity)[1] == Vec3(0.5, 0, -1));
  CHECK(frame->persistentIds);
  CHECK_FALSE(frame->has("proc"));
  CHECK(source->load(1)->size() == 1);
  CHECK(source->load(0)->size() == 2); // backwards
  CHECK(source->remarks().empty());
}

TEST_CASE("Units turn lengths, times and masses of a file into SI", "[import]") {
  ImportSettings settings = parseImportSettings(
      "[units]\nlength = \"mm\"\ntime = \"ms\"\nmass = \"g\"\n[time]\nstep = \"0.01 ms\"", "s");
  const auto source = opened("ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 "
                             "1\n0 1\nITEM: ATOMS id xs ys zs vx vy vz fx fy fz mass omegax omegay omegaz "
                             "diameter\n1 0.5 0.25 0.75 2 0 0 3 0 0 4 5 0 0 6\n",
                             settings);
  const FramePtr frame = source->load(0);
  CHECK(frame->time == Approx(5e-5));
  CHECK(frame->position[0].isApprox(Vec3(0.5e-3, 0.25e-3, 0.75e-3), 1e-14));
  CHECK(frame->vector(quantity::velocity)[0].x() == Approx(2)); // mm/ms
  CHECK(frame->vector(quantity::force)[0].x() == Approx(3));    // g mm/ms^2 = N
  CHECK(frame->scalar(quantity::mass)[0] == Approx(4e-3));
  CHECK(frame->vector(quantity::spin)[0].x() == Approx(5e3));
  CHECK(frame->scalar(quantity::radius)[0] == Approx(3e-3));
}

TEST_CASE("Snapshots without names of columns: id type diameter x y z, and the old scaled default",
          "[import]") {
  const std::string head =
      "ITEM: TIMESTEP\n20000\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS\n-25 25\n-4 4\n0 "
      "100\nITEM: ATOMS\n";
  const FramePtr frame = opened(head + "1 1 1 0.5 1.5 2.5\n2 1 1 -3 0 9\n")->load(0);
  CHECK(frame->step == 20000);
  CHECK(frame->position[1] == Vec3(-3, 0, 9));
  CHECK(frame->scalar(quantity::radius) == std::vector<double>{0.5, 0.5});
  CHECK(frame->domain.periodic == std::array<bool, 3>{false, false, false});
  const auto scaled = opened(head + "1 1 0.5 0.5 0.5\n2 1 0 0 1\n");
  CHECK(scaled->load(0)->position[0] == Vec3(0, 0, 50));
  CHECK(mentions(*scaled, "id type xs ys zs"));
}

TEST_CASE("Tilted boxes: grains move by whole edges into the upright box of the same volume", "[import]") {
  // Edges (10, 0, 0), (xy, 8, 0), (xz, yz, 6) from the origin (1, 2, 3); LAMMPS' bounds are those of the
  // corners.
  const auto dumped = [](double xy, double xz, double yz, const std::string& atoms) {
    const auto bounds = [](double low, double high, double tilt) {
      return std::to_string(low) + " " + std::to_string(high) + " " + std::to_string(tilt) + "\n";
    };
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n" +
           bounds(1 + std::min({0., xy, xz, xy + xz}), 11 + std::max({0., xy, xz, xy + xz}), xy) +
           bounds(2 + std::min(0., yz), 10 + std::max(0., yz), xz) + bounds(3, 9, yz) + "ITEM: ATOMS " +
           atoms;
  };
  SECTION("scaled positions are shares of the edges") {
    // (1, 2, 3) + 0.5 a + 0.25 b + 0.75 c
    const auto source = opened(dumped(3, -2, 1, "id xs ys zs\n1 0.5 0.25 0.75\n"));
    const FramePtr frame = source->load(0);
    CHECK(frame->position[0].isApprox(Vec3(1 + 5 + 0.75 - 1.5, 2 + 2 + 0.75, 3 + 4.5), 1e-12));
    CHECK(frame->domain.periodic == std::array<bool, 3>{true, false, false});
    CHECK(frame->domain.lower.isApprox(Vec3(1, 2, 3)));
    CHECK(frame->domain.upper.isApprox(Vec3(11, 10, 9)));
    CHECK(mentions(*source, "does not repeat along y and z"));
  }
  SECTION("a grain above the box comes back by whole edges") {
    // Two c above and one b beyond (2, 3, 4).
    const auto source = opened(dumped(3, -2, 1, "id x y z\n1 1 13 16\n"));
    CHECK(source->load(0)->position[0].isApprox(Vec3(2, 3, 4), 1e-12));
  }
  SECTION("tilts of whole edges lose nothing") {
    // b is that of the upright box and a, c that of the upright box, b and a.
    const auto source = opened(dumped(10, 20, 8, "id x y z\n1 12 4 5\n"));
    const FramePtr frame = source->load(0);
    CHECK(frame->domain.periodic == std::array<bool, 3>{true, true, true});
    CHECK(frame->position[0].isApprox(Vec3(2, 4, 5), 1e-12));
    source->load(0);
    CHECK_FALSE(mentions(*source, "tilted"));
  }
  SECTION("along z alone") {
    const auto source = opened(dumped(0, 5, 0, "id x y z\n1 2 9 10\n"));
    const FramePtr frame = source->load(0);
    CHECK(frame->domain.periodic == std::array<bool, 3>{true, true, false});
    CHECK(frame->position[0].isApprox(Vec3(7, 9, 4), 1e-12));
  }
}

TEST_CASE("What each column of a file is understood as", "[import]") {
  const TemporaryFolder folder("foreign_facts");
  const auto file = folder / "frames.dump";
  std::ofstream(file) << dump;
  const ForeignFacts facts = foreignFacts(file);
  CHECK(facts.grains == 2);
  CHECK(facts.step == 100);
  std::vector<std::string> quantities;
  for (const auto& column : facts.columns)
    quantities.push_back(column.quantity);
  CHECK(quantities == std::vector<std::string>{"id", "species", "x", "y", "z", "velocity.x", "velocity.y",
                                               "velocity.z", "radius", ""});
  CHECK(facts.columns[2].smallest == 1);
  CHECK(facts.columns[2].largest == 11);
  ImportSettings settings;
  settings.columns["temperature"] = "vx";
  settings.columns["radius"] = "";
  const ForeignFacts mapped = foreignFacts(file, &settings);
  CHECK(mapped.columns[5].quantity == "temperature");
  CHECK(mapped.columns[8].quantity.empty());
}

TEST_CASE("XYZ and extended XYZ", "[import]") {
  const auto plain = opened("2\nAtoms. Timestep: 40\nA 1 2 3\nB 4 5 6\n1\nAtoms. Timestep: 80\nB 7 8 9\n");
  REQUIRE(plain->size() == 2);
  CHECK(plain->load(0)->step == 40);
  CHECK(plain->load(0)->speciesNames == std::vector<std::string>{"A", "B"});
  CHECK(plain->load(1)->position[0] == Vec3(7, 8, 9));
  CHECK_FALSE(plain->load(0)->persistentIds);

  const auto extended = opened(
      "1\nLattice=\"10 0 0 0 20 0 0 0 30\" Origin=\"-5 0 0\" pbc=\"T F F\" Time=0.25 "
      "Properties=species:S:1:pos:R:3:id:I:1:radius:R:1:velo:R:3:orientation:R:4:aspherical_shape:R:3:t:R:1\n"
      "grain -4 2 3 17 0.5 1 0 0 0 0 0.6 0.8 1 2 3 9\n");
  const FramePtr frame = extended->load(0);
  CHECK(frame->time == 0.25);
  CHECK(frame->id[0] == 17);
  CHECK(frame->domain.lower == Vec3(-5, 0, 0));
  CHECK(frame->domain.upper == Vec3(5, 20, 30));
  CHECK(frame->domain.periodic == std::array<bool, 3>{true, false, false});
  CHECK(frame->vector(quantity::velocity)[0] == Vec3(1, 0, 0));
  CHECK(frame->orientation[0].z() == Approx(0.6)); // OVITO: x y z w
  CHECK(frame->orientation[0].w() == Approx(0.8));
  REQUIRE(frame->shapes.size() == 1);
  CHECK(frame->shapes[0].semiAxes == Vec3(1, 2, 3));
  // A grain that is no sphere has the radius of its volume, 4/3 pi a b c.
  CHECK(frame->scalar(quantity::radius)[0] == Approx(std::cbrt(6.0)));
  CHECK(frame->scalar("t")[0] == 9);
}

TEST_CASE("Superellipsoids: semi-axes and real part first in LIGGGHTS, whole axes in LAMMPS", "[import]") {
  const std::string head =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\nITEM: ATOMS ";
  const auto liggghts = opened(head + "id x y z shapex shapey shapez quat1 quat2 quat3 quat4 blockiness1 "
                                      "blockiness2\n1 4 4 4 1 1 2 0.8 0.6 0 0 4 2\n");
  const FramePtr a = liggghts->load(0);
  CHECK(a->shapes[0].semiAxes == Vec3(1, 1, 2));
  CHECK(a->shapes[0].e1 == 0.5); // 2 / blockiness
  CHECK(a->shapes[0].e2 == 1);
  CHECK(a->orientation[0].w() == Approx(0.8));
  CHECK(a->orientation[0].x() == Approx(0.6));
  CHECK(mentions(*liggghts, "semi-axes, as LIGGGHTS"));
  const auto lammps =
      opened(head + "id x y z shapex shapey shapez quatw quati quatj quatk\n1 4 4 4 1 1 2 0.8 0.6 0 0\n");
  CHECK(lammps->load(0)->shapes[0].semiAxes == Vec3(0.5, 0.5, 1));
  CHECK(mentions(*lammps, "whole axes, as LAMMPS"));
  ImportSettings settings;
  settings.shape = "semi-axes";
  CHECK(opened(head + "id x y z shapex shapey shapez\n1 4 4 4 1 1 2\n", settings)
            ->load(0)
            ->shapes[0]
            .semiAxes == Vec3(1, 1, 2));
}

TEST_CASE("The volume of a shape: nearly a box for a small exponent", "[import]") {
  ImportSettings settings;
  const auto source =
      opened("id,x,y,z,shape.x,shape.y,shape.z,e1,e2\n1,0,0,0,1,2,3,0.001,0.001\n2,9,9,9,1,1,2,2,2\n");
  const FramePtr frame = source->load(0);
  const auto& radius = frame->scalar(quantity::radius);
  const double third = 4 * std::numbers::pi / 3;
  CHECK(third * std::pow(radius[0], 3) == Approx(8 * 1 * 2 * 3).epsilon(1e-4)); // a box of 2a x 2b x 2c
  CHECK(third * std::pow(radius[1], 3) == Approx(4.0 / 3 * 1 * 1 * 2));         // an octahedron: 4/3 a b c
}

TEST_CASE("CSV: names in any case, quotes, several frames by a column of times", "[import]") {
  const auto source =
      opened("# tracked by hand\n\"Time\";\"ID\";\"Position:0\";\"Position:1\";\"Position:2\";"
             "\"R\";\"U:0\";\"U:1\";\"U:2\";note\r\n0.5;2;1;2;3;0.5;7;8;9;red\r\n"
             "0.5;1;4;5;6;0.5;7;8;9;blue\n1.5;1;4;5;6;0.5;7;8;9;blue\n");
  REQUIRE(source->size() == 2);
  CHECK(source->time(0) == 0.5);
  CHECK(source->time(1) == 1.5);
  const FramePtr frame = source->load(0);
  CHECK(frame->id == std::vector<std::int64_t>{1, 2});
  CHECK(frame->position[1] == Vec3(1, 2, 3));
  CHECK(frame->vector("U")[0] == Vec3(7, 8, 9));
  CHECK(frame->scalar(quantity::radius)[0] == 0.5);
}

TEST_CASE("Columns by the user's map, saved and read again", "[import]") {
  const std::string text =
      "[columns]\nradius = \"R_eff\"\nx = \"px\"\ny = \"py\"\nz = \"pz\"\nvelocity.x = "
      "\"U0\"\nvelocity.y = \"U1\"\nvelocity.z = \"U2\"\nheat = \"T\"\nid = \"\"\nignore = "
      "[\"junk\"]\n[box]\nlower = [0, 0, 0]\nupper = [\"1 cm\", 1, 1]\nperiodic = "
      "\"xz\"\n[grains]\nradius_of = { a = 0.1, \"2\" = \"1 mm\" }\n[units]\ntime = \"ms\"\n";
  const ImportSettings settings = parseImportSettings(text, "lab.toml");
  CHECK(settings.columns.at("velocity.x") == "U0");
  CHECK(settings.periodic == std::array<bool, 3>{true, false, true});
  CHECK(settings.upper == Vec3(0.01, 1, 1));
  CHECK(parseImportSettings(writeImportSettings(settings), "again") == settings);
  const FramePtr frame =
      opened("id,px,py,pz,R_eff,U0,U1,U2,T,junk\n5,0.015,1.25,0.5,0.1,1,2,3,300,x\n", settings)->load(0);
  CHECK(frame->id[0] == 1); // the file's own ids are left out
  CHECK(frame->position[0].isApprox(Vec3(0.005, 1.25, 0.5)));
  CHECK(frame->vector(quantity::velocity)[0] == Vec3(1e3, 2e3, 3e3));
  CHECK(frame->scalar("heat")[0] == 300);
  CHECK_FALSE(frame->has("junk"));
  CHECK_THROWS_WITH(parseImportSettings("[column]\nx = \"a\"\n[time]\nstep = \"3 kg\"\n", "bad.toml"),
                    Contains("column is unknown") && Contains("time.step"));
  CHECK_THROWS_WITH(parseImportSettings("[grains]\nradius_of = { \"a\\tb\" = 1 }\n", "bad.toml"),
                    Contains("control character 0x09 after 'a'"));
  CHECK_THROWS_WITH(parseImportSettings("[columns]\n\"x\\u0001\" = \"a\"\n", "bad.toml"),
                    Contains("control character 0x01 after 'x'"));
  ImportSettings absent;
  absent.columns["radius"] = "Rx";
  CHECK_THROWS_WITH(opened(dump, absent)->load(0), Contains("no column 'Rx'") && Contains("radius, proc"));
}

TEST_CASE("Rows of id x y z: one frame, frames apart by empty lines or comments, times in comments",
          "[import]") {
  const auto one = opened("1 0 0 1\n2 0 0 2\n");
  CHECK(one->size() == 1);
  CHECK(one->load(0)->position[1] == Vec3(0, 0, 2));
  CHECK(mentions(*one, "id x y z"));
  const auto many = opened("# time = 0.5\n1 0 0 1\n2 0 0 2\n\n\n# time = 0.75\n1 0 0 3\n");
  REQUIRE(many->size() == 2);
  CHECK(many->time(0) == 0.5);
  CHECK(many->time(1) == 0.75);
  CHECK(many->load(1)->position[0] == Vec3(0, 0, 3));
  const auto yade = opened("#format x_y_z_r_matId\n0.5\t1\t2\t0.25\t0\n0.75\t1\t2\t0.5\t1\n");
  CHECK(yade->load(0)->scalar(quantity::radius) == std::vector<double>{0.25, 0.5});
  CHECK(yade->load(0)->scalar(quantity::species) == std::vector<double>{0, 1});
  const auto returned = opened("id x y z\n1 0 0 1\n2 0 0 2\n1 0 0 3\n2 0 0 4\n");
  REQUIRE(returned->size() == 2);
  CHECK(returned->load(1)->position[1] == Vec3(0, 0, 4));
}

TEST_CASE("NumPy: frames, grains, coordinates and an energy, double and big-endian float", "[import]") {
  const auto npy = [](const std::string& descr, const std::string& shape, const std::string& data) {
    std::string header = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" + shape + "), }";
    while ((10 + header.size() + 1) % 64 != 0)
      header += ' ';
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() % 256);
    bytes += static_cast<char>(header.size() / 256);
    return bytes + header + data;
  };
  std::string data;
  for (int k = 0; k < 2 * 3 * 4; ++k) {
    const double value = k + 0.5;
    data.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  ImportSettings settings;
  settings.frameInterval = 1e-3;
  const auto source = opened(npy("<f8", "2, 3, 4", data), settings);
  REQUIRE(source->size() == 2);
  CHECK(source->time(1) == 1e-3);
  CHECK(source->load(1)->position[2] == Vec3(20.5, 21.5, 22.5));
  CHECK(source->load(1)->scalar("energy")[2] == 23.5);
  CHECK(source->load(0)->persistentIds);
  const std::string one("\x3f\x80\x00\x00", 4), two("\x40\x00\x00\x00", 4);
  CHECK(opened(npy(">f4", "1, 3", one + two + one))->load(0)->position[0] == Vec3(1, 2, 1));
  const auto cut = opened(npy("<f8", "2, 3, 4", data.substr(0, data.size() - 8)));
  CHECK(cut->size() == 1);
  CHECK(mentions(*cut, "the file ends in frame 1 of the 2"));
}

TEST_CASE("gzip and zstd files read like the text inside, backwards too", "[import]") {
  std::string text;
  for (int k = 0; k < 50; ++k)
    text += dump;
  std::string packed(compressBound(text.size()) + 64, '\0');
  z_stream state{};
  deflateInit2(&state, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  state.next_in = reinterpret_cast<Bytef*>(text.data());
  state.avail_in = static_cast<uInt>(text.size());
  state.next_out = reinterpret_cast<Bytef*>(packed.data());
  state.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&state, Z_FINISH) == Z_STREAM_END);
  packed.resize(state.total_out);
  deflateEnd(&state);
  std::string zstd(ZSTD_compressBound(text.size()), '\0');
  zstd.resize(ZSTD_compress(zstd.data(), zstd.size(), text.data(), text.size(), 3));
  for (const std::string& bytes : {packed, packed + packed, zstd, zstd + zstd}) {
    const auto source = opened(bytes);
    CHECK(source->size() == (bytes == packed || bytes == zstd ? 100 : 200));
    CHECK(source->load(99)->size() == 1);
    CHECK(source->load(98)->size() == 2);
    CHECK(source->remarks().size() == 1); // no time
  }
  const auto cut = opened(packed.substr(0, packed.size() - 20));
  CHECK(cut->size() > 10);
  CHECK(mentions(*cut, "gzip file is damaged or was cut off"));
}

TEST_CASE("A sequence of files in the order of their numbers; settings that lie beside them", "[import]") {
  const TemporaryFolder folder("sequence");
  for (const int step : {200, 1000, 30})
    std::ofstream(folder / ("snap_" + std::to_string(step) + ".txt")) << "1 0 0 " << step << "\n2 1 1 1\n";
  std::ofstream(folder / "import.toml") << "[time]\nstep = 0.001\n[grains]\nradius = \"2 mm\"\n";
  const auto source = openFrames(folder / "snap_*.txt");
  while (!source->complete())
    source->refresh();
  REQUIRE(source->size() == 3);
  for (const auto& [index, step] : {std::pair{0, 30}, {1, 200}, {2, 1000}}) {
    CHECK(source->time(static_cast<std::size_t>(index)) == Approx(1e-3 * step));
    CHECK(source->load(static_cast<std::size_t>(index))->position[0].z() == step);
  }
  CHECK(source->load(0)->scalar(quantity::radius)[0] == 2e-3);
}

TEST_CASE("Walls beside the grains: a triangle mesh and a scene", "[import]") {
  const TemporaryFolder folder("walls");
  std::ofstream(folder / "floor.stl")
      << "solid f\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 "
         "0\nvertex 0 1000 0\nendloop\nendfacet\nendsolid f\n";
  std::ofstream(folder / "frames.dump") << dump;
  ImportSettings settings;
  settings.walls = {folder / "floor.stl",
                    std::string(SANDGLASS_SOURCE_DIR) + "/sample_runs/hopper_glass/scene.toml"};
  settings.wallUnit = 1e-3;
  const auto source = openFrames(folder / "frames.dump", &settings);
  const FramePtr frame = source->load(0);
  REQUIRE(frame->walls.size() >= 2);
  CHECK(frame->walls[0].name == "floor");
  CHECK(frame->walls[0].shape->bounds().max().x() == Approx(1));
  CHECK_FALSE(source->sceneText().empty());
}

TEST_CASE("A collection: times from it, parts of one time in one frame, files of any form", "[import]") {
  const TemporaryFolder folder("collection");
  std::ofstream(folder / "a.csv") << "x,y,z,radius\n0,0,0,1\n";
  std::ofstream(folder / "b.csv") << "x,y,z,radius,extra\n1,0,0,1,5\n2,0,0,1,5\n";
  std::ofstream(folder / "c.csv") << "radius,x,y,z\n0.5,3,0,0\n";
  std::ofstream(folder / "run.pvd") << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>\n"
                                       "<DataSet timestep=\"0.5\" part=\"0\" file=\"b.csv\"/>\n"
                                       "<DataSet timestep=\"0.5\" part=\"1\" file=\"c.csv\"/>\n"
                                       "<DataSet timestep=\"0.25\" part=\"0\" file=\"a.csv\"/>\n"
                                       "</Collection></VTKFile>\n";
  const auto source = openFrames(folder / "run.pvd");
  while (!source->complete())
    source->refresh();
  REQUIRE(source->size() == 2);
  CHECK(source->time(0) == 0.25);
  CHECK(source->time(1) == 0.5);
  const FramePtr frame = source->load(1);
  REQUIRE(frame->size() == 3);
  CHECK(frame->position[2] == Vec3(3, 0, 0));
  CHECK(frame->scalar(quantity::radius) == std::vector<double>{1, 1, 0.5});
  CHECK_FALSE(frame->has("extra")); // one part alone has it
  CHECK(source->load(0)->size() == 1);
}
