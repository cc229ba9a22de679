#pragma once
// What `sandglass sweep` does with its arguments.

#include <filesystem>
#include <string>
#include <vector>

namespace sandglass::cli {

struct SweepArguments {
  std::string source; ///< SWEEP.toml or its folder, or the folder of a sweep that is there
  std::string folder; ///< -o
  int threads = 0;
  bool overwrite = false, dryRun = false, table = false, gather = false;
  int recompute = 0, replicate = 1; ///< point and which of its seeds
  int slurm = 0;                    ///< jobs of an array
  std::string share;                ///< "K/N"
  std::vector<std::string> plot;    ///< x=.., y=.., colour=..
};

/// Returns the exit code. Throws InputError.
int sweep(const SweepArguments& arguments);

} // namespace sandglass::cli
