// What the window costs a run and whether it stays awake: the same dense beds headless and in a window with
// three live panels, in turns on one machine. Two threads. Needs no display. Bytes are the most that the
// process held, with program, window and pictures. Exit code 1 when the best of the turns is beyond the
// limits below.
//
// bench_desktop [--csv FILE] [--grains 20000,100000] [--turns N]

#include "tests/app/desktop_measure.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace sandglass;
using namespace sandglass::test;

namespace {

constexpr int threads = 2;
constexpr double longestStall = 0.1, fewestPictures = 2, leastShare = 0.7; ///< [s], [1/s], of headless speed

struct Output {
  std::ofstream file;
  void row(const std::string& testCase, std::size_t grains, const Turn& turn, const std::string& check) {
    const std::string text =
        fmt::format("{},sandglass,{},double,{},{:.0f},,{:.3f},,{:.0f},{}\n", testCase, threads, grains,
                    turn.steps, turn.seconds, turn.memory / static_cast<double>(grains), check);
    fmt::print("{}", text);
    std::fflush(stdout);
    if (file.is_open()) file << text << std::flush;
  }
};

/// Whether the best of the turns is within the limits: each quantity by itself, since others use the machine.
bool measure(Output& out, std::size_t grains, int turns) {
  const TemporaryFolder folder("bench-desktop");
  const int side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(grains))));
  // Some ten seconds at ten million grain-steps a second; steps are about 20 us.
  const double duration = 6e7 / static_cast<double>(grains) * 4e-5;
  const auto scene = writeBed(folder / "bed.toml", side, side, duration);
  const std::size_t exact = static_cast<std::size_t>(side) * side * side;
  double stall = 1e9, pictures = 0, share = 0;
  for (int k = 1; k <= turns; ++k) {
    const Turn alone = headlessTurn(scene, folder / fmt::format("headless{}", k), threads);
    out.row(fmt::format("headless_{}", k), exact, alone,
            fmt::format("{:.2f} million grain-steps/s", alone.speed / 1e6));
    const Turn with = windowTurn(scene, folder / fmt::format("window{}", k), threads);
    out.row(fmt::format("window_{}", k), exact, with,
            fmt::format("{:.0f} % of headless; {:.1f} pictures/s; longest stall {:.1f} ms",
                        100 * with.speed / alone.speed, with.pictures, 1e3 * with.stall));
    stall = std::min(stall, with.stall);
    pictures = std::max(pictures, with.pictures);
    share = std::max(share, with.speed / alone.speed);
  }
  const bool good = stall < longestStall && pictures >= fewestPictures && share >= leastShare;
  if (!good)
    fmt::print(stderr,
               "{} grains: the best turn has a stall of {:.0f} ms (limit {:.0f}), {:.1f} pictures a second "
               "({:.0f} are due) and {:.0f} % of the headless speed ({:.0f} % are due)\n",
               exact, 1e3 * stall, 1e3 * longestStall, pictures, fewestPictures, 100 * share,
               100 * leastShare);
  return good;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"What the window costs a run."};
  std::string csv;
  std::vector<std::size_t> grains{20'000, 100'000};
  int turns = 3;
  app.add_option("--csv", csv, "also write the rows here");
  app.add_option("--grains", grains, "sizes of the beds")->delimiter(',');
  app.add_option("--turns", turns, "headless and window by turns");
  CLI11_PARSE(app, argc, argv);
  Output out;
  const char* const header = "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,"
                             "bytes_per_grain,check\n";
  if (!csv.empty()) out.file.open(csv);
  fmt::print("{}", header);
  if (out.file.is_open()) out.file << header;
  application();
  bool good = true;
  for (const auto n : grains)
    good = measure(out, n, turns) && good;
  return good ? 0 : 1;
}
