// What the soft-sphere solver shows of itself: frames, energies, walls, and its state for checkpoints.

#include "sim/base/error.h"
#include "sim/base/tiny_numbers.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>

namespace sandglass {

Vec3 DemSolver::wrapped(Vec3 x) const {
  const Domain& d = scene_.domain;
  for (int k = 0; k < 3; ++k)
    if (d.periodic[k]) {
      const double length = d.upper[k] - d.lower[k];
      x[k] -= length * std::floor((x[k] - d.lower[k]) / length);
      if (x[k] >= d.upper[k]) x[k] = d.lower[k];
    }
  return x;
}

FramePtr DemSolver::frame() const {
  auto frame = std::make_shared<Frame>();
  frame->time = time();
  frame->step = step_;
  frame->domain = scene_.domain;
  for (const Species& s : scene_.species)
    frame->speciesNames.push_back(s.name);
  const auto order = idOrder();
  const auto wants = [&](const char* name) {
    const auto& list = scene_.output.quantities;
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const auto scalars = [&](const char* name, auto&& value) {
    auto& out = frame->scalars[name];
    out.reserve(order.size());
    for (std::int32_t i : order)
      out.push_back(value(i));
  };
  const auto vectors = [&](const char* name, auto&& value) {
    auto& out = frame->vectors[name];
    out.reserve(order.size());
    for (std::int32_t i : order)
      out.push_back(value(i));
  };
  const FullStep& full = fullStep(wallLoads_ || wants(quantity::force));
  for (std::int32_t i : order) {
    frame->id.push_back(grains_.id[i]);
    frame->position.push_back(wrapped(grains_.place[i].vec()));
  }
  scalars(quantity::radius, [&](std::int32_t i) { return grains_.place[i].w; });
  if (scene_.species.size() > 1 || wants(quantity::species))
    scalars(quantity::species, [&](std::int32_t i) { return static_cast<double>(grains_.species[i]); });
  if (wants(quantity::mass)) scalars(quantity::mass, [&](std::int32_t i) { return massOf(i); });
  for (std::size_t q = 0; q < grains_.quantityNames.size(); ++q)
    scalars(grains_.quantityNames[q].c_str(), [&](std::int32_t i) { return grains_.quantities[q][i]; });
  if (wants(quantity::velocity))
    vectors(quantity::velocity, [&](std::int32_t i) { return full.velocity[i]; });
  if (wants(quantity::spin) && grains_.turning)
    vectors(quantity::spin, [&](std::int32_t i) { return full.spin[i]; });
  if (wants(quantity::force))
    vectors(quantity::force, [&](std::int32_t i) {
      if (heldFast(i)) return full.force[i].vec(); // nothing pulls it down
      return Vec3(full.force[i].vec() + grains_.mass(i) * gravity_);
    });
  if (wants(quantity::residenceTime))
    scalars(quantity::residenceTime,
            [&](std::int32_t i) { return time() - lives_.enteredAt(grains_.id[i]); });
  if (wants(quantity::life))
    scalars(quantity::life, [&](std::int32_t i) { return static_cast<double>(lives_.life(grains_.id[i])); });
  frame->walls = wallsNow(wallLoads_);
  if (!scene_.output.contacts || stale_) return frame;

  pairForces_.visitContacts(dt_, [&](std::int64_t p, const ContactBlock& b, int c) {
    FrameContact contact;
    const auto [i, j] = list_.pairs()[p];
    contact.a = grains_.id[i];
    contact.b = grains_.id[j];
    contact.image = list_.image(p);
    contact.normal = {b.nx[c], b.ny[c], b.nz[c]};
    contact.force = b.normalForce[c] * contact.normal + Vec3(b.ftx[c], b.fty[c], b.ftz[c]);
    contact.overlap = b.overlap[c];
    const double radius = grains_.place[i].w, sum = radius + grains_.place[j].w;
    contact.point = wrapped(grains_.place[i].vec() - radius * (sum - b.overlap[c]) / sum * contact.normal);
    frame->contacts.push_back(contact);
  });
  across_.visitContacts(grains_, dt_, [&](const SectorContacts::Contact& pair, const ContactBlock& b, int c) {
    FrameContact contact;
    contact.a = grains_.id[pair.a];
    contact.b = grains_.id[pair.b];
    contact.image = {pair.turn, 0, 0};
    contact.normal = {b.nx[c], b.ny[c], b.nz[c]};
    contact.force = b.normalForce[c] * contact.normal + Vec3(b.ftx[c], b.fty[c], b.ftz[c]);
    contact.overlap = b.overlap[c];
    const double sum = b.radiusA[c] + b.radiusB[c];
    contact.point = grains_.place[pair.a].vec() - b.radiusA[c] * (sum - b.overlap[c]) / sum * contact.normal;
    frame->contacts.push_back(contact);
  });
  std::sort(frame->contacts.begin(), frame->contacts.end(), [](const FrameContact& s, const FrameContact& t) {
    return std::tie(s.a, s.b, s.image) < std::tie(t.a, t.b, t.image);
  });
  wallContacts_.visitContacts(
      grains_, walls_,
      [&](std::int32_t i, std::int32_t wall, const ContactBlock& b, int c, const WallTouch& touch) {
        FrameContact contact;
        contact.a = grains_.id[i];
        contact.wall = wall;
        contact.normal = touch.normal;
        contact.overlap = b.overlap[c];
        contact.force = b.normalForce[c] * touch.normal + Vec3(b.ftx[c], b.fty[c], b.ftz[c]);
        contact.point = wrapped(grains_.place[i].vec() - touch.distance * touch.normal);
        frame->contacts.push_back(contact);
      });
  return frame;
}

Energies DemSolver::energies() const {
  Energies e;
  const Vec3 extent = scene_.domain.upper - scene_.domain.lower;
  const FullStep& full = fullStep(false);
  for (std::int32_t i : idOrder()) {
    if (heldFast(i)) continue; // nothing can change what it has
    const double m = grains_.mass(i);
    Vec3 x = grains_.place[i].vec();
    if (grains_.imaged)
      for (int k = 0; k < 3; ++k)
        x[k] += extent[k] * grains_.image[i][k]; // so falling through a periodic side is no jump
    e.translational += 0.5 * m * full.velocity[i].squaredNorm();
    e.gravitational -= m * gravity_.dot(x);
    if (grains_.turning) e.rotational += 0.5 * grains_.inertia(i) * full.spin[i].squaredNorm();
  }
  if (!stale_)
    e.elastic = pairForces_.storedEnergy(dt_) + across_.storedEnergy(grains_, dt_) +
                wallContacts_.storedEnergy(grains_, walls_);
  return e;
}

double DemSolver::massOf(std::int32_t i) const {
  if (!heldFast(i)) return grains_.mass(i);
  const double r = grains_.place[i].w;
  return 4.0 / 3.0 * std::numbers::pi * r * r * r *
         scene_.material(scene_.species[grains_.species[i]].material).density;
}

GrainSeed DemSolver::seedOf(std::int32_t i) const {
  GrainSeed s;
  s.id = grains_.id[i];
  s.species = grains_.species[i];
  s.radius = grains_.place[i].w;
  s.position = wrapped(grains_.place[i].vec());
  const FullStep& full = fullStep(false);
  s.velocity = full.velocity[i];
  if (grains_.turning) s.spin = full.spin[i];
  s.life = lives_.life(s.id);
  return s;
}

std::vector<GrainSeed> DemSolver::present() const {
  std::vector<GrainSeed> all;
  for (std::int32_t i : idOrder())
    all.push_back(seedOf(i));
  return all;
}

double DemSolver::greatestSpeed() const {
  double square = 0;
  for (std::size_t i = 0; i < grains_.size(); ++i)
    if (!heldFast(i)) square = std::max(square, grains_.motion[i].vec().squaredNorm());
  return std::sqrt(square);
}

std::vector<FrameWall> DemSolver::walls() const {
  return wallsNow(true);
}

std::vector<FrameWall> DemSolver::wallsNow(bool loads) const {
  if (loads) fullStep(true); // wall forces of this instant
  std::vector<FrameWall> all;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    if (loads && !stale_) wallContacts_.total(static_cast<int>(w), force, torque);
    SolverWall wall = walls_[w];
    wall.tally = loads ? atFullStep_.tallies[w] : WallTally{};
    all.push_back(frameWall(wall, force, torque));
  }
  return all;
}

double DemSolver::wallWork() const {
  const FullStep& full = fullStep(true);
  double sum = frozen_.any() ? frozen_.workWith(full.force, full.torque, step_ == 0 ? 0.0 : dt_) : 0.0;
  for (const WallTally& tally : full.tallies)
    sum += tally.work;
  return sum + fields_.work();
}

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
  get(s, "listed", grains_.listed);
  get(s, "id", grains_.id);
  get(s, "species", grains_.species);
  get(s, "material", grains_.material);
  get(s, "image", grains_.image);
  for (std::size_t q = 0; q < grains_.quantities.size(); ++q)
    get(s, "quantity." + grains_.quantityNames[q], grains_.quantities[q]);

  AlignedVector<Quad> records;
  get(s, "records", records);
  if (records.size() != (grains_.size() + 2) * grains_.quadsPerRecord())
    throw InputError(
        "the checkpoint's grain records do not fit the scene; it belongs to another scene or version");
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
  const auto misfit = [](const char* name) {
    throw InputError(fmt::format(
        "the checkpoint's '{}' does not fit the scene; it belongs to another scene or version", name));
  };
  const auto restore = [&](const char* name, auto& array) {
    const std::size_t expected = array.size();
    get(s, name, array);
    if (array.size() != expected) misfit(name);
  };
  std::vector<double> histories;
  get(s, "pairs.history", histories);
  if (!list_.setHistories(histories)) misfit("pairs.history");
  restore("pairs.live", list_.liveArray());
  if (across_.used()) restore("across.history", across_.historyArray());
  restore("groups.moved", loop_.travel().moved());
  get(s, "walls.history", histories);
  if (!wallContacts_.setHistories(histories)) misfit("walls.history");
  std::vector<std::int32_t> features;
  get(s, "walls.feature", features);
  if (!wallContacts_.setFeatures(features)) misfit("walls.feature");
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

} // namespace sandglass
