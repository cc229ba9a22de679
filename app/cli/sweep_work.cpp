#include "app/cli/sweep_work.h"

#include "analysis/sweep/sweep_blobs.h"
#include "analysis/sweep/sweep_design.h"
#include "analysis/sweep/sweep_runner.h"
#include "app/cli/console.h"
#include "app/cli/stop_signals.h"
#include "app/cli/sweep_slurm.h"
#ifdef SANDGLASS_VIS
#include "app/cli/sweep_plot.h"
#endif
#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/run/folder_lock.h"
#include "sim/run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace sandglass::cli {

using namespace analysis;

namespace {

namespace fs = std::filesystem;

bool holdsTable(const fs::path& folder) {
  return fs::exists(folder / SweepTable::fileName);
}

/// Throws InputError when no scene reads: a key that is wrong is wrong for all. Points that are wrong beside
/// others become failed runs.
void requireSomeScene(const SweepPlan& plan) {
  constexpr std::size_t asked = 100;
  const auto points = firstPoints(plan);
  std::optional<InputError> first;
  for (std::size_t k = 0; k < std::min(points.size(), asked); ++k)
    try {
      sceneOf(plan, points[k], plan.seeds.front());
      return;
    } catch (const InputError& e) {
      if (!first) first = e;
    }
  if (!first) return;
  std::vector<std::string> sentences;
  for (const auto& sentence : first->sentences())
    sentences.push_back(fmt::format("{}: no scene of this sweep reads: {}", plan.file, sentence));
  throw InputError(sentences);
}

/// The folder of the sweep; makes its table when it has none yet.
fs::path prepare(const SweepArguments& a) {
  if (a.folder.empty() && holdsTable(a.source)) return a.source; // goes on
  const SweepPlan plan = readSweep(a.source);
  requireSomeScene(plan);
  const fs::path file = fs::absolute(plan.file).lexically_normal();
  const fs::path name = file.filename() == "SWEEP.toml" ? file.parent_path().filename() : file.stem();
  const fs::path folder = a.folder.empty() ? fs::path("out") / name : fs::path(a.folder);
  fs::create_directories(folder);
  const FolderLock lock(folder);
  const fs::path table = folder / SweepTable::fileName;
  if (holdsTable(folder) && !a.overwrite) {
    const SweepTable there(folder);
    if (there.info("sweep") != plan.text || there.info("scene") != plan.sceneText)
      throw InputError(fmt::format("{}: this folder holds another sweep than {} and its scene; replace it "
                                   "(--overwrite), choose another folder (-o), or go on with what is there "
                                   "(sandglass sweep {})",
                                   folder.string(), plan.file, folder.string()));
    return folder;
  }
  fs::remove(table);
  fs::remove(fs::path(table) += "-journal");
  fs::remove_all(folder / sharesFolder);
  SweepTable::create(table, plan);
  return folder;
}

void writeCsv(const fs::path& folder, const SweepTable& table) {
  writeAtomically(folder / "sweep.csv", table.csv());
}

void printCounts(const SweepTable& table, const fs::path& folder) {
  std::size_t done = 0, failed = 0, points = 0;
  double seconds = 0;
  const auto rows = table.rows();
  for (const auto& row : rows) {
    done += row.status == SweepStatus::done;
    failed += row.status == SweepStatus::failed;
    seconds += table.seconds(row.run);
    points = std::max(points, static_cast<std::size_t>(row.point));
  }
  fmt::print("{} points, {} runs: {} done, {} failed, {} waiting; {:.1f} s of computing; table in {}\n",
             points, rows.size(), done, failed, rows.size() - done - failed, seconds,
             (folder / SweepTable::fileName).string());
}

/// Works the table off. Returns the exit code.
int work(SweepTable& table, const fs::path& folder, const SweepArguments& a, int share, int shares) {
  SweepRunnerOptions options;
  options.threads = a.threads;
  options.share = share;
  options.shares = shares;
  options.log = consoleLog();
  ProgressBar bar(fmt::format("{} runs", table.rows().size()));
  SweepRunner* running = nullptr;
  options.onProgress = [&](const SweepProgress& p) {
    if (StopSignals::asked()) running->stop();
    bar.update(p.fraction, p.secondsLeft,
               fmt::format("{} of {} done, {} failed, {} going on", p.done, p.runs, p.failed, p.going));
  };
  SweepRunner runner(table, options);
  running = &runner;
  const StopSignals signals;
  const bool finished = runner.execute();
  bar.finish();
  printCounts(table, folder);
  if (finished) return 0;
  fmt::print("stopped; go on with: sandglass sweep {}\n", folder.string());
  return 1;
}

int dryRun(const SweepArguments& a) {
  const SweepPlan plan = readSweep(a.source);
  const auto points = firstPoints(plan);
  fmt::print("{} points with {} seed{} each: {} runs{}\n", points.size(), plan.seeds.size(),
             plan.seeds.size() == 1 ? "" : "s", points.size() * plan.seeds.size(),
             plan.refineLevels > 0 ? fmt::format(", and {} rounds of refinement", plan.refineLevels) : "");
  std::vector<std::string> wrong;
  for (const auto& point : points)
    try {
      sceneOf(plan, point, plan.seeds.front());
    } catch (const InputError& e) {
      for (const auto& sentence : e.sentences())
        wrong.push_back(fmt::format("point {}: {}", point.id, sentence));
      if (wrong.size() > 20) break;
    }
  if (!wrong.empty()) throw InputError(wrong);
  fmt::print("every scene reads\n");
  return 0;
}

int recompute(const SweepArguments& a) {
  if (a.folder.empty()) throw InputError("--recompute needs -o, the folder for the run");
  const SweepTable table(a.source);
  const auto rows = table.rows();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const SweepRow& r) {
    return r.point == a.recompute && r.replicate == a.replicate;
  });
  if (row == rows.end())
    throw InputError(
        fmt::format("{}: there is no point {} with a seed number {}; there are {} points with {} seeds",
                    a.source, a.recompute, a.replicate, table.points().size(), table.plan().seeds.size()));
  RunOptions options;
  options.folder = a.folder;
  options.threads = a.threads;
  options.overwrite = a.overwrite;
  Run run(table.scene(row->run), options, consoleLog());
  ProgressBar bar(fmt::format("point {}", a.recompute));
  run.onProgress = [&](const Progress& p) {
    bar.update(p.fraction, p.secondsLeft, fmt::format("{} {:.4g} s", p.stage, p.time));
  };
  FramePtr last;
  run.onSavedFrame = [&](const FramePtr& frame) { last = frame; };
  const StopSignals signals(&run);
  if (run.execute() != RunOutcome::finished) return 1;
  bar.finish();
  const FramePtr kept = table.lastFrame(row->run);
  if (!kept) {
    fmt::print("point {} in {}; the sweep has nothing of it to compare with\n", a.recompute, a.folder);
    return 0;
  }
  if (!last->has(quantity::velocity)) { // the scene does not write it
    auto copy = std::make_shared<Frame>(*last);
    copy->vectors[quantity::velocity] = kept->vector(quantity::velocity);
    last = copy;
  }
  if (last->step != kept->step || frameBytes(*last) != frameBytes(*kept)) {
    fmt::print(
        stderr,
        "sandglass: point {}: its last frame has not the bits that the sweep kept: another version of the "
        "program ({}) made the table\n",
        a.recompute, table.info("version"));
    return 1;
  }
  fmt::print("point {} in {}: its last frame has the bits that the sweep kept\n", a.recompute, a.folder);
  return 0;
}

} // namespace

int sweep(const SweepArguments& a) {
  if (a.dryRun) return dryRun(a);
  if (a.recompute > 0) return recompute(a);
#ifdef SANDGLASS_VIS
  if (!a.plot.empty()) return plotSweep(a);
#endif
  if (!a.share.empty()) {
    const auto [share, shares] = parseShare(a.share);
    const fs::path file = openShare(a.source, share, shares);
    const FolderLock lock(file.parent_path());
    SweepTable table(file, SweepTable::Access::write);
    return work(table, a.source, a, share, shares);
  }
  const fs::path folder = prepare(a);
  if (a.slurm > 0) return writeSlurm(folder, a.slurm);
  const FolderLock lock(folder);
  SweepTable table(folder, SweepTable::Access::write);
  int code = 0;
  if (a.gather)
    code = gatherShares(table, folder);
  else if (!a.table)
    code = work(table, folder, a, 0, 1);
  else
    printCounts(table, folder);
  writeCsv(folder, table);
  return code;
}

} // namespace sandglass::cli
