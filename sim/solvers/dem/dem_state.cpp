// The state of the soft-sphere solver for checkpoints, and the way back.

#include "sim/base/error.h"
#include "sim/base/tiny_numbers.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace sandglass {

namespace {

template <class T, class Allocator>
void put(Solver::State& state, const std::string& name, const std::vector<T, Allocator>& values) {
  auto& bytes = state[name];
  bytes.resize(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
}

template <class T, class Allocator>
void get(const Solver::State& state, const std::string& name, std::vector<T, Allocator>& values) {
  const auto it = state.find(name);
  if (it == state.end() || it->second.size() % sizeof(T) != 0)
    throw InputError(fmt::format(
        "the checkpoint lacks '{}' or holds it in another size: it was written by another version", name));
  values.resize(it->second.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), it->second.data(), it->second.size());
}

[[noreturn]] void refuseMisfit(const char* name) {
  throw InputError(fmt::format(
      "the checkpoint's '{}' does not fit the scene; it belongs to another scene or version", name));
}

struct WallState {
  std::int64_t active;
  MotionMarks marks;
  double allowance, listedTime;
  WallTally tally;
};

struct Counters {
  std::int64_t step, nextId;
  Flow flow;
};

} // namespace

Solver::State DemSolver::save() {
  prepare(); // a list that is due now would be built before the next step anyway
  State s;
  put(s, "records", grains_.records());
  put(s, "listed", grains_.listed);
  put(s, "id", grains_.id);
  put(s, "species", grains_.species);
  put(s, "material", grains_.material);
  put(s, "image", grains_.image);
  for (std::size_t q = 0; q < grains_.quantities.size(); ++q)
    put(s, "quantity." + grains_.quantityNames[q], grains_.quantities[q]);
  put(s, "pairs.history", list_.histories());
  put(s, "pairs.live", list_.liveArray());
  if (across_.used()) put(s, "across.history", across_.historyArray());
  put(s, "groups.moved", loop_.travel().moved());
  put(s, "walls.history", wallContacts_.histories());
  put(s, "walls.feature", wallContacts_.features());
  std::vector<WallState> walls;
  for (const SolverWall& w : walls_)
    walls.push_back({w.active, w.marks, w.allowance, w.listedTime, w.tally});
  put(s, "walls.state", walls);
  if (frozen_.any()) put(s, "frozen", frozen_.state());
  if (fields_.any()) {
    put(s, "fields.factors", fields_.factors());
    put(s, "fields.work", fields_.workState());
  }
  put(s, "lives", lives_.lives());
  put(s, "entries", lives_.entries());
  put(s, "gravity", std::vector<double>{gravity_.x(), gravity_.y(), gravity_.z()});
  put(s, "counters", std::vector<Counters>{{step_, nextId_, flow_}});
  return s;
}

void DemSolver::load(const State& s) {
  const TinyNumbersAsZero tiny;
  loadWalls(s);
  loadGrains(s);
  loadHistories(s);
  frozen_.capture(grains_);
  loop_.watch(frozen_.moving());
  if (frozen_.any()) {
    std::vector<double> frozen;
    get(s, "frozen", frozen);
    frozen_.setState(frozen);
  }
  if (fields_.any()) {
    std::vector<double> factors, work;
    get(s, "fields.factors", factors);
    get(s, "fields.work", work);
    fields_.setFactors(factors);
    fields_.setWorkState(work);
  }
  get(s, "lives", lives_.lives());
  get(s, "entries", lives_.entries());
  std::vector<double> gravity;
  get(s, "gravity", gravity);
  gravity_ = {gravity.at(0), gravity.at(1), gravity.at(2)};
  std::vector<Counters> counters;
  get(s, "counters", counters);
  step_ = counters.at(0).step;
  nextId_ = counters.at(0).nextId;
  flow_ = counters.at(0).flow;
  stale_ = false;
  placeWalls(walls_, time(), 0.0);
  atFullStep_.valid = false;
  for (std::size_t i = 0; i < grains_.size(); ++i)
    smallestRadius_ = std::min(smallestRadius_, grains_.place[i].w);
  pairForces_.watchOverlap(scene_.accuracy.maximumOverlap, smallestRadius_);
}

void DemSolver::loadWalls(const State& s) {
  std::vector<WallState> walls;
  get(s, "walls.state", walls);
  if (walls.size() != walls_.size())
    throw InputError(fmt::format("the checkpoint has {} walls and the scene {}; it belongs to another scene",
                                 walls.size(), walls_.size()));
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    SolverWall& wall = walls_[w];
    wall.active = walls[w].active != 0;
    wall.marks = walls[w].marks;
    wall.allowance = walls[w].allowance;
    wall.listedTime = walls[w].listedTime;
    wall.tally = walls[w].tally;
    wall.pose = poseAt(wall, wall.listedTime); // until the list is made
  }
}

void DemSolver::loadGrains(const State& s) {
  get(s, "listed", grains_.listed);
  get(s, "id", grains_.id);
  get(s, "species", grains_.species);
  get(s, "material", grains_.material);
  get(s, "image", grains_.image);
  for (std::size_t q = 0; q < grains_.quantities.size(); ++q)
    get(s, "quantity." + grains_.quantityNames[q], grains_.quantities[q]);
  AlignedVector<Quad> records;
  get(s, "records", records);
  if (records.size() != (grains_.size() + 2) * grains_.quadsPerRecord()) refuseMisfit("grain records");
  grains_.setRecords(records);
  checkPromisedSizes();

  // The list as it was: built from the positions that it was built from. The sort is stable, so the storage
  // order stays, and histories fit their pairs again.
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    const Quad& l = grains_.listed[i];
    grains_.place[i] = {l.x, l.y, l.z, grains_.place[i].w};
  }
  list_.build(grains_, laws_.range(), parallel_);
  if (across_.used()) across_.build(grains_, laws_.range(), list_);
  wallContacts_.build(grains_, walls_, laws_.range(), parallel_);
  if (fields_.any()) fields_.list(grains_, list_, parallel_);
  grains_.setRecords(std::move(records));
  loop_.bind();
}

void DemSolver::loadHistories(const State& s) {
  const auto restore = [&](const char* name, auto& array) {
    const std::size_t expected = array.size();
    get(s, name, array);
    if (array.size() != expected) refuseMisfit(name);
  };
  std::vector<double> histories;
  get(s, "pairs.history", histories);
  if (!list_.setHistories(histories)) refuseMisfit("pairs.history");
  restore("pairs.live", list_.liveArray());
  if (across_.used()) restore("across.history", across_.historyArray());
  restore("groups.moved", loop_.travel().moved());
  get(s, "walls.history", histories);
  if (!wallContacts_.setHistories(histories)) refuseMisfit("walls.history");
  std::vector<std::int32_t> features;
  get(s, "walls.feature", features);
  if (!wallContacts_.setFeatures(features)) refuseMisfit("walls.feature");
}

} // namespace sandglass
