// Files that other people's libraries read, VTK in a process of its own and HDF5 in this one, damaged at
// random from a seed: each must be read or refused with an InputError, and nothing else.
//
//   fuzz_apart PROGRAM DATA-FOLDER COUNT [SECONDS [EARLIER]]
//
// COUNT damaged files of each kind, or as many as SECONDS of processor time hold, children included. EARLIER
// executions are behind: the seeds go on from there. HDF5 files are read in a fork of this program, so that a
// crash is counted and not suffered. Prints the executions; exits 1 when there was a fault.

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/io/run_folder.h"
#include "vis/readers/child_reader.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using namespace sandglass;
namespace fs = std::filesystem;

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t below(RandomStream& random, std::size_t n) {
  return std::min(n - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(n)));
}

/// One to eight faults: bits turned, bytes and numbers replaced, pieces lost, doubled or moved, the end cut
/// off.
std::string damaged(std::string bytes, RandomStream& random) {
  static const std::vector<std::string> words{"-1", "99999999999999",  "nan", "0", "1e999", "",
                                              "<",  "\xff\xff\xff\xff"};
  const std::size_t faults = 1 + below(random, 8);
  for (std::size_t k = 0; k < faults && !bytes.empty(); ++k) {
    const std::size_t at = below(random, bytes.size()),
                      length = 1 + below(random, std::min<std::size_t>(64, bytes.size() - at));
    switch (below(random, 6)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(random, 8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(below(random, 256));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(below(random, bytes.size()), bytes.substr(at, length));
      break;
    case 4:
      bytes.replace(at, std::min<std::size_t>(length, 4), words[below(random, words.size())]);
      break;
    default:
      if (below(random, 4) == 0) bytes.resize(at);
    }
  }
  return bytes;
}

/// Processor time of this program and its children, in seconds.
double processorTime() {
  double seconds = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(who, &used);
    for (const timeval& t : {used.ru_utime, used.ru_stime})
      seconds += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  }
  return seconds;
}

/// Reads all in a fork; whether it ended as a program that has its errors in hand.
bool readInFork(const fs::path& file) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    const rlimit seconds{20, 20}, memory{std::size_t{4} << 30, std::size_t{4} << 30};
    ::setrlimit(RLIMIT_CPU, &seconds);
    ::setrlimit(RLIMIT_AS, &memory);
    try {
      const auto source = openFrames(file);
      for (std::size_t k = 0; k < 8; ++k) {
        source->refresh();
        if (k < source->size()) source->load(k);
      }
    } catch (const InputError&) { // refused, as it should
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: fuzz_apart PROGRAM DATA-FOLDER COUNT [SECONDS [EARLIER]]\n");
    return 2;
  }
  const fs::path program = argv[1], data = argv[2];
  const std::size_t count = std::stoul(argv[3]);
  const double seconds = argc > 4 ? std::stod(argv[4]) : 0;
  const fs::path folder = fs::temp_directory_path() / fmt::format("sandglass-apart-{}", ::getpid());
  fs::create_directories(folder);
  std::size_t executions = 0, faults = 0, refused = 0;
  const std::vector<fs::path> seeds{data / "liggghts/post_10000.vtk",
                                    data / "liggghts/post_10000.vtu",
                                    data / "yade/pile_spheres.4000.vtu",
                                    data / "vtk/b0.vtk",
                                    data / "vtk/grid.vtkhdf",
                                    data / "vtk/steps.vtkhdf"};
  const auto more = [&](std::size_t round) {
    return seconds > 0 ? processorTime() < seconds : round < count;
  };
  const std::size_t earlier = argc > 5 ? std::stoul(argv[5]) / seeds.size() : 0; // rounds
  for (std::size_t round = 0; more(round); ++round)
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      RandomStream random(4711, RandomPurpose::test,
                          static_cast<std::int64_t>((earlier + round) * seeds.size() + s));
      const fs::path file = folder / ("damaged" + seeds[s].extension().string());
      std::ofstream(file, std::ios::binary) << damaged(bytesOf(seeds[s]), random);
      bool good = true;
      if (file.extension() == ".vtkhdf")
        good = readInFork(file);
      else
        try {
          vis::readVtkApart(file, {}, program);
        } catch (const InputError&) {
          ++refused;
        } catch (const std::exception& e) {
          fmt::print("{}\n", e.what());
          good = false;
        }
      ++executions;
      if (good) continue;
      ++faults;
      const fs::path kept = fmt::format("fault-{}-{}{}", earlier + round, s, file.extension().string());
      fs::copy_file(file, kept, fs::copy_options::overwrite_existing);
      fmt::print("fault: {}\n", kept.string());
    }
  fs::remove_all(folder);
  fmt::print("executions {}\nrefused by VTK {}\nfaults {}\n", executions, refused, faults);
  return faults == 0 ? 0 : 1;
}
