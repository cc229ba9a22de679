#include "sim/run/branch.h"

#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/run_folder.h"
#include "sim/io/segment_names.h"
#include "sim/run/checkpoint_store.h"
#include "sim/run/run_recorder.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass {

namespace fs = std::filesystem;

namespace {

/// Closed segments and checkpoints are never written to again, so that two runs may share one file.
void share(const fs::path& from, const fs::path& to) {
  std::error_code unable;
  fs::create_hard_link(from, to, unable);
  if (unable) fs::copy_file(from, to);
}

} // namespace

Branch branchRun(const fs::path& source, std::int64_t step, const fs::path& target) {
  if (!fs::exists(source / "scene.toml"))
    throw InputError(
        fmt::format("{}: a branch needs the scene of the run, and there is no scene.toml", source.string()));
  if (fs::exists(target))
    throw InputError(fmt::format("{}: the folder of the branch exists already", target.string()));
  Branch branch;
  branch.step = step;
  branch.scene = readScene((source / "scene.toml").string());
  // A checkpoint of the very step may hold events of that step, which the branch is not to have.
  const bool eventsHere =
      std::erase_if(branch.scene.events, [&](const EventSpec& event) { return event.step >= step; }) > 0;
  auto checkpoints = checkpointFiles(source);
  std::erase_if(checkpoints, [&](const fs::path& file) {
    return checkpointStep(file) > step || (checkpointStep(file) == step && eventsHere && step > 0);
  });
  if (checkpoints.empty())
    throw InputError(
        fmt::format("{}: there is no checkpoint at or before step {}, from which a branch could be "
                    "computed; branch from a later frame",
                    source.string(), step));
  branch.from = checkpointStep(checkpoints.back());
  fs::create_directories(target / "checkpoints");
  fs::create_directories(target / "frames");
  for (const auto& file : checkpoints)
    share(file, target / "checkpoints" / file.filename());
  // Frames after the checkpoint are computed again; whoever looks at the branch meanwhile must not see them go.
  const auto segments = RunRecorder::segmentsAt(readCheckpoint(checkpoints.back()));
  for (const auto& file : segmentFiles(source / "frames"))
    if (!segments || segmentNumber(file) < static_cast<int>(*segments))
      share(file, target / "frames" / file.filename());
  for (const char* table : {"series.csv", "discharged.csv"})
    if (fs::exists(source / table)) fs::copy_file(source / table, target / table); // and cuts these
  writeAtomically(target / "scene.toml", writeScene(branch.scene));
  return branch;
}

} // namespace sandglass
