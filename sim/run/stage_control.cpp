#include "sim/run/stage_control.h"

#include "sim/base/error.h"
#include "sim/run/bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sandglass {

namespace {

constexpr double quietBeforeFlow = 10;

std::int64_t stepsIn(double duration, double stepSize) {
  return std::llround(duration / stepSize);
}

constexpr double mostSteps = 9007199254740992; // 2^53

} // namespace

void refuseEndlessStages(const Scene& scene, double stepSize) {
  for (const StageSpec& stage : scene.stages)
    for (const auto& [key, time] :
         {std::pair{"duration", stage.duration.value_or(0)}, std::pair{"settled_after", stage.settledAfter}})
      if (time > mostSteps * stepSize)
        throw InputError(
            fmt::format("stage.{}.until.{} is {:g} s, which are {:.2g} steps of {:.3g} s, but must "
                        "not be more than {:.2g}; shorten it or lengthen the step",
                        stage.name, key, time, time / stepSize, stepSize, mostSteps));
}

StageControl::StageControl(const Scene& scene, Solver& solver, Log log)
    : scene_(scene), solver_(solver), log_(std::move(log)), watchdog_(scene), recycling_(scene) {}

void StageControl::begin() {
  if (begun_ || done()) return;
  const StageSpec& stage = scene_.stages[stage_];
  for (const auto& wall : stage.removeWalls)
    solver_.removeWall(wall);
  for (const FieldFactor& f : stage.fields)
    solver_.setField(f.field, f.factor);
  drag_ = stage.drag.value_or(0);
  solver_.setDrag(drag_);
  solver_.beginStage(stage.name);
  solver_.advance(0); // forces without those walls: probes and frames of this step show them
  const double before = solver_.energies().total();
  const auto grains = placeGrains(scene_, stage.name, solver_.nextId(), solver_.present(), log_);
  if (!grains.empty()) {
    checkMovedWalls(grains);
    solver_.add(grains);
    solver_.advance(0);
    watchdog_.entered(grains, solver_.energies().total() - before);
  }
  rain_ = makeRain(scene_, stage.name);
  begun_ = true;
  start_ = solver_.step();
  starts_.push_back(solver_.time());
  massAtStart_ = solver_.flow().massDischarged;
  grainsAtStart_ = static_cast<std::int64_t>(solver_.freeGrains() + recycling_.waiting());
  recycledAtStart_ = solver_.flow().grainsRecycled;
  std::string walls;
  for (const auto& wall : stage.removeWalls)
    walls += (walls.empty() ? "; walls removed: " : ", ") + wall;
  report(log_, LogLevel::info,
         fmt::format("stage '{}' begins at {:.6g} s with {} grains ({} placed now){}{}", stage.name,
                     solver_.time(), solver_.grains(), grains.size(), rain_ ? "; it rains" : "", walls));
}

bool StageControl::applyEvents() {
  const std::uint64_t before = events_;
  for (; events_ < scene_.events.size() && scene_.events[events_].step <= solver_.step(); ++events_) {
    const EventSpec& event = scene_.events[events_];
    std::string what;
    for (const auto& wall : event.removeWalls) {
      solver_.removeWall(wall);
      what += fmt::format("; the wall '{}' is removed", wall);
    }
    for (const auto& wall : event.paceWalls) {
      solver_.setWallPace(wall, event.pace.value_or(1));
      what += fmt::format("; the wall '{}' moves at {:.6g} times its pace", wall, event.pace.value_or(1));
    }
    if (event.gravity) {
      solver_.setGravity(*event.gravity);
      watchdog_.gravityChanged(*event.gravity, solver_, solver_.energies());
      what += fmt::format("; gravity is ({:.6g}, {:.6g}, {:.6g}) m/s^2", event.gravity->x(),
                          event.gravity->y(), event.gravity->z());
    }
    if (event.drag) {
      drag_ = *event.drag;
      solver_.setDrag(drag_);
      what += fmt::format("; drag is {:.6g} 1/s", drag_);
    }
    for (const FieldFactor& f : event.fields) {
      solver_.setField(f.field, f.factor);
      what += fmt::format("; the field '{}' is {:.6g} times as strong as the scene says", f.field, f.factor);
    }
    if (event.endStage) {
      endNow_ = true;
      what += fmt::format("; the stage '{}' ends", name());
    }
    solver_.advance(0); // frames of this step show it
    report(log_, LogLevel::info,
           fmt::format("change at {:.6g} s, step {}{}", solver_.time(), solver_.step(), what));
  }
  return events_ != before;
}

void StageControl::checkMovedWalls(const std::vector<GrainSeed>& grains) const {
  for (const FrameWall& wall : solver_.walls()) {
    if (!wall.moving || !wall.active) continue;
    for (const GrainSeed& grain : grains) {
      WallShape::Touches touches;
      wall.shape->touches(grain.position, 0.5 * grain.radius, touches);
      if (touches.count > 0 || wall.shape->signedDistance(grain.position) < 0.0)
        throw InputError(
            fmt::format("at {:.6g} s the stage '{}' would place grain {} in or behind the wall '{}', which "
                        "has moved since the start; fill elsewhere, or before it moves, or let the grains "
                        "rain, which looks where walls are",
                        solver_.time(), scene_.stages[stage_].name, grain.id, wall.name));
    }
  }
}

std::int64_t StageControl::stageSteps() const {
  return solver_.step() - start_;
}

std::int64_t StageControl::nextLook() const {
  std::int64_t next = (stageSteps() / shortInterval + 1) * shortInterval;
  if (const auto& duration = scene_.stages[stage_].duration)
    next = std::min(next, std::max(stageSteps() + 1, stepsIn(*duration, solver_.stepSize())));
  if (endNow_) next = stageSteps() + 1;
  next += start_;
  if (events_ < scene_.events.size()) next = std::min(next, scene_.events[events_].step);
  return std::max(next, solver_.step() + 1);
}

void StageControl::left(const std::vector<LeftGrain>& grains) {
  for (const auto& grain : grains)
    recycling_.left(grain);
}

void StageControl::bringIn() {
  const auto enter = [&](const std::vector<GrainSeed>& grains) {
    if (grains.empty()) return;
    solver_.add(grains);
    watchdog_.entered(grains);
  };
  if (rain_ && !rain_->finished()) {
    const auto free = [&](const Vec3& position, double radius) { return solver_.isFree(position, radius); };
    const double time = static_cast<double>(stageSteps()) * solver_.stepSize();
    enter(rain_->due(time, solver_.nextId(), free));
  }
  enter(recycling_.due(solver_, scene_.stages[stage_].name));
  solver_.advance(0); // forces on those that came; probes and frames of this step show them
}

void StageControl::look() {
  const std::int64_t steps = stageSteps();
  if (steps > 0 && steps % shortInterval == 0) bringIn();
  const bool longLook = steps > 0 && steps % longInterval == 0;
  if (longLook) watchdog_.check(solver_, solver_.energies());
  if (!ended(longLook)) return;
  report(log_, LogLevel::info,
         fmt::format("stage '{}' ends at {:.6g} s after {} steps with {} grains", scene_.stages[stage_].name,
                     solver_.time(), steps, solver_.grains()));
  if (rain_)
    for (const auto& sentence : rain_->shortfall(static_cast<double>(steps) * solver_.stepSize()))
      report(log_, LogLevel::warning, fmt::format("stage '{}', {}", scene_.stages[stage_].name, sentence));
  ++stage_;
  begun_ = endNow_ = false;
  rain_.reset();
}

bool StageControl::ended(bool longLook) const {
  const StageSpec& stage = scene_.stages[stage_];
  const std::int64_t steps = stageSteps();
  const double dt = solver_.stepSize();
  if (endNow_ || (stage.duration && steps >= stepsIn(*stage.duration, dt))) return true;
  if (steps % shortInterval != 0) return false;
  const bool raining = rain_ && !rain_->finished();
  const bool coming = raining || recycling_.waiting() > 0;
  if (stage.untilEmpty && !coming && solver_.freeGrains() == 0) return true;
  const Flow& flow = solver_.flow();
  if (stage.massDischarged && flow.massDischarged - massAtStart_ >= *stage.massDischarged) return true;
  if (stage.quietTime) {
    // The first grains need time to reach the outlet: until one has left, quiet must last ten times as long.
    const double began = static_cast<double>(start_) * dt;
    const bool flowing = flow.lastDischarge > began;
    const double quiet = solver_.time() - (flowing ? flow.lastDischarge : began);
    if (quiet >= (flowing ? 1 : quietBeforeFlow) * *stage.quietTime) return true;
  }
  if (stage.recirculations && recirculated() >= *stage.recirculations) return true;
  return longLook && !coming && steps >= stepsIn(stage.settledAfter, dt) && atRest();
}

double StageControl::recirculated() const {
  const auto now = static_cast<std::int64_t>(solver_.freeGrains() + recycling_.waiting());
  const auto grains = std::max(grainsAtStart_, now); // those that rained in go round as well
  return grains > 0 ? static_cast<double>(solver_.flow().grainsRecycled - recycledAtStart_) /
                          static_cast<double>(grains)
                    : 0;
}

bool StageControl::atRest() const {
  const StageSpec& stage = scene_.stages[stage_];
  if (!stage.settledKineticEnergy && !stage.settledSpeed) return false;
  if (stage.settledSpeed && !(solver_.greatestSpeed() < *stage.settledSpeed)) return false;
  if (!stage.settledKineticEnergy) return true;
  const Energies energies = solver_.energies();
  const auto grains = static_cast<double>(std::max<std::size_t>(solver_.freeGrains(), 1));
  return (energies.translational + energies.rotational) / grains < *stage.settledKineticEnergy;
}

const std::string& StageControl::name() const {
  static const std::string none;
  const std::size_t current = begun_ ? stage_ + 1 : stage_; // number of stages that have begun
  return current == 0 ? none : scene_.stages[current - 1].name;
}

double StageControl::stageFraction() const {
  if (!begun_ || done()) return 0;
  const StageSpec& stage = scene_.stages[stage_];
  double fraction = 0;
  if (stage.duration) fraction = static_cast<double>(stageSteps()) * solver_.stepSize() / *stage.duration;
  if (stage.massDischarged)
    fraction = std::max(fraction, (solver_.flow().massDischarged - massAtStart_) / *stage.massDischarged);
  if (stage.untilEmpty && grainsAtStart_ > 0)
    fraction = std::max(fraction,
                        1 - static_cast<double>(solver_.freeGrains()) / static_cast<double>(grainsAtStart_));
  if (stage.recirculations) fraction = std::max(fraction, recirculated() / *stage.recirculations);
  return std::clamp(fraction, 0.0, 1.0);
}

double StageControl::fraction() const {
  // Stages weigh as long as they last, where that is known for all; else they weigh the same.
  double done = 0, all = 0;
  const bool known = std::all_of(scene_.stages.begin(), scene_.stages.end(),
                                 [](const StageSpec& s) { return s.duration.has_value(); });
  for (std::size_t i = 0; i < scene_.stages.size(); ++i) {
    const double weight = known ? *scene_.stages[i].duration : 1;
    all += weight;
    done += i < stage_ ? weight : i == stage_ ? weight * stageFraction() : 0;
  }
  return all > 0 ? done / all : 1;
}

std::vector<std::byte> StageControl::save() const {
  ByteWriter out;
  out << static_cast<std::uint64_t>(stage_) << begun_ << start_ << massAtStart_ << grainsAtStart_ << starts_
      << recycledAtStart_ << events_ << drag_ << endNow_ << recycling_.save()
      << (rain_ ? rain_->state() : std::vector<std::int64_t>{}) << watchdog_.save();
  return out.take();
}

void StageControl::load(const std::vector<std::byte>& bytes) {
  std::uint64_t stage = 0;
  std::vector<std::int64_t> rain;
  std::vector<std::byte> watchdog, recycling;
  ByteReader(bytes) >> stage >> begun_ >> start_ >> massAtStart_ >> grainsAtStart_ >> starts_ >>
      recycledAtStart_ >> events_ >> drag_ >> endNow_ >> recycling >> rain >> watchdog;
  stage_ = stage;
  watchdog_.load(watchdog);
  recycling_.load(recycling);
  rain_.reset();
  if (begun_ && !done()) solver_.setDrag(drag_);
  if (begun_ && !done()) rain_ = makeRain(scene_, scene_.stages[stage_].name);
  if (rain_) rain_->setState(rain);
}

} // namespace sandglass
