// Speed of reading files of other programs: rows of
//   case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,check
// A step is a frame. The file is a LAMMPS text dump of 10^6 atoms a frame as LAMMPS prints them (six digits,
// id type x y z vx vy vz radius), 12 frames; with --gigabytes N more of them. `open` is what passes until the
// first frame is known, `index` the walk through the whole file, `read` a frame with all its columns. check:
// MB/s of processor time for index and read, seconds for open; the largest memory of the process in MB behind
// it.

#include "sim/io/import/reader_table.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>

#include <sys/resource.h>

using namespace sandglass;

namespace {

constexpr std::size_t grains = 1'000'000;

void writeDump(const std::filesystem::path& file, std::size_t frames) {
  std::FILE* out = std::fopen(file.c_str(), "w");
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(0, 0.2);
  std::string rows;
  for (std::size_t k = 0; k < grains; ++k)
    fmt::format_to(std::back_inserter(rows), "{} 1 {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} 0.0005\n", k + 1,
                   place(random), place(random), place(random), place(random) - 0.1, place(random) - 0.1,
                   place(random) - 0.1);
  for (std::size_t f = 0; f < frames; ++f) {
    const std::string head =
        fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp "
                    "ff\n0 0.2\n0 0.2\n0 0.2\nITEM: ATOMS id type x y z vx vy vz radius\n",
                    1000 * f, grains);
    std::fwrite(head.data(), 1, head.size(), out);
    std::fwrite(rows.data(), 1, rows.size(), out);
  }
  std::fclose(out);
}

struct Clock {
  std::clock_t cpu = std::clock();
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double cpuSeconds() const { return static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC; }
  double wallSeconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  }
};

double memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e3;
}

} // namespace

int main(int argc, char** argv) {
  std::ofstream csv;
  std::size_t frames = 12;
  for (int k = 1; k + 1 < argc; ++k) {
    if (std::strcmp(argv[k], "--csv") == 0) csv.open(argv[k + 1]);
    if (std::strcmp(argv[k], "--gigabytes") == 0)
      frames = static_cast<std::size_t>(13 * std::stod(argv[k + 1]));
  }
  std::ostream& out = csv.is_open() ? csv : std::cout;
  const auto file = std::filesystem::temp_directory_path() / fmt::format("bench_io_{}.dump", ::getpid());
  writeDump(file, frames);
  const double bytes = static_cast<double>(std::filesystem::file_size(file));
  out << "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,"
         "check\n";
  const auto row = [&](const char* name, std::size_t steps, const Clock& clock, const std::string& check) {
    const double cpu = clock.cpuSeconds();
    out << fmt::format("{},sandglass,1,double,{},{},{:.4f},{:.4f},{:.4g},{:.1f},{}\n", name, grains, steps,
                       cpu, clock.wallSeconds(), static_cast<double>(grains * steps) / cpu,
                       bytes / static_cast<double>(frames * grains), check);
  };
  {
    const Clock opening;
    const auto source = openForeign(std::make_shared<const ImportFile>(file), {});
    row("dump_open", 1, opening, fmt::format("{:.3f} s; {:.0f} MB", opening.wallSeconds(), memory()));
    const Clock walking;
    while (!source->complete())
      source->refresh();
    const double rest = bytes * static_cast<double>(frames - 1) / static_cast<double>(frames);
    row("dump_index", frames - 1, walking,
        fmt::format("{:.0f} MB/s; {:.0f} MB", rest / 1e6 / walking.cpuSeconds(), memory()));
    source->load(0);
    const std::size_t read = std::min<std::size_t>(4, frames);
    const Clock reading;
    for (std::size_t k = 0; k < read; ++k)
      source->load(k);
    row("dump_read", read, reading,
        fmt::format("{:.0f} MB/s; {:.0f} MB",
                    bytes * static_cast<double>(read) / static_cast<double>(frames) / 1e6 /
                        reading.cpuSeconds(),
                    memory()));
  }
  std::filesystem::remove(file);
}
