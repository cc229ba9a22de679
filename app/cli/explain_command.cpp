// sandglass explain: what a scene will model, what it costs, and how long a run may take. Runs nothing but a
// short trial.

#include "app/cli/commands.h"
#include "app/cli/scene_files.h"
#include "sim/base/error.h"
#include "sim/grains/seeding.h"
#include "sim/scene/scene.h"
#include "sim/scene/scene_reference.h"
#include "sim/solvers/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

namespace sandglass::cli {

namespace {

struct ExplainArguments {
  std::string scene;
  std::vector<std::string> overrides;
  bool quick = false, resolved = false, keys = false;
};

std::string wallTime(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string memory(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.1f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

void printParts(const Scene& scene) {
  fmt::print("{}\n", scene.title.empty() ? scene.file : scene.title);
  if (!scene.description.empty()) fmt::print("{}\n", scene.description);
  const Vec3 size = scene.domain.upper - scene.domain.lower;
  std::string periodic;
  for (std::size_t k = 0; k < 3; ++k)
    if (scene.domain.periodic[k]) periodic += fmt::format("{}{}", periodic.empty() ? "" : ", ", "xyz"[k]);
  fmt::print("\nScene {} (seed {})\n", sceneHash(scene), scene.seed);
  fmt::print("  domain     {:.4g} x {:.4g} x {:.4g} m, periodic along {}\n", size.x(), size.y(), size.z(),
             periodic.empty() ? "no axis" : periodic);
  if (scene.wedge)
    fmt::print("  wedge      one of {} equal sectors about {}\n", scene.wedge->sectors(), scene.wedge->axis);
  for (const auto& s : scene.species) {
    const SizeRange range = sizeRange(scene, s);
    fmt::print("  species    {}: {} of {}, {:.4g} to {:.4g} mm, mean mass {:.4g} mg\n", s.name, s.size.kind,
               s.material, 1e3 * range.smallest, 1e3 * range.largest, 1e6 * range.meanMass);
  }
  for (const auto& c : scene.contacts)
    fmt::print("  contact    {} on {}: {} normal, {} tangential, {} rolling, {} torsion\n", c.first, c.second,
               c.normal.kind, c.tangential.kind, c.rolling.kind, c.torsion.kind);
  for (const auto& w : scene.walls)
    fmt::print("  wall       {}: {} of {}{}\n", w.name, w.shape.kind, w.material,
               w.motion.kind.empty() ? "" : ", moves: " + w.motion.kind);
  for (const auto& f : scene.fields)
    fmt::print("  field      {}: {}\n", f.name, f.what.kind);
  for (const auto& o : scene.outlets)
    fmt::print("  outlet     {}\n", o.name);
  for (const auto& f : scene.fills)
    fmt::print("  filling    {} in stage '{}'\n", f.how.kind, f.stage);
  for (const auto& p : scene.probes)
    fmt::print("  probe      {}: {} every {:.4g} s\n", p.name, p.what.kind, p.interval);
}

std::string ending(const StageSpec& stage) {
  std::vector<std::string> ends;
  if (stage.duration) ends.push_back(fmt::format("{:.4g} s have passed", *stage.duration));
  if (stage.settledKineticEnergy)
    ends.push_back(fmt::format("a grain has {:.3g} J of kinetic energy on average (after {:.4g} s)",
                               *stage.settledKineticEnergy, stage.settledAfter));
  if (stage.settledSpeed) {
    const std::string rest = fmt::format("no grain is faster than {:.3g} m/s (after {:.4g} s)",
                                         *stage.settledSpeed, stage.settledAfter);
    if (stage.settledKineticEnergy)
      ends.back() += " and " + rest;
    else
      ends.push_back(rest);
  }
  if (stage.recirculations)
    ends.push_back(
        fmt::format("{:.4g} times as many grains as there were have been put back", *stage.recirculations));
  if (stage.untilEmpty) ends.push_back("no grain is left");
  if (stage.massDischarged) ends.push_back(fmt::format("{:.4g} kg have left", *stage.massDischarged));
  if (stage.quietTime) ends.push_back(fmt::format("no grain has left for {:.4g} s", *stage.quietTime));
  std::string all;
  for (const auto& e : ends)
    all += (all.empty() ? "" : ", or ") + e;
  return all;
}

/// Longest simulated time [s]; stages without a duration count as one second and are named in `open`.
double longestTime(const Scene& scene, std::vector<std::string>& open) {
  double total = 0;
  for (const auto& stage : scene.stages) {
    fmt::print("  {}: until {}\n", stage.name, ending(stage));
    if (!stage.duration) open.push_back(stage.name);
    total += stage.duration.value_or(1.0);
  }
  return total;
}

void printCost(const Scene& scene, const Forecast& f, double time, const std::vector<std::string>& open) {
  const double steps = time / f.step.step;
  const double oneThread = static_cast<double>(f.grains) * steps * f.secondsPerGrainStep;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  fmt::print("\nStep\n  {:.4g} s: {}\n", f.step.step, f.step.rule);
  fmt::print("\nCost\n  {} grains, {:.0f} bytes each: {}\n", f.grains, f.bytesPerGrain,
             memory(f.bytesPerGrain * static_cast<double>(f.grains)));
  fmt::print(
      "  {:.3g} us a grain and step on one thread, tried just now on a dense block of the first species\n",
      1e6 * f.secondsPerGrainStep);
  fmt::print("  about {} on {} threads for {:.4g} s in {:.3g} steps\n", wallTime(oneThread / cores), cores,
             time, steps);
  fmt::print(
      "  This assumes that every stage lasts its full duration, that all grains are there from start to end, "
      "and\n"
      "  that {} threads are {} times as fast as one; a bed that settles or empties sooner takes less.\n",
      cores, cores);
  for (const auto& name : open)
    fmt::print("  Stage '{}' has no duration: one second is assumed for it.\n", name);
}

int execute(const ExplainArguments& arguments) {
  if (arguments.keys) {
    fmt::print("{}", sceneReference());
    return 0;
  }
  if (arguments.scene.empty())
    throw InputError("name a scene to explain, or ask for the reference page with --keys");
  const auto files = locateScene(arguments.scene, arguments.quick, arguments.overrides);
  const Scene scene = readScene(files.scene, files.overrides);
  if (arguments.resolved) {
    fmt::print("{}", writeScene(scene));
    return 0;
  }
  if (auto refusals = solverRefusals(scene); !refusals.empty()) throw InputError(std::move(refusals));
  const Forecast f = forecast(scene);
  printParts(scene);
  fmt::print("\nStages\n");
  std::vector<std::string> open;
  const double time = longestTime(scene, open);
  fmt::print("\nModelled\n");
  for (const auto& line : f.modelled)
    fmt::print("  {}\n", line);
  if (!f.notModelled.empty()) {
    fmt::print("\nNot used by this scene: costs neither memory nor time\n");
    for (const auto& line : f.notModelled)
      fmt::print("  {}\n", line);
  }
  printCost(scene, f, time, open);
  return 0;
}

} // namespace

void addExplain(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ExplainArguments>();
  CLI::App* command =
      app.add_subcommand("explain", "Say what a scene models, why, and what a run of it costs");
  command->add_option("SCENE", arguments->scene, "scene file, or a folder with scene.toml");
  command
      ->add_option("--set", arguments->overrides, "key=value in place of the scene's, checked like the scene")
      ->allow_extra_args(false);
  command->add_flag("--quick", arguments->quick, "the small variant: also apply quick.set beside the scene");
  command->add_flag("--resolved", arguments->resolved,
                    "print the scene with every default and in SI units instead");
  command->add_flag("--keys", arguments->keys, "print the reference page of all keys of a scene instead");
  command->callback([arguments, &action] { action = [arguments] { return execute(*arguments); }; });
}

} // namespace sandglass::cli
