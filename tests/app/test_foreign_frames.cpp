// What LAMMPS, LIGGGHTS and Yade wrote (tests/data), through the program as a user calls it. The numbers come
// from the decks and from the files themselves.

#include "sim/io/import/column_names.h"
#include "sim/io/import/reader_table.h"
#include "sim/io/run_folder.h"
#include "vis/readers/child_reader.h"
#include "vis/readers/vtk_frame.h"

#include "tests/app/program.h"

#include <catch2/catch.hpp>

#include <string>

using namespace sandglass;

namespace {

const std::string data = std::string(SANDGLASS_SOURCE_DIR) + "/tests/data/";

std::unique_ptr<FrameSource> opened(const std::string& file, const ImportSettings& settings = {}) {
  auto source = openFrames(data + file, &settings);
  while (!source->complete())
    source->refresh();
  return source;
}

} // namespace

TEST_CASE("LAMMPS: a poured packing as custom dump, as scaled dump in gzip and as XYZ is one packing",
          "[foreign]") {
  const auto custom = opened("lammps/pour.dump"), scaled = opened("lammps/pour_atom.dump.gz"),
             xyz = opened("lammps/pour.xyz");
  REQUIRE(custom->size() == 4);
  REQUIRE(scaled->size() == 4);
  REQUIRE(xyz->size() == 4);
  CHECK(custom->time(3) == Approx(9000 * 2e-5));
  CHECK(custom->load(0)->size() == 0);
  const FramePtr a = custom->load(3), b = scaled->load(3), c = xyz->load(3);
  REQUIRE(a->size() == 100);
  REQUIRE(c->size() == 100);
  CHECK(a->id == b->id);
  for (std::size_t k = 0; k < a->size(); ++k)
    CHECK((a->position[k] - b->position[k]).norm() < 1e-6); // six digits each, of up to 80 mm
  int small = 0;
  for (std::size_t k = 0; k < a->size(); ++k) {
    const double r = a->scalar(quantity::radius)[k];
    small += r == 0.001;
    // pi/6 d^3 2500 kg/m^3, six digits
    CHECK(a->scalar(quantity::mass)[k] ==
          Approx(2500 * 4.0 / 3 * 3.14159265358979 * r * r * r).epsilon(1e-5));
    CHECK(a->position[k].head<2>().norm() < 0.01);
  }
  CHECK(small == 60);
  CHECK(a->has(quantity::spin));
  CHECK(a->has(quantity::force));
}

TEST_CASE("LAMMPS: ellipsoids whose columns the settings beside the file name", "[foreign]") {
  const FramePtr frame = openFrames(data + "lammps/ellipsoids.dump")->load(0);
  REQUIRE(frame->size() == 4);
  REQUIRE(frame->shapes.size() == 1); // the second type is a sphere
  CHECK(frame->shapes[0].semiAxes.isApprox(Vec3(0.001, 0.002, 0.003)));
  CHECK(frame->scalar(quantity::shape) == std::vector<double>{0, 0, -1, -1});
  CHECK(frame->scalar(quantity::radius)[2] == Approx(0.0015));
  // Turned by 90 degrees about z: the middle axis of 2 mm points along -x.
  CHECK((frame->orientation[1] * Vec3::UnitY()).isApprox(-Vec3::UnitX(), 1e-5));
}

TEST_CASE("LAMMPS: a sheared packing in a tilted box is the same as text and as binary dumps", "[foreign]") {
  const auto text = opened("lammps/shear.dump.gz"), binary = opened("lammps/shear.bin"),
             scaled = opened("lammps/shear_atom.bin");
  REQUIRE(text->size() == 3);
  REQUIRE(binary->size() == 3);
  REQUIRE(scaled->size() == 3);
  for (std::size_t f = 0; f < 3; ++f) {
    const FramePtr a = text->load(f), b = binary->load(f), c = scaled->load(f);
    REQUIRE(a->size() == 50);
    CHECK(a->time == Approx(1e-5 * static_cast<double>(a->step)).margin(1e-12)); // the deck's step
    CHECK(a->step == b->step);
    CHECK(a->time == b->time);
    CHECK(a->id == b->id);
    CHECK(a->id == c->id);
    CHECK(a->domain.periodic == b->domain.periodic);
    CHECK(a->domain.periodic == c->domain.periodic);
    CHECK(a->scalar(quantity::radius) == b->scalar(quantity::radius)); // seventeen digits
    CHECK(a->vector(quantity::velocity) == b->vector(quantity::velocity));
    for (std::size_t k = 0; k < 50; ++k) {
      CHECK((a->position[k] - b->position[k]).norm() < 1e-15);
      Vec3 apart = a->position[k] - c->position[k]; // LAMMPS wraps them one by one
      for (int d = 0; d < 3; ++d)
        if (a->domain.periodic[static_cast<std::size_t>(d)]) {
          const double period = a->domain.upper[d] - a->domain.lower[d];
          apart[d] -= period * std::round(apart[d] / period);
        }
      CHECK(apart.norm() < 1e-15);
    }
  }
  // The deck: fix deform xy erate 5 (0.0004 a step of 1e-5 s and box of 8 mm), xz and yz to final tilts.
  CHECK(text->load(2)->domain.periodic == std::array<bool, 3>{true, false, false});
  CHECK(text->load(0)->domain.periodic == std::array<bool, 3>{true, true, true});
}

TEST_CASE("VTKHDF that h5py wrote: a grid of two parts, poly data in steps", "[foreign]") {
  const auto grid = opened("vtk/grid.vtkhdf");
  REQUIRE(grid->size() == 1);
  CHECK(grid->time(0) == 0.25);
  const FramePtr frame = grid->load(0);
  REQUIRE(frame->size() == 9);
  CHECK(frame->id.front() == 100);
  // make_files.py: x = 0.001 k, y = 0.002 (k mod 3), z = 0.01, in single precision
  CHECK((frame->position[4] - Vec3(0.004, 0.002, 0.01)).norm() < 1e-9);
  CHECK(frame->vector(quantity::velocity)[4] == Vec3(4, 0, -4));
  CHECK_FALSE(frame->has("stress"));

  const auto steps = opened("vtk/steps.vtkhdf");
  REQUIRE(steps->size() == 3);
  CHECK(steps->time(2) == 1.5);
  const FramePtr first = steps->load(0), last = steps->load(2), middle = steps->load(1);
  CHECK(first->size() == 4);
  CHECK(middle->size() == 6);
  REQUIRE(last->size() == 5);
  CHECK(last->position[1].isApprox(Vec3(0.001, 0.003, 0.008)));
  CHECK(last->vector(quantity::velocity)[4] == Vec3(0, 0, -2));
  CHECK(middle->vector(quantity::velocity)[0] == Vec3(0, 0, -1));
  // Stored once for all steps.
  CHECK(last->scalar(quantity::radius)[4] == Approx(0.0007));
  CHECK(first->scalar(quantity::radius)[0] == last->scalar(quantity::radius)[0]);
}

TEST_CASE("Two dumps of LAMMPS beside each other, grain by grain and as distributions", "[foreign]") {
  const std::string pair = "compare " + data + "lammps/pour.dump " + data +
                           "lammps/pour_atom.dump.gz --time-step \"2e-5 s\" --radius \"1 mm\"";
  // One run in two forms: four frames at common times, positions to the six digits of the text.
  const auto same = test::program(pair + " --tolerance 1e-6 --probability 0.01");
  INFO(same.text);
  CHECK(same.text.find("4 frames") != std::string::npos);
  CHECK(same.code == 1); // grains of 1 mm and 1.5 mm in one, all of 1 mm in the other
  CHECK(same.text.find("a distribution differs") != std::string::npos);
  CHECK(test::program(pair + " --tolerance 1e-6").code == 0);
  CHECK(test::program(pair + " --tolerance 0").code == 1);
  // The pour against the sheared packing: other grains, other places, no common time but the first.
  const auto other = test::program("compare " + data + "lammps/pour.dump " + data +
                                   "lammps/shear.dump.gz --probability 0.01");
  CHECK(other.code == 1);
}

TEST_CASE("A collection of VTK files through the program", "[foreign]") {
  const auto [code, said] = test::program("info " + data + "vtk/run.pvd");
  INFO(said);
  CHECK(code == 0);
  CHECK(said.find("2 frames from 0 to 0.125 s") != std::string::npos);
  CHECK(said.find("grains of the last frame: 3") != std::string::npos);
}

TEST_CASE("LIGGGHTS: the dump of a hopper with its walls; the same frame as legacy VTK and VTU",
          "[foreign]") {
  ImportSettings settings;
  settings.timeStep = 1e-5;
  settings.walls = {data + "liggghts/funnel.toml"};
  const auto source = opened("liggghts/hopper.dump.gz", settings);
  REQUIRE(source->size() == 36);
  CHECK(source->time(15) == Approx(0.15));
  const FramePtr full = source->load(14), empty = source->load(35);
  CHECK(full->size() == 250);
  CHECK(empty->size() == 153); // the last rows of the file
  CHECK(full->scalar(quantity::radius)[0] == Approx(0.0012));
  REQUIRE(full->walls.size() == 2);
  CHECK(full->walls[1].active);
  CHECK_FALSE(empty->walls[1].active); // the gate
  // No grain overlaps the funnel by more than a few per cent: 24 flat sides lie inside the cone by less than
  // 1 %.
  for (const auto& x : full->position)
    CHECK(full->walls[0].shape->signedDistance(x) > 0.0012 * 0.85);

  const RawFrame legacy = vis::readVtkApart(data + "liggghts/post_10000.vtk", {}, SANDGLASS_PROGRAM),
                 xml = vis::readVtkApart(data + "liggghts/post_10000.vtu", {}, SANDGLASS_PROGRAM);
  CHECK(legacy.rows == 250);
  CHECK(xml.rows == 250);
  REQUIRE(legacy.columns.size() == xml.columns.size());
  for (std::size_t k = 0; k < 250; ++k)
    CHECK(legacy.columns[2].numbers[k] ==
          Approx(xml.columns[2].numbers[k]).margin(1e-8)); // float, six digits
}

TEST_CASE("Yade: its text and its VTU are one pile", "[foreign]") {
  const FramePtr text = opened("yade/pile.txt")->load(0);
  const RawFrame vtu = vis::readVtkApart(data + "yade/pile_spheres.4000.vtu", {}, SANDGLASS_PROGRAM);
  REQUIRE(text->size() == vtu.rows);
  for (std::size_t k = 0; k < vtu.rows; ++k)
    CHECK(text->position[k].z() == Approx(vtu.columns[2].numbers[k]).margin(1e-7));
  bool radii = false, velocity = false;
  for (const auto& column : vtu.columns) {
    radii = radii || quantityOfColumn(column.name, {}) == quantity::radius;
    velocity = velocity || quantityOfColumn(column.name, {}) == "velocity.z";
  }
  CHECK(radii);
  CHECK(velocity);
}

TEST_CASE("Layouts of earlier studies: ITEM: snapshots of 2007, a NumPy array of 2012", "[foreign]") {
  const auto snapshots = opened("layouts/snapshots_2007.txt");
  REQUIRE(snapshots->size() == 3);
  CHECK(snapshots->load(2)->step == 40000);
  CHECK(snapshots->load(2)->position[11] == Vec3(0.5, 0.5, 3));
  CHECK(snapshots->load(2)->scalar(quantity::radius)[0] == 0.5);
  ImportSettings settings;
  settings.frameInterval = 1e-3;
  settings.radius = 2e-3;
  const auto vortex = opened("layouts/dump_r002.00_p2500.00_f050.0.npy", settings);
  REQUIRE(vortex->size() == 5);
  CHECK(vortex->time(4) == Approx(4e-3));
  CHECK(vortex->load(4)->position[0].head<2>().norm() == Approx(0.05));
  CHECK(vortex->load(4)->scalar("energy")[7] == Approx(7e-6));
  CHECK(vortex->load(0)->persistentIds);
}

TEST_CASE("A VTK file that is cut off, and one that is a mesh, are refused with a sentence", "[foreign]") {
  CHECK_THROWS_WITH(vis::readVtkApart(data + "liggghts/funnel.stl", {}, SANDGLASS_PROGRAM),
                    Catch::Contains("funnel.stl: "));
}
