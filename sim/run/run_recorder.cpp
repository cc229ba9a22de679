#include "sim/run/run_recorder.h"

#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/segment_names.h"
#include "sim/run/bytes.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace sandglass {

namespace fs = std::filesystem;

namespace {

constexpr const char* stateKey = "run/recorder";

bool holdsRun(const fs::path& folder) {
  return fs::exists(folder / "scene.toml") || fs::exists(folder / "frames") ||
         fs::exists(folder / "checkpoints");
}

/// Deletes what a run writes, nothing else.
void removeRun(const fs::path& folder) {
  for (const char* name : {"frames", "checkpoints", "scene.toml", "series.csv", "discharged.csv", "log.txt"})
    fs::remove_all(folder / name);
}

} // namespace

double checkpointInterval(const Scene& scene, double stepSize) {
  if (scene.output.checkpointInterval > 0) return scene.output.checkpointInterval;
  constexpr double runsWithoutEnd = 20'000; // steps; spaced checkpoints are thinned out as a run grows longer
  double length = 0;
  for (const auto& stage : scene.stages) {
    if (!stage.duration) return runsWithoutEnd * stepSize;
    length += *stage.duration;
  }
  return length / 20;
}

RunRecorder::RunRecorder(const Scene& scene, const RunOptions& options, double stepSize, Log log)
    : scene_(scene), folder_(options.folder), log_(std::move(log)),
      frames_(scene.output.frameInterval, stepSize),
      checkpoints_(checkpointInterval(scene, stepSize), stepSize), resume_(options.resume) {
  for (const auto& spec : scene.probes)
    probes_.push_back({spec.name, Schedule(spec.interval, stepSize), makeProbe(spec, scene)});
  if (!writes()) return;
  prepareFolder(options);
  store_.emplace(folder_, checkpoints_);
  logFile_ = std::make_shared<std::ofstream>(folder_ / "log.txt", std::ios::app);
  log_ = [user = log_, file = logFile_](LogLevel level, const std::string& message) {
    const char* mark = level == LogLevel::info ? "" : level == LogLevel::warning ? "warning: " : "error: ";
    *file << fmt::format("{:%Y-%m-%d %H:%M:%S} {}{}", fmt::localtime(std::time(nullptr)), mark, message)
          << std::endl;
    report(user, level, message);
  };
}

void RunRecorder::prepareFolder(const RunOptions& options) {
  std::error_code fault;
  fs::create_directories(folder_, fault);
  if (fault)
    throw InputError(
        fmt::format("{}: the folder of the run cannot be made ({})", folder_.string(), fault.message()));
  lock_.emplace(folder_);
  const bool occupied = holdsRun(folder_);
  if (occupied && !options.resume && !options.overwrite)
    throw InputError(fmt::format("{}: this folder already holds a run; go on with it (--resume), replace it "
                                 "(--overwrite) or choose another folder (-o)",
                                 folder_.string()));
  if (occupied && options.resume) {
    const fs::path kept = folder_ / "scene.toml";
    if (fs::exists(kept) && sceneHash(readScene(kept.string())) != sceneHash(scene_))
      throw InputError(
          fmt::format("{}: the run in this folder was made from another scene, so it cannot be resumed; "
                      "undo the changes to the scene or choose another folder (-o)",
                      folder_.string()));
    if (!checkpointFiles(folder_).empty()) return;
  }
  if (occupied) removeRun(folder_); // to be replaced, or killed before its first checkpoint
  resume_ = false;
}

std::optional<Solver::State> RunRecorder::restore() {
  if (!writes() || !resume_) return std::nullopt;
  auto found = store_->newest(log_);
  if (!found) {
    report(log_, LogLevel::warning, "no checkpoint is whole; the run begins again");
    removeRun(folder_);
    fs::create_directories(folder_ / "checkpoints");
    return std::nullopt;
  }
  lastCheckpoint_ = found->file;
  load(found->state);
  for (const auto& file : segmentFiles(folder_ / "frames"))
    if (segmentNumber(file) >= static_cast<int>(segments_)) fs::remove(file);
  report(log_, LogLevel::info, fmt::format("going on from {}", found->file.string()));
  return std::move(found->state);
}

void RunRecorder::open() {
  if (!writes()) return;
  removeParts(folder_);
  removeParts(folder_ / "checkpoints");
  writeScene();
  std::vector<std::string> columns;
  for (const auto& entry : probes_)
    for (const auto& value : entry.probe->values())
      columns.push_back(entry.name + "." + value);
  series_.emplace(folder_ / "series.csv", columns, seriesBytes_);
  const auto& outlets = scene_.outlets;
  if (std::any_of(outlets.begin(), outlets.end(), [](const OutletSpec& o) { return o.record; }))
    discharged_.emplace(folder_ / "discharged.csv",
                        std::vector<std::string>{"id", "life", "outlet", "species", "diameter",
                                                 "residence_time", "x", "y", "z", "vx", "vy", "vz"},
                        dischargedBytes_);
  queue_.emplace(makeFrameWriter(folder_, scene_));
}

void RunRecorder::writeScene() const {
  if (writes()) writeAtomically(folder_ / "scene.toml", sandglass::writeScene(scene_));
}

std::int64_t RunRecorder::nextDue(std::int64_t step) const {
  std::int64_t next = std::min(frames_.next(step), checkpoints_.next(step));
  for (const auto& entry : probes_)
    next = std::min(next, entry.schedule.next(step));
  return next;
}

void RunRecorder::sample(const Solver& solver, bool last,
                         const std::function<void(const ProbeSample&)>& onSample) {
  const std::int64_t step = solver.step();
  std::map<std::string, double> row;
  for (auto& entry : probes_) {
    const bool due = entry.schedule.isDue(step);
    if (step == lastSample_ ? (due || !last) : !(due || last)) continue; // those due here were sampled before
    ProbeSample sample{entry.name, solver.time(), {}};
    const auto names = entry.probe->values();
    const auto values = entry.probe->sample(solver);
    for (std::size_t i = 0; i < names.size(); ++i) {
      sample.values[names[i]] = values[i];
      row[entry.name + "." + names[i]] = values[i];
    }
    if (onSample) onSample(sample);
  }
  lastSample_ = step;
  if (series_ && !row.empty()) series_->row(solver.time(), step, row);
}

void RunRecorder::left(const std::vector<LeftGrain>& grains, double stepSize) {
  if (!discharged_) return;
  for (const auto& [g, outlet, time, residence] : grains) {
    if (!scene_.outlets[outlet].record) continue;
    discharged_->row(time, std::llround(time / stepSize),
                     {{"id", static_cast<double>(g.id)},
                      {"life", g.life},
                      {"outlet", outlet},
                      {"species", g.species},
                      {"diameter", 2 * g.radius},
                      {"residence_time", residence},
                      {"x", g.position.x()},
                      {"y", g.position.y()},
                      {"z", g.position.z()},
                      {"vx", g.velocity.x()},
                      {"vy", g.velocity.y()},
                      {"vz", g.velocity.z()}});
  }
}

void RunRecorder::write(FramePtr frame) {
  lastFrame_ = frame->step;
  ++frameCount_;
  if (queue_) queue_->push(std::move(frame));
}

void RunRecorder::checkpoint(Solver& solver, Solver::State runState) {
  if (!writes()) return;
  queue_->closeSegment();
  const auto segments = segmentFiles(folder_ / "frames");
  segments_ = segments.empty() ? 0 : segmentNumber(segments.back()) + 1;
  seriesBytes_ = series_->sync();
  if (discharged_) dischargedBytes_ = discharged_->sync();
  ByteWriter out;
  out << lastFrame_ << lastSample_ << frameCount_ << segments_ << seriesBytes_ << dischargedBytes_;
  runState[stateKey] = out.take();
  for (const auto& entry : probes_)
    runState["probe/" + entry.name] = entry.probe->save();
  for (auto& [name, bytes] : solver.save())
    runState["solver/" + name] = std::move(bytes);
  lastCheckpoint_ = store_->write(solver.step(), runState);
}

std::optional<std::uint64_t> RunRecorder::segmentsAt(const Solver::State& state) {
  const auto it = state.find(stateKey);
  if (it == state.end()) return std::nullopt;
  std::int64_t frame, sample;
  std::uint64_t frames, segments;
  ByteReader(it->second) >> frame >> sample >> frames >> segments;
  return segments;
}

void RunRecorder::load(const Solver::State& state) {
  const auto entry = [&](const std::string& key) -> const std::vector<std::byte>& {
    const auto it = state.find(key);
    if (it == state.end())
      throw InputError(
          fmt::format("{}: the checkpoint lacks '{}': another version of the program wrote it; run from "
                      "the start",
                      lastCheckpoint_.string(), key));
    return it->second;
  };
  ByteReader(entry(stateKey)) >> lastFrame_ >> lastSample_ >> frameCount_ >> segments_ >> seriesBytes_ >>
      dischargedBytes_;
  for (auto& probe : probes_)
    probe.probe->load(entry("probe/" + probe.name));
}

std::string RunRecorder::lastCheckpoint() const {
  return lastCheckpoint_.empty() ? "there is no checkpoint"
                                 : fmt::format("the last good checkpoint is {}", lastCheckpoint_.string());
}

} // namespace sandglass
