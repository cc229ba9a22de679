#include "app/cli/sweep_slurm.h"

#include "analysis/sweep/sweep_runner.h"
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

namespace sandglass::cli {

using namespace analysis;
namespace fs = std::filesystem;

namespace {

/// In single quotes for the shell.
std::string shellWord(const std::string& text) {
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// This very program, so that jobs run what wrote their scripts.
std::string programPath() {
  std::error_code fault;
  const auto path = fs::read_symlink("/proc/self/exe", fault);
  return fault ? "sandglass" : path.string();
}

std::size_t waitingRuns(const SweepTable& table) {
  const auto rows = table.rows();
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const SweepRow& row) { return row.status == SweepStatus::waiting; }));
}

} // namespace

std::pair<int, int> parseShare(const std::string& text) {
  int share = 0, shares = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, share);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, shares) : first;
  if (!slash || second.ec != std::errc() || second.ptr != end || shares < 1 || share < 0 || share >= shares)
    throw InputError(
        fmt::format("--share is '{}', but must read K/N with K from 0 to N - 1, such as 7/100", text));
  return {share, shares};
}

fs::path openShare(const fs::path& folder, int share, int shares) {
  const fs::path main = folder / SweepTable::fileName;
  if (!fs::exists(main)) throw InputError(fmt::format("{}: there is no table of a sweep", main.string()));
  const fs::path own = folder / sharesFolder / fmt::format("{}_of_{}", share, shares);
  fs::create_directories(own);
  const fs::path file = own / SweepTable::fileName;
  if (fs::exists(file)) {
    const SweepTable mine(file), all(main);
    // After a round of refinement there are more runs than the share knows of.
    if (mine.info("sweep") == all.info("sweep") && mine.info("scene") == all.info("scene") &&
        mine.rows().size() == all.rows().size())
      return file;
  }
  const fs::path part = temporaryName(file);
  fs::copy_file(main, part, fs::copy_options::overwrite_existing);
  publish(file);
  return file;
}

int writeSlurm(const fs::path& folder, int jobs) {
  const fs::path scripts = fs::absolute(folder).lexically_normal() / "slurm";
  fs::create_directories(scripts);
  const SweepTable table(folder);
  const auto waiting = waitingRuns(table);
  const std::string dir = fs::absolute(folder).lexically_normal().string(), program = programPath();
  const int array = static_cast<int>(std::clamp<std::size_t>(waiting, 1, static_cast<std::size_t>(jobs)));
  writeAtomically(
      scripts / "array.sh",
      fmt::format("#!/bin/bash\n"
                  "# One job of the array: a share of the runs, on one core. Submit it again after a\n"
                  "# kill or a time limit; runs that are over are not run again.\n"
                  "#SBATCH --job-name=sandglass\n"
                  "#SBATCH --array=0-{}\n"
                  "#SBATCH --ntasks=1\n"
                  "#SBATCH --cpus-per-task=1\n"
                  "#SBATCH --mem=1G\n"
                  "#SBATCH --time=24:00:00\n"
                  "#SBATCH --output={}/slurm/%a.log\n"
                  "exec {} sweep {} --share \"$SLURM_ARRAY_TASK_ID/{}\" --threads 1\n",
                  array - 1, dir, shellWord(program), shellWord(dir), array));
  writeAtomically(
      scripts / "submit.sh",
      fmt::format("#!/bin/bash\n"
                  "# The array, and when all of its jobs are over, however they ended, the gathering.\n"
                  "set -e\n"
                  "array=$(sbatch --parsable {0}/slurm/array.sh)\n"
                  "sbatch --dependency=afterany:\"${{array%%;*}}\" --job-name=sandglass-gather "
                  "--ntasks=1 --output={0}/slurm/gather.log {0}/slurm/gather.sh\n",
                  shellWord(dir)));
  writeAtomically(scripts / "gather.sh", fmt::format("#!/bin/bash\nexec {} sweep {} --gather\n",
                                                     shellWord(program), shellWord(dir)));
  for (const char* name : {"array.sh", "submit.sh", "gather.sh"})
    fs::permissions(scripts / name, fs::perms::owner_exec | fs::perms::group_exec, fs::perm_options::add);
  fmt::print("{} runs in {} jobs; submit them with {}\n", waiting, array, (scripts / "submit.sh").string());
  return 0;
}

int gatherShares(SweepTable& table, const fs::path& folder) {
  std::size_t taken = 0, shares = 0;
  std::vector<fs::path> files;
  if (fs::exists(folder / sharesFolder))
    for (const auto& entry : fs::directory_iterator(folder / sharesFolder))
      if (fs::exists(entry.path() / SweepTable::fileName))
        files.push_back(entry.path() / SweepTable::fileName);
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    taken += table.merge(SweepTable(file));
    ++shares;
  }
  fmt::print("{} runs from {} shares\n", taken, shares);
  if (const auto waiting = waitingRuns(table); waiting > 0) {
    fmt::print("{} runs are waiting; submit the array again\n", waiting);
    return 1;
  }
  if (!SweepRunner::refine(table)) return 0;
  fmt::print("refinement has added {} runs; write the scripts again (--slurm) and submit them\n",
             waitingRuns(table));
  return 1;
}

} // namespace sandglass::cli
