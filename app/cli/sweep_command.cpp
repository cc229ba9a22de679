// sandglass sweep: its options.

#include "app/cli/commands.h"
#include "app/cli/sweep_work.h"

#include <memory>

namespace sandglass::cli {

void addSweep(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<SweepArguments>();
  SweepArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "sweep", "one scene over a grid, samples or replicates of any of its keys; run again, it goes on");
  command->add_option("SWEEP", a.source, "SWEEP.toml, its folder, or the folder of a sweep that is there")
      ->required();
  command->add_option("-o,--output", a.folder,
                      "folder of the sweep (out/<name>); the run of --recompute; the picture of --plot");
  command->add_option("--threads", a.threads, "runs at once, each on one core; 0 for all cores")
      ->check(CLI::Range(0, 4096));
  command->add_flag("--overwrite", a.overwrite, "replace what the folder holds");
  command->add_flag("--dry-run", a.dryRun, "read every scene and say how many runs there are");
  command->add_flag("--table", a.table, "write sweep.csv from the table and run nothing");
  command
      ->add_option("--recompute", a.recompute, "run this point again with its frames, into -o: the same bits")
      ->check(CLI::PositiveNumber)
      ->type_name("POINT");
  command->add_option("--replicate", a.replicate, "which seed of the point, from 1")
      ->check(CLI::PositiveNumber);
  command->add_option("--slurm", a.slurm, "write scripts for a job array of at most N jobs")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  command
      ->add_option("--share", a.share,
                   "run this share of the runs into a table of its own: a job of the array")
      ->type_name("K/N");
  command->add_flag("--gather", a.gather, "take the rows of all shares over");
#ifdef SANDGLASS_VIS
  command
      ->add_option(
          "--plot", a.plot,
          "phase diagram and its CSV into -o FILE.png: x=COLUMN y=COLUMN colour=COLUMN, line=COLUMN, "
          "where=COLUMN:VALUE, classes=N, pictures=yes")
      ->type_name("KEY=VALUE");
#endif
  command->callback([arguments, &action] { action = [arguments] { return sweep(*arguments); }; });
}

} // namespace sandglass::cli
