#pragma once
// sandglass run --replicates N: the same scene over N seeds, several runs at once, and what they have in
// common.

#include "sim/run/run.h"
#include "sim/scene/scene.h"

#include <filesystem>

namespace sandglass::cli {

struct ReplicateOptions {
  int count = 1;                ///< seeds: the scene's, the next, ...
  std::filesystem::path folder; ///< runs go into seed_<k>/, results beside them
  int threads = 0;              ///< of all runs together; 0: all cores
  bool overwrite = false;       ///< else runs that are there go on, and finished ones are left as they are
};

/// Returns the exit code: 0 when all runs are finished, else 1. Results are of the finished ones. Throws
/// InputError when the scene or a folder is wrong.
int runReplicates(const Scene& scene, const ReplicateOptions& options);

} // namespace sandglass::cli
