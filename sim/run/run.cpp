#include "sim/run/run.h"

#include "sim/base/error.h"
#include "sim/base/version.h"
#include "sim/math/sector.h"
#include "sim/run/run_recorder.h"
#include "sim/run/stage_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace sandglass {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double progressInterval = 0.1; ///< [s wall]
constexpr double longestGroup = 0.05;    ///< [s wall] of steps between two looks at stop() and pause()
constexpr const char* stageKey = "run/stage";

/// Keeps simulated time from running ahead of a ratio to wall time.
class Pace {
public:
  /// Whether the run is ahead at `time` [s] under this ratio; 0: never.
  bool mustWait(double ratio, double time) {
    if (ratio != ratio_ || ratio <= 0 || time < time_) restart(ratio, time);
    return ratio > 0 && (time - time_) / ratio > secondsSince(wall_);
  }
  void restart(double ratio, double time) {
    ratio_ = ratio;
    time_ = time;
    wall_ = Clock::now();
  }

private:
  double ratio_ = 0, time_ = 0;
  Clock::time_point wall_;
};

constexpr double shortGroup = 0.03; ///< [s wall] of steps at once when the speed is limited

} // namespace

struct Run::Impl {
  Scene scene;
  RunOptions options;
  Log log;
  std::unique_ptr<Solver> solver;
  std::unique_ptr<RunRecorder> recorder;
  std::unique_ptr<StageControl> stages;
  std::map<std::string, std::string> provenance;

  double computing = 0, grainSteps = 0;       ///< [s wall] in the solver, and what it did
  double startFraction = 0, checkpointed = 0; ///< the latter in `computing` seconds
  double groupSteps = 1;                      ///< steps that take about longestGroup
  Clock::time_point lastProgress, lastLive;
  double progressComputing = 0, progressGrainSteps = 0; ///< at the last progress report

  void setUp() {
    if (!options.solverFactory)
      if (const auto refusals = solverRefusals(scene); !refusals.empty()) throw InputError(refusals);
    const auto make = options.solverFactory ? options.solverFactory : SolverFactory(makeSolver);
    solver = make(scene, SolverOptions{options.threads, options.wallLoads});
    refuseEndlessStages(scene, solver->stepSize());
    recorder = std::make_unique<RunRecorder>(scene, options, solver->stepSize(), log);
    stages = std::make_unique<StageControl>(scene, *solver, recorder->log());
    provenance = {{"scene", sceneHash(scene)},
                  {"version", programVersion()},
                  {"seed", std::to_string(scene.seed)},
                  {"solver", scene.solver},
                  {"accuracy", scene.accuracy.level},
                  {"precision", scene.accuracy.mixedPrecision ? "mixed" : "double"},
                  {"arithmetic", scene.accuracy.fastArithmetic ? "fast" : "portable"},
                  {"step_size", fmt::format("{} s", solver->stepSize())}};
    if (!scene.title.empty()) provenance["title"] = scene.title;
    if (const auto state = recorder->restore()) {
      Solver::State solverState;
      for (const auto& [name, bytes] : *state)
        if (name.starts_with("solver/")) solverState[name.substr(7)] = bytes;
      solver->load(solverState);
      stages->load(state->at(stageKey));
    }
    recorder->open();
    startFraction = stages->fraction();
    lastProgress = lastLive = Clock::now();
  }

  /// The solver's frame with what only the run knows.
  FramePtr frame() const {
    auto copy = std::make_shared<Frame>(*solver->frame());
    copy->stage = stages->name();
    for (const auto& [key, value] : provenance)
      copy->provenance[key] = value;
    return copy;
  }

  void checkpoint() {
    recorder->checkpoint(*solver, {{stageKey, stages->save()}});
    checkpointed = computing;
  }

  void advance(std::int64_t steps) {
    const auto start = Clock::now();
    const double work = static_cast<double>(solver->grains()) * static_cast<double>(steps);
    solver->advance(steps);
    const double seconds = secondsSince(start);
    computing += seconds;
    grainSteps += work;
    const double fitting = static_cast<double>(steps) * longestGroup / std::max(seconds, 1e-9);
    groupSteps = std::clamp(fitting, 1.0, std::max(1.0, 2 * groupSteps));
  }

  void reportProgress(const std::function<void(const Progress&)>& onProgress, bool force) {
    if (!onProgress || (!force && secondsSince(lastProgress) < progressInterval)) return;
    lastProgress = Clock::now();
    Progress p;
    p.stage = stages->name();
    p.time = solver->time();
    p.step = solver->step();
    p.grains = solver->grains();
    p.fraction = stages->fraction();
    const double gained = p.fraction - startFraction;
    p.secondsLeft = gained > 1e-3 ? computing * (1 - p.fraction) / gained : -1;
    const double seconds = computing - progressComputing;
    p.grainStepsPerSecond = seconds > 0 ? (grainSteps - progressGrainSteps) / seconds : 0;
    progressComputing = computing;
    progressGrainSteps = grainSteps;
    onProgress(p);
  }
};

Run::Run(Scene scene, RunOptions options, Log log) : impl_(std::make_unique<Impl>()) {
  impl_->scene = std::move(scene);
  impl_->options = std::move(options);
  impl_->log = std::move(log);
}

Run::~Run() = default;

const Scene& Run::scene() const {
  return impl_->scene;
}

RunSummary Run::summary() const {
  RunSummary s;
  s.stages = impl_->scene.stages.size();
  if (!impl_->stages) return s;
  s.stagesDone = impl_->stages->index();
  s.stageStarts = impl_->stages->starts();
  s.frames = impl_->recorder->frameCount();
  s.time = impl_->solver->time();
  s.steps = impl_->solver->step();
  s.grains = impl_->solver->grains();
  s.flow = impl_->solver->flow();
  s.wallSeconds = impl_->computing;
  s.grainSteps = impl_->grainSteps;
  return s;
}

void Run::change(EventSpec event) {
  const auto& walls = impl_->scene.walls;
  for (const auto& name : event.removeWalls)
    if (std::none_of(walls.begin(), walls.end(), [&](const WallSpec& w) { return w.name == name; }))
      throw InputError(fmt::format("the scene has no wall '{}' to remove", name));
  for (const auto& name : event.paceWalls)
    if (std::none_of(walls.begin(), walls.end(),
                     [&](const WallSpec& w) { return w.name == name && !w.motion.kind.empty(); }))
      throw InputError(fmt::format("the scene has no wall '{}' with a motion whose pace could change", name));
  if (event.paceWalls.empty() == event.pace.has_value() || !(event.pace.value_or(0) >= 0) ||
      !(event.pace.value_or(0) <= 100))
    throw InputError("the pace of walls is a number from 0 to 100");
  for (const FieldFactor& f : event.fields)
    if (!std::isfinite(f.factor) || std::none_of(impl_->scene.fields.begin(), impl_->scene.fields.end(),
                                                 [&](const FieldSpec& s) { return s.name == f.field; }))
      throw InputError(fmt::format("the scene has no field '{}', or its strength is no number", f.field));
  if ((event.gravity && !event.gravity->allFinite()) || !std::isfinite(event.drag.value_or(0)) ||
      event.drag.value_or(0) < 0)
    throw InputError("gravity and drag are finite numbers, and drag is not negative");
  if (const Sector sector = impl_->scene.sector();
      event.gravity && !sector.whole() && sector.radius(*event.gravity) > 0.0)
    throw InputError("with a wedge gravity must point along its axis " + impl_->scene.wedge->axis);
  const std::lock_guard lock(changesMutex_);
  changes_.push_back(std::move(event));
}

bool Run::takeChanges() {
  std::vector<EventSpec> changes;
  {
    const std::lock_guard lock(changesMutex_);
    changes.swap(changes_);
  }
  if (changes.empty()) return false;
  auto& events = impl_->scene.events;
  const std::int64_t step = impl_->solver->step();
  for (auto& change : changes) {
    change.step = step;
    // Before those of the file that are still to come.
    events.insert(std::upper_bound(events.begin(), events.end(), step,
                                   [](std::int64_t s, const EventSpec& e) { return s < e.step; }),
                  change);
  }
  impl_->provenance["scene"] = sceneHash(impl_->scene);
  impl_->recorder->writeScene();
  for (const auto& change : changes)
    if (onChanged) onChanged(change);
  return true;
}

RunOutcome Run::execute() {
  Impl& run = *impl_;
  run.setUp();
  try {
    return loop();
  } catch (const RunError& error) {
    const std::string sentence = fmt::format("{}; {}", error.what(), run.recorder->lastCheckpoint());
    report(run.recorder->log(), LogLevel::error, sentence);
    throw RunError(sentence);
  } catch (const InputError& error) { // grains of a later stage that do not fit
    report(run.recorder->log(), LogLevel::error, error.what());
    throw;
  }
}

RunOutcome Run::loop() {
  Impl& run = *impl_;
  Solver& solver = *run.solver;
  RunRecorder& recorder = *run.recorder;
  StageControl& stages = *run.stages;
  double liveCost = 0; // [s] of the last live frame
  const auto live = [&](bool now) {
    // A frame of many grains takes a while to make: it may cost a thirtieth of the run.
    const double interval = std::max(run.options.liveInterval, 30 * liveCost);
    if (!onLiveFrame || run.options.liveInterval <= 0 || (!now && secondsSince(run.lastLive) < interval))
      return;
    const auto start = Clock::now();
    onLiveFrame(run.frame());
    run.lastLive = Clock::now();
    liveCost = secondsSince(start);
  };
  const auto save = [&] {
    if (!recorder.needsFrame(solver.step())) return;
    const FramePtr frame = run.frame();
    recorder.write(frame);
    if (onSavedFrame) onSavedFrame(frame);
  };

  // Before the frame of that step is offered, so that who sees it can let the run go on.
  const auto pauseIfDue = [&] {
    if (solver.step() != run.options.pauseAt) return;
    run.options.pauseAt = -1;
    paused_ = true;
  };

  const bool fresh = solver.step() == 0 && recorder.frameCount() == 0;
  stages.begin();
  if (fresh) {
    recorder.sample(solver, false, onSample);
    save();
    run.checkpoint();
  }
  pauseIfDue();
  live(true);
  bool shown = false; // the state in which the run was paused
  Pace pace;
  std::int64_t safeStep = solver.step();
  while (!stages.done()) {
    if (stop_) {
      if (safeStep != solver.step()) run.checkpoint();
      run.reportProgress(onProgress, true);
      return RunOutcome::stopped;
    }
    takeChanges();
    if (stages.applyEvents()) shown = false;
    std::int64_t allowed = std::max<std::int64_t>(1, static_cast<std::int64_t>(run.groupSteps));
    if (paused_) {
      pace.restart(0, 0);
      const int asked = single_.exchange(0);
      if (asked <= 0) {
        if (!shown) live(true);
        shown = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        continue;
      }
      allowed = std::min<std::int64_t>(allowed, asked);
      single_ += asked - static_cast<int>(allowed); // the rest in the next round
    }
    const double limit = speedLimit_;
    if (pace.mustWait(limit, solver.time())) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      continue;
    }
    if (limit > 0)
      allowed = std::min(allowed, 1 + static_cast<std::int64_t>(limit * shortGroup / solver.stepSize()));
    const std::int64_t step = solver.step();
    std::int64_t until = std::min(stages.nextLook(), recorder.nextDue(step));
    if (run.options.pauseAt > step) until = std::min(until, run.options.pauseAt);
    const std::int64_t steps = std::min(allowed, until - step);
    if (paused_ && steps < allowed) single_ += static_cast<int>(allowed - steps);
    run.advance(steps);
    shown = false;
    pauseIfDue();
    const auto left = solver.takeLeft();
    recorder.left(left, solver.stepSize());
    stages.left(left);

    stages.look();
    recorder.sample(solver, stages.done(), onSample);
    if (recorder.frameDue(solver.step()) || stages.done()) save();
    if (!stages.done()) stages.begin();
    const bool overdue = run.computing - run.checkpointed >= run.options.checkpointWallInterval;
    if (recorder.checkpointDue(solver.step()) || stages.done() || overdue) {
      run.checkpoint();
      safeStep = solver.step();
    }
    live(false);
    run.reportProgress(onProgress, stages.done());
  }
  live(true);
  report(recorder.log(), LogLevel::info,
         fmt::format("the run is complete: {:.6g} s in {} steps, {} frames", solver.time(), solver.step(),
                     recorder.frameCount()));
  return RunOutcome::finished;
}

} // namespace sandglass
