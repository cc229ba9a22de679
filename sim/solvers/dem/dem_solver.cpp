#include "sim/solvers/dem/dem_solver.h"

#include "sim/base/error.h"
#include "sim/base/tiny_numbers.h"
#include "sim/grains/seeding.h"
#include "sim/solvers/dem/mixed_checks.h"
#include "sim/solvers/dem/step_rule.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sandglass {

namespace {

/// Steps between two looks at the outlets: often enough for a smooth discharge curve (a millisecond or so),
/// rare enough to cost nothing.
constexpr int stepsBetweenOutletChecks = 50;
/// A list is made to last about this many steps of straight flight, beside the skin of a grain at rest.
constexpr double stepsOfFlight = 24;
constexpr std::int64_t grainsPerPiece = 1024;

int materialIndex(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.materials.size(); ++k)
    if (scene.materials[k].name == name) return static_cast<int>(k);
  throw InputError(fmt::format("there is no material '{}'", name));
}

LawStack stackWith(const Scene& scene, const std::vector<std::shared_ptr<const Law>>& added,
                   const FieldStack& fields) {
  LawStack stack(scene);
  for (const auto& law : added)
    stack.add(law);
  if (fields.readsOverlaps()) stack.sumOverlaps();
  return stack;
}

} // namespace

DemSolver::DemSolver(const Scene& scene, const SolverOptions& options,
                     const std::vector<std::shared_ptr<const Law>>& added)
    : scene_(scene), wallLoads_(options.wallLoads), fields_(scene), laws_(stackWith(scene, added, fields_)),
      parallel_(options.threads),
      list_(scene.domain, laws_.historySize(), laws_.outputStride(), laws_.hasEvents(), laws_.mixed()),
      pairForces_(laws_), wallContacts_(laws_), across_(laws_, scene.sector()), frozen_(scene),
      loop_(grains_, list_, pairForces_, wallContacts_, walls_, across_, fields_, parallel_),
      gravity_(scene.gravity), lives_(scene) {
  if (across_.used() && laws_.hasEvents())
    throw InputError("a wedge cannot be simulated with laws that move quantities from grain to grain across "
                     "a gap; simulate the whole circle");
  if (laws_.mixed()) checkMixedPrecision(scene, laws_);
  const StepChoice choice = chooseStep(scene, laws_);
  if (choice.step > choice.stableLimit)
    throw InputError(fmt::format(
        "the time step {:.3g} s is above the stable limit {:.3g} s ({}); lower time_step or raise "
        "steps_per_contact",
        choice.step, choice.stableLimit, choice.rule));
  dt_ = choice.step;
  double diameter = 0.0, finest = 1e300, smallest = 1e300;
  for (const Species& s : scene.species) {
    const SizeRange range = sizeRange(scene, s);
    diameter += range.meanDiameter / static_cast<double>(scene.species.size());
    finest = std::min(finest, range.meanDiameter);
    smallest = std::min(smallest, range.smallest);
  }
  meanDiameter_ = diameter;
  skin_ = scene.accuracy.skin * finest; // a skin as thick as fine grains would list each with dozens
  smallestRadius_ = 0.5 * smallest;
  grains_.keep(laws_.turning(), list_.periodic());
  pairForces_.watchOverlap(scene.accuracy.maximumOverlap, smallestRadius_);
  grains_.quantityNames = laws_.quantityNames();
  grains_.quantities.resize(grains_.quantityNames.size());
  walls_ = makeSolverWalls(scene);
  atFullStep_.tallies.resize(walls_.size());
  wallRadius_ = farthestReach(walls_, scene.domain) + meanDiameter_ + skin_;
  refuseFastWalls(fastestWall(scene));
}

void DemSolver::add(const std::vector<GrainSeed>& seeds) {
  if (seeds.empty()) return;
  changeAhead();
  const std::size_t before = grains_.size();
  grains_.resize(before + seeds.size());
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    const GrainSeed& s = seeds[k];
    const std::size_t i = before + k;
    const Species& species = scene_.species.at(s.species);
    const double mass = 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius *
                        scene_.material(species.material).density;
    grains_.place[i] = {s.position.x(), s.position.y(), s.position.z(), s.radius};
    grains_.motion[i] = {s.velocity.x(), s.velocity.y(), s.velocity.z(),
                         frozen_.holds(s.species) ? heldInverseMass : 1.0 / mass};
    if (grains_.turning)
      grains_.roll[i] = {s.radius * s.spin.x(), s.radius * s.spin.y(), s.radius * s.spin.z(), 1.0 / s.radius};
    grains_.id[i] = s.id;
    grains_.species[i] = static_cast<std::int16_t>(s.species);
    grains_.material[i] = static_cast<std::uint8_t>(materialIndex(scene_, species.material));
    for (std::size_t q = 0; q < s.quantities.size(); ++q)
      grains_.quantities.at(q)[i] = s.quantities[q];
    nextId_ = std::max(nextId_, s.id + 1);
    newcomers_.push_back(s.id);
    atFullStep_.velocity.push_back(s.velocity);
    if (grains_.turning) atFullStep_.spin.push_back(s.spin);
    atFullStep_.force.emplace_back();
    lives_.entered(s.id, s.life, time());
    (s.life > 0 ? flow_.massRecycled : flow_.massEntered) += mass;
    ++(s.life > 0 ? flow_.grainsRecycled : flow_.grainsEntered);
    smallestRadius_ = std::min(smallestRadius_, s.radius);
  }
  pairForces_.watchOverlap(scene_.accuracy.maximumOverlap, smallestRadius_);
  checkPromisedSizes();
}

void DemSolver::checkPromisedSizes() {
  for (std::size_t i = 0; i < grains_.size(); ++i)
    if (!laws_.asPromised(grains_.material[i], grains_.motion[i].w)) return laws_.allowAnySize(scene_);
}

void DemSolver::rebuild(const std::vector<std::uint8_t>& drop) {
  // Fast grains may go further before the list is too old: a stream that falls beside a bed at rest would
  // otherwise have the whole bed listed anew every few steps. The grains of a group share what they may move.
  const double look = stepsOfFlight * dt_, most = 0.25 * meanDiameter_;
  const auto allowance = [&](double speed) { return 0.5 * skin_ + std::min(look * speed, most); };
  if (across_.used()) across_.turnBack(grains_, list_, wallContacts_);
  list_.build(grains_, laws_.range(), parallel_, drop, allowance);
  if (across_.used()) across_.build(grains_, laws_.range(), list_);
  allowTravel(walls_, dt_, skin_, meanDiameter_, wallRadius_);
  wallContacts_.build(grains_, walls_, laws_.range(), parallel_);
  if (fields_.any()) fields_.list(grains_, list_, parallel_);
  loop_.bind();
  frozen_.capture(grains_);
  loop_.watch(frozen_.moving());
  atFullStep_.valid = false;
  ++rebuilds_;
}

const DemSolver::FullStep& DemSolver::fullStep(bool withForces) const {
  FullStep& full = atFullStep_;
  withForces = withForces || !scene_.accuracy.semiImplicit;
  if (full.valid && (full.forcesValid || !withForces)) return full;
  if (stale_) return full; // changeAhead() and add() keep it
  const std::size_t n = grains_.size();
  full.velocity.resize(n);
  full.spin.resize(grains_.turning ? n : 0);
  if (withForces) evaluate(full.force, full.torque);
  full.forcesValid = withForces;
  for (std::size_t i = 0; i < n; ++i) {
    if (scene_.accuracy.semiImplicit || heldFast(i)) { // as they are
      full.velocity[i] = grains_.motion[i].vec();
      if (grains_.turning) full.spin[i] = grains_.spin(i);
      continue;
    }
    const double kick = halfStep() * grains_.motion[i].w;
    full.velocity[i] = grains_.motion[i].vec() + kick * full.force[i].vec() + halfStep() * gravity_;
    if (grains_.turning)
      full.spin[i] = grains_.spin(i) + halfStep() / grains_.inertia(i) * full.torque[i].vec();
  }
  full.valid = true;
  return full;
}

void DemSolver::evaluate(std::vector<Quad>& force, std::vector<Quad>& torque) const {
  const TinyNumbersAsZero tiny;
  // What is evaluated here is evaluated once more by the next step: histories stay as they are.
  const auto across = across_.historyArray();
  DeepestOverlap deepest;
  placeWalls(walls_, time(), dt_);
  across_.step(grains_, dt_, parallel_, deepest);
  if (fields_.any()) fields_.look(grains_, list_, time(), parallel_);
  loop_.forces(dt_, gravity_, force, torque);
  across_.historyArray() = across;
  auto tallied = walls_;
  wallContacts_.tally(tallied, step_ == 0 ? 0.0 : dt_);
  atFullStep_.tallies.clear();
  for (const SolverWall& wall : tallied)
    atFullStep_.tallies.push_back(wall.tally);
  placeWalls(walls_, time(), 0.0); // as frames show them
}

void DemSolver::changeAhead() {
  if (stale_) return;
  fullStep(true); // still known now
  stale_ = true;
}

void DemSolver::prepare() {
  if (!stale_) return;
  const TinyNumbersAsZero tiny;
  rebuild();
  stale_ = false;
  std::sort(newcomers_.begin(), newcomers_.end());
  std::vector<std::int64_t> fresh;
  for (std::size_t i = 0; !newcomers_.empty() && i < grains_.size(); ++i)
    if (std::binary_search(newcomers_.begin(), newcomers_.end(), grains_.id[i]) && !heldFast(i))
      fresh.push_back(static_cast<std::int64_t>(i));
  newcomers_.clear();
  // Newcomers have velocities of the full step: half a step back. Forces depend on the velocities sought, so
  // once is not enough; each round gains the digits that damping times half a step leaves, one or two.
  std::vector<Quad> start, force, torque;
  for (const std::int64_t i : fresh) {
    start.push_back(grains_.motion[i]);
    if (grains_.turning) start.push_back(grains_.roll[i]);
  }
  for (int round = 0; round < 4 && !fresh.empty() && !scene_.accuracy.semiImplicit; ++round) {
    evaluate(force, torque);
    const Quad* from = start.data();
    for (const std::int64_t i : fresh) {
      const Quad v = *from++;
      const Vec3 before = v.vec() - halfStep() * (v.w * force[i].vec() + gravity_);
      grains_.motion[i] = {before.x(), before.y(), before.z(), v.w};
      if (!grains_.turning) continue;
      const Quad u = *from++;
      const Vec3 rolled = u.vec() - halfStep() * grains_.place[i].w / grains_.inertia(i) * torque[i].vec();
      grains_.roll[i] = {rolled.x(), rolled.y(), rolled.z(), u.w};
    }
  }
  atFullStep_.valid = false;
}

void DemSolver::advance(std::int64_t steps) {
  const TinyNumbersAsZero tiny;
  prepare();
  pairForces_.refresh();
  placeWalls(walls_, time(), dt_);
  for (std::int64_t k = 0; k < steps; ++k)
    stepOnce();
  placeWalls(walls_, time(), 0.0); // velocities of now, for frames
}

void DemSolver::damp() {
  const double factor = std::exp(-drag_ * dt_);
  const auto slow = [&](Quad& v) {
    v.x *= factor;
    v.y *= factor;
    v.z *= factor;
  };
  parallel_.forRange(static_cast<std::int64_t>(grains_.size()), grainsPerPiece,
                     [&](std::int64_t first, std::int64_t last) {
                       for (std::int64_t i = first; i < last; ++i) {
                         if (heldFast(i)) continue;
                         slow(grains_.motion[i]);
                         if (grains_.turning) slow(grains_.roll[i]);
                       }
                     });
}

bool DemSolver::listsLastOn() {
  const bool walls = std::any_of(walls_.begin(), walls_.end(), [](const SolverWall& w) { return w.active; });
  if (walls || across_.used() || fields_.any()) return false;
  return loop_.travel().measure(grains_, laws_.range(), scene_.domain.periodic, parallel_);
}

void DemSolver::stepOnce() {
  std::vector<PairEvent> events;
  DeepestOverlap deepest;
  across_.step(grains_, dt_, parallel_, deepest);
  if (fields_.any()) fields_.look(grains_, list_, time(), parallel_);
  const auto report =
      loop_.step(dt_, gravity_, scene_.accuracy.maximumTravel * smallestRadius_ / dt_, events, deepest);
  wallContacts_.tally(walls_, step_ == 0 ? 0.0 : dt_); // the work since the step before
  checkOverlap(deepest);
  if (report.bad) reportBadMotion();
  if (!events.empty()) applyEvents(events);
  if (drag_ > 0) {
    damp();
    pairForces_.refresh();
  }
  if (frozen_.any()) frozen_.tally(loop_, step_ == 0 ? 0.0 : dt_);
  ++step_;
  placeWalls(walls_, time(), dt_);
  atFullStep_.valid = false;
  const bool wallsLate = wallsTravelledTooFar(walls_, wallRadius_), late = report.late || wallsLate;
  if (late) checkEscapes();
  const bool fresh = step_ % stepsBetweenOutletChecks == 0 && discharge();
  if (late && !fresh && (wallsLate || !listsLastOn())) rebuild();
}

std::vector<std::int32_t> DemSolver::idOrder() const {
  std::vector<std::int32_t> order;
  if (grains_.size() == 0) return order;
  // Most often ids are nearly without gaps: each has a place of its own.
  const auto [least, greatest] = std::minmax_element(grains_.id.begin(), grains_.id.end());
  const auto range = static_cast<std::uint64_t>(*greatest - *least) + 1;
  if (range <= 4 * grains_.size()) {
    std::vector<std::int32_t> at(range, -1);
    for (std::size_t i = 0; i < grains_.size(); ++i)
      at[grains_.id[i] - *least] = static_cast<std::int32_t>(i);
    order.reserve(grains_.size());
    std::copy_if(at.begin(), at.end(), std::back_inserter(order), [](std::int32_t i) { return i >= 0; });
    return order;
  }
  order.resize(grains_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return grains_.id[a] < grains_.id[b]; });
  return order;
}

double DemSolver::bytesPerGrain() const {
  if (grains_.size() == 0) return static_cast<double>(grains_.bytesPerGrain());
  return static_cast<double>(grains_.bytesPerGrain()) +
         static_cast<double>(list_.bytes() + pairForces_.bytes()) / static_cast<double>(grains_.size());
}

} // namespace sandglass
