// series.csv: what is written is read back bit for bit.

#include "sim/base/error.h"
#include "sim/io/series.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;
using Catch::Contains;

namespace {

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("A series goes on where a checkpoint left it", "[io]") {
  const TemporaryFolder folder("series");
  const auto file = folder / "series.csv";
  std::uint64_t length = 0;
  {
    SeriesWriter writer(file, {"e.total", "m.mass"}, 0);
    writer.row(0, 0, {{"e.total", 0.1}, {"m.mass", 2}});
    writer.row(0.1, 10, {{"e.total", 1.0 / 3}});
    length = writer.sync();
    writer.row(0.2, 20, {{"e.total", 99}}); // after the checkpoint: to be lost
  }
  {
    SeriesWriter writer(file, {"e.total", "m.mass"}, length);
    writer.row(0.2, 20, {{"m.mass", 1e-300}});
  }
  CHECK(contentOf(file) ==
        "time,step,e.total,m.mass\n0,0,0.1,2\n0.1,10,0.3333333333333333,\n0.2,20,,1e-300\n");
  const auto series = readSeries(file);
  CHECK(series.at("e.total").time == std::vector<double>{0, 0.1});
  CHECK(series.at("e.total").value == std::vector<double>{0.1, 1.0 / 3});
  CHECK(series.at("m.mass").time == std::vector<double>{0, 0.2});
  CHECK(series.at("m.mass").value == std::vector<double>{2, 1e-300});
  CHECK_THROWS_WITH(SeriesWriter(file, {"e.total"}, 10'000), Contains("shorter than the checkpoint says"));
}

TEST_CASE("A series cut by a kill loses its last line, a wrong one names file and line", "[io]") {
  const TemporaryFolder folder("series-torn");
  const auto put = [&](const std::string& content) {
    std::ofstream(folder / "s.csv", std::ios::binary) << content;
    return folder / "s.csv";
  };
  CHECK(readSeries(put("time,step,a\n0,0,5\n1,1,3.14")).at("a").value == std::vector<double>{5});
  CHECK_THROWS_WITH(readSeries(put("time,step,a\n0,0,5\n1,1\n")), Contains("s.csv:3: the line has 2 cells"));
  CHECK_THROWS_WITH(readSeries(put("time,step,a\n0,0,five\n")),
                    Contains("s.csv:2: 'five' in the column 'a'"));
  CHECK_THROWS_WITH(readSeries(put("x,y\n1,2\n")), Contains("a series begins with"));
}
