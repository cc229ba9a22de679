// sandglass run: a scene from start to end, or on from a checkpoint.

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/replicate_runs.h"
#include "app/cli/scene_files.h"
#include "app/cli/stop_signals.h"
#include "sim/run/run.h"

#include <fmt/format.h>

#include <memory>

namespace sandglass::cli {

namespace {

struct RunArguments {
  std::string scene, folder;
  std::vector<std::string> overrides;
  int threads = 0, replicates = 0;
  bool resume = false, overwrite = false, quick = false;
};

std::string largeNumber(double value) {
  if (value >= 1e9) return fmt::format("{:.2f} billion", value / 1e9);
  if (value >= 1e6) return fmt::format("{:.2f} million", value / 1e6);
  return fmt::format("{:.0f}", value);
}

void printSummary(const RunSummary& s, const std::string& folder) {
  fmt::print("{} of {} stages, {:.6g} s in {} steps, {} frames in {}\n", s.stagesDone, s.stages, s.time,
             s.steps, s.frames, folder);
  fmt::print("{} grains at the end; {} entered, {} left ({:.6g} kg discharged)\n", s.grains,
             s.flow.grainsEntered, s.flow.grainsDischarged, s.flow.massDischarged);
  if (s.flow.grainsRecycled > 0)
    fmt::print("{} were put back ({:.6g} kg)\n", s.flow.grainsRecycled, s.flow.massRecycled);
  if (s.wallSeconds > 0)
    fmt::print("{:.1f} s of computing, {} grain-steps a second\n", s.wallSeconds,
               largeNumber(s.grainSteps / s.wallSeconds));
}

int execute(const RunArguments& arguments) {
  const auto files = locateScene(arguments.scene, arguments.quick, arguments.overrides);
  RunOptions options;
  options.folder = arguments.folder.empty() ? files.defaultFolder : std::filesystem::path(arguments.folder);
  if (arguments.replicates > 0)
    return runReplicates(readScene(files.scene, files.overrides),
                         {arguments.replicates, options.folder, arguments.threads, arguments.overwrite});
  options.threads = arguments.threads;
  options.resume = arguments.resume;
  options.overwrite = arguments.overwrite;
  Run run(readScene(files.scene, files.overrides), options, consoleLog());
  ProgressBar bar("running");
  run.onProgress = [&](const Progress& p) {
    bar.update(p.fraction, p.secondsLeft,
               fmt::format("{} {:.4g} s, {} grains, {} grain-steps/s", p.stage, p.time, p.grains,
                           largeNumber(p.grainStepsPerSecond)));
  };
  const StopSignals signals(&run);
  const RunOutcome outcome = run.execute();
  bar.finish();
  printSummary(run.summary(), options.folder.string());
  if (outcome == RunOutcome::finished) return 0;
  fmt::print("stopped; go on with: sandglass run {} -o {} --resume\n", arguments.scene,
             options.folder.string());
  return 1;
}

} // namespace

void addRun(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "Run a scene: frames, series and checkpoints go into a folder");
  command->add_option("SCENE", arguments->scene, "scene file, or a folder with scene.toml")->required();
  command->add_option("-o,--output", arguments->folder, "folder of the run (out/<name of the scene>)");
  command
      ->add_option("--threads", arguments->threads, "threads, 0 for all cores; the results are the same bits")
      ->check(CLI::Range(0, 4096));
  command
      ->add_option("--set", arguments->overrides, "key=value in place of the scene's, checked like the scene")
      ->allow_extra_args(false);
  CLI::Option* resume = command->add_flag("--resume", arguments->resume, "go on from the newest checkpoint");
  command->add_flag("--overwrite", arguments->overwrite, "replace the run in the folder")->excludes(resume);
  command
      ->add_option("--replicates", arguments->replicates,
                   "the same scene over this many seeds, several runs at once, with means and intervals; run "
                   "again, it goes on")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  command->add_flag("--quick", arguments->quick, "the small variant: also apply quick.set beside the scene");
  command->callback([arguments, &action] { action = [arguments] { return execute(*arguments); }; });
}

} // namespace sandglass::cli
