// Files with something wrong: one sentence with file and line or byte, the frames before kept, no crash. The
// table of docs/formats.md is what these cases say.

#include "sim/base/error.h"
#include "sim/io/import/reader_table.h"
#include "sim/io/run_folder.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

using namespace sandglass;

namespace {

struct BadFile {
  std::string what, name, bytes;
  std::size_t kept; ///< whole frames that can be read
};

std::string lammpsFrame(const std::string& step, const std::string& count, const std::string& rows) {
  return "ITEM: TIMESTEP\n" + step + "\nITEM: NUMBER OF ATOMS\n" + count +
         "\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\nITEM: ATOMS id type x y z radius\n" + rows;
}

std::string npy(const std::string& shape, std::size_t bytes) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }";
  while ((10 + header.size() + 1) % 64 != 0)
    header += ' ';
  header += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header +
         std::string(bytes, '\0');
}

/// One frame of two atoms with id x y z, as LAMMPS writes it into a .bin.
std::string binaryDump() {
  std::string bytes;
  const auto add = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  add(std::int64_t{-10});
  bytes += "DUMPCUSTOM";
  add(std::int32_t{1}); // order of bytes
  add(std::int32_t{2}); // revision
  add(std::int64_t{100});
  add(std::int64_t{2});
  for (const int word : {0, 1, 1, 1, 1, 1, 1}) // upright; open sides
    add(static_cast<std::int32_t>(word));
  for (const double bound : {0., 9., 0., 9., 0., 9.})
    add(bound);
  add(std::int32_t{4});
  add(std::int32_t{2});
  bytes += "si";
  add(char{0});
  add(std::int32_t{8});
  bytes += "id x y z";
  add(std::int32_t{1});
  add(std::int32_t{8});
  for (const double number : {1., 1., 1., 1., 2., 2., 2., 2.})
    add(number);
  return bytes;
}

std::string deep() {
  std::string text;
  for (int k = 0; k < 100000; ++k)
    text += "<a b='/>'>";
  return text;
}

std::vector<BadFile> badFiles() {
  const std::string good = lammpsFrame("0", "2", "1 1 1 1 1 0.5\n2 1 2 2 2 0.5\n");
  return {
      {"empty", "a.dump", "", 0},
      {"random bytes", "a.dump", std::string("\x7f\x45\x4c\x46\x02\x01\x00\x9c", 8), 0},
      {"no table", "notes.txt", "These are my notes.\nNothing else.\n", 0},
      {"UTF-16", "a.csv", std::string("\xff\xfe\x69\x00\x64\x00", 6), 0},
      {"lines end in carriage returns alone", "a.txt", "1 0 0 0\r2 1 1 1\r", 0},
      {"a mark of UTF-8 and mixed line ends: read", "a.txt",
       "\xef\xbb\xbf"
       "1 0 0 0\r\n2 1 1 1\n3 2 2 2\r\n",
       1},
      {"cut off in a row", "a.dump", good + lammpsFrame("1", "2", "1 1 1 1 1 0.5\n2 1 2 2"), 1},
      {"cut off in the header", "a.dump", good + "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n", 1},
      {"count too large", "a.dump", good + lammpsFrame("1", "3", "1 1 1 1 1 0.5\n2 1 2 2 2 0.5\n"), 1},
      {"count too large, another frame behind", "a.dump",
       lammpsFrame("1", "3", "1 1 1 1 1 0.5\n2 1 2 2 2 0.5\n") + good, 0},
      {"count too small", "a.dump", good + lammpsFrame("1", "1", "1 1 1 1 1 0.5\n2 1 2 2 2 0.5\n"), 1},
      {"giant count", "a.dump", good + lammpsFrame("1", "9007199254740000", "1 1 1 1 1 0.5\n"), 1},
      {"count that is no number", "a.dump", good + lammpsFrame("1", "many", "1 1 1 1 1 0.5\n"), 1},
      {"negative count", "a.dump", lammpsFrame("1", "-2", ""), 0},
      {"a position that is not a number", "a.dump", lammpsFrame("0", "1", "1 1 nan 1 1 0.5\n"), 1},
      {"garbage in a number", "a.dump", lammpsFrame("0", "2", "1 1 1 1 1 0.5\n2 1 1.2.3 1 1 0.5\n"), 1},
      {"bytes in a number", "a.dump",
       lammpsFrame("0", "2", std::string("1 1 1 1 1 0.5\n2 1 1\0\x01 1 1 0.5\n", 30)), 1},
      {"a value too few", "a.dump", lammpsFrame("0", "2", "1 1 1 1 1 0.5\n2 1 1 1 0.5\n"), 1},
      {"a value too many", "a.dump", lammpsFrame("0", "2", "1 1 1 1 1 0.5\n2 1 1 1 1 1 0.5\n"), 1},
      {"an id twice", "a.dump", lammpsFrame("0", "2", "1 1 1 1 1 0.5\n1 1 2 2 2 0.5\n"), 1},
      {"an id with a fraction", "a.dump", lammpsFrame("0", "1", "1.5 1 1 1 1 0.5\n"), 1},
      {"a radius of 0", "a.dump", lammpsFrame("0", "1", "1 1 1 1 1 0\n"), 1},
      {"a number out of range", "a.dump", lammpsFrame("0", "2", "1 1 1 1 1 0.5\n2 1 1e999 1 1 0.5\n"), 1},
      {"no positions", "a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\nITEM: ATOMS "
       "id "
       "vx vy\n1 0 0\n",
       1},
      {"a tilted box: read", "a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 9 1\n0 9 0\n0 9 "
       "0\nITEM: ATOMS id x y z\n1 0 0 0\n",
       1},
      {"a tilted box with open sides", "a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp ff pp\n0 9 1\n0 9 0\n0 9 "
       "0\nITEM: ATOMS id x y z\n1 0 0 0\n",
       1},
      {"a box of three general vectors", "a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS abc origin pp pp pp\n9 0 0 0\n0 9 0 "
       "0\n0 "
       "0 9 0\nITEM: ATOMS id x y z\n1 0 0 0\n",
       0},
      {"a box upside down", "a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n9 0\n0 9\n0 9\nITEM: ATOMS "
       "id x "
       "y z\n1 0 0 0\n",
       0},
      {"a dump of contacts", "a.dump",
       "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: ENTRIES c_1[1]\n1\n", 0},
      {"XYZ, cut off", "a.xyz", "2\n\nA 0 0 0\nA 1 1 1\n2\n\nA 0 0 0\n", 1},
      {"XYZ, count too small", "a.xyz", "1\n\nA 0 0 0\nA 1 1 1\n", 0},
      {"XYZ, properties nobody can count", "a.xyz", "1\nProperties=species:S:1:pos:R\nA 0 0 0\n", 1},
      {"XYZ, a lattice of 8 numbers", "a.xyz", "1\nLattice=\"1 0 0 0 1 0 0 0\"\nA 0 0 0\n", 1},
      {"CSV, a cell too few", "a.csv", "id,x,y,z\n1,0,0,0\n2,1,1\n", 1},
      {"CSV, a word among numbers", "a.csv", "id,x,y,z\n1,0,0,0\n2,one,1,1\n", 1},
      {"CSV, an empty position", "a.csv", "id,x,y,z\n1,0,,0\n", 1},
      {"CSV, a time that is no number", "a.csv", "time,id,x,y,z\n0,1,0,0,0\nnoon,1,0,0,0\n", 1},
      {"NumPy, cut off", "a.npy", npy("3, 2, 4", 2 * 64 + 20), 2},
      {"NumPy, giant shape", "a.npy", npy("1, 4000000000, 4", 64), 0},
      {"NumPy, a shape of two columns", "a.npy", npy("5, 2", 80), 0},
      {"NumPy, header cut off", "a.npy", std::string("\x93NUMPY\x01\x00\xff\x7f", 10), 0},
      {"binary LAMMPS dump, cut off", "a.bin", binaryDump().substr(0, 150), 0},
      {"binary LAMMPS dump, giant count", "a.bin",
       binaryDump().replace(34, 8, std::string("\0\0\0\0\0\0\0\x01", 8)), 0},
      {"binary LAMMPS dump of before 2020", "a.bin", binaryDump().substr(26), 0},
      {"VTKHDF inside gzip", "a.vtkhdf", "\x89HDF\r\n\x1a\n", 0},
      {"VTK, several blocks", "a.vtm", "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\">", 0},
      {"PVD, no XML", "a.pvd", "<VTKFile type=\"Collection\">\n<Collection>\n<DataSet", 0},
      {"PVD, elements in elements without end", "a.pvd", "<VTKFile type=\"Collection\">" + deep(), 0},
      {"PVD, a file that is not there", "a.pvd",
       "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"1\" "
       "file=\"gone.vtp\"/></Collection></VTKFile>",
       0},
      {"PVD, a time that is no number", "a.pvd",
       "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"noon\" "
       "file=\"a.vtp\"/></Collection></VTKFile>",
       0},
      {"gzip, damaged", "a.dump.gz",
       std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\xff\xff\xff\xff", 14), 0},
      {"zstd, cut off", "a.dump.zst", std::string("\x28\xb5\x2f\xfd\x04\x58", 6), 0},
  };
}

/// What is said of a file: when it is opened, of later frames, and when its frames are read.
std::pair<std::string, std::size_t> saidOf(const BadFile& file) {
  try {
    constexpr std::uint64_t unpacked = 1 << 20;
    const auto source = openForeign(std::make_shared<const ImportFile>(file.name, file.bytes, unpacked), {});
    while (!source->complete())
      source->refresh();
    std::string said;
    for (std::size_t k = 0; k < source->size(); ++k)
      try {
        source->load(k);
      } catch (const InputError& e) {
        said = e.what();
      }
    for (const auto& remark : source->remarks())
      if (remark.find(" kept") != std::string::npos) said = remark;
    return {said.empty() ? "read" : said, source->size()};
  } catch (const InputError& e) {
    return {e.what(), 0};
  }
}

std::string tableOfBadFiles() {
  std::string table = "| file with | frames found | what is said |\n|---|---|---|\n";
  for (const auto& file : badFiles()) {
    auto [said, kept] = saidOf(file);
    for (std::size_t at = 0; (at = said.find('|', at)) != std::string::npos; at += 2)
      said.insert(at, "\\");
    table += "| " + file.what + " | " + std::to_string(kept) + " | " + said + " |\n";
  }
  return table;
}

} // namespace

TEST_CASE("Every bad file says what is wrong in one sentence with its place and keeps the frames before",
          "[import][bad]") {
  for (const auto& file : badFiles()) {
    const auto [said, kept] = saidOf(file);
    INFO(file.what << ": " << said);
    CHECK(kept == file.kept);
    CHECK(said.find('\n') == std::string::npos);
    if (said == "read") {
      CHECK(file.what.ends_with(": read"));
      continue;
    }
    // "a.dump:12: ...", "a.npy: byte 9: ...", "a.dump: frame 0: ..."
    REQUIRE(said.starts_with(file.name + ":"));
    const std::string place = said.substr(file.name.size() + 1, 9);
    const bool line = place[0] >= '0' && place[0] <= '9';
    CHECK((line || place.starts_with(" byte ") || place.starts_with(" frame ") ||
           place.starts_with(" entry ")));
  }
}

TEST_CASE("docs/formats.md has the sentences of the bad files", "[import][bad]") {
  std::ifstream in(std::string(SANDGLASS_SOURCE_DIR) + "/docs/formats.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::string table = tableOfBadFiles();
  INFO("the table is:\n" << table);
  CHECK(page.find(table) != std::string::npos);
}

TEST_CASE("Print the table of bad files for docs/formats.md", "[.table]") {
  std::fputs(tableOfBadFiles().c_str(), stdout);
}

TEST_CASE("A count of rows that are not there costs no memory", "[import][bad]") {
  // 10^8 rows of 100 columns would be 80 GB; what is promised but not there must not be reserved.
  std::string names, row;
  for (int c = 0; c < 8; ++c)
    names += " c" + std::to_string(c);
  const std::string bytes =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n90000000\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 "
      "1\n0 1\nITEM: ATOMS id x y z" +
      names + "\n1 0 0 0 0 0 0 0 0 0 0 0\n";
  CHECK_THROWS_WITH(openForeign(std::make_shared<const ImportFile>("a.dump", bytes, 1 << 20), {}),
                    Catch::Contains("a.dump:10:") && Catch::Contains("after row 1 of the 90000000"));
}
