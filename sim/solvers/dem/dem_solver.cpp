#include "sim/solvers/dem/dem_solver.h"

#include "sim/base/error.h"
#include "sim/solvers/dem/step_rule.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>
#include <tuple>

namespace sandglass {

namespace {

/// Steps between two looks at the outlets: often enough for a smooth discharge curve (a millisecond or so),
/// rare enough to cost nothing.
constexpr int stepsBetweenOutletChecks = 50;
/// A list is made to last about this many steps of straight flight, beside the skin of a grain at rest.
constexpr double stepsOfFlight = 16;
constexpr std::int64_t grainsPerPiece = 1024;

/// Half a step of acceleration; `w` holds one over the mass or the moment of inertia.
void halfKick(Quad& velocity, const Quad& force, double half) {
  const double kick = half * velocity.w;
  velocity.x += kick * force.x;
  velocity.y += kick * force.y;
  velocity.z += kick * force.z;
}

int materialIndex(const Scene& scene, const std::string& name) {
  for (std::size_t k = 0; k < scene.materials.size(); ++k)
    if (scene.materials[k].name == name) return static_cast<int>(k);
  throw InputError(fmt::format("there is no material '{}'", name));
}

LawStack stackWith(const Scene& scene, const std::vector<std::shared_ptr<const Law>>& added) {
  LawStack stack(scene);
  for (const auto& law : added)
    stack.add(law);
  return stack;
}

} // namespace

DemSolver::DemSolver(const Scene& scene, const SolverOptions& options,
                     const std::vector<std::shared_ptr<const Law>>& added)
    : scene_(scene), laws_(stackWith(scene, added)), parallel_(options.threads),
      list_(scene.domain, laws_.historySize(), laws_.outputSize()), pairForces_(laws_), wallContacts_(laws_),
      lives_(scene) {
  const StepChoice choice = chooseStep(scene, laws_);
  if (choice.step > choice.stableLimit)
    throw InputError(fmt::format(
        "the time step {:.3g} s is above the stable limit {:.3g} s ({}); lower time_step or raise "
        "steps_per_contact",
        choice.step, choice.stableLimit, choice.rule));
  dt_ = choice.step;
  double diameter = 0.0, smallest = 1e300;
  for (const Species& s : scene.species) {
    const SizeRange range = sizeRange(scene, s);
    diameter += range.meanDiameter / static_cast<double>(scene.species.size());
    smallest = std::min(smallest, range.smallest);
  }
  meanDiameter_ = diameter;
  skin_ = scene.accuracy.skin * diameter;
  smallestRadius_ = 0.5 * smallest;
  grains_.turning = laws_.turning();
  grains_.imaged = list_.periodic();
  grains_.quantityNames = laws_.quantityNames();
  grains_.quantities.resize(grains_.quantityNames.size());
  walls_ = makeSolverWalls(scene);
  wallRadius_ = farthestReach(walls_, scene.domain) + meanDiameter_ + skin_;
  if (const double fastest = fastestWall(scene); fastest * dt_ > 0.25 * smallestRadius_)
    throw InputError(
        fmt::format("a wall moves at up to {:.3g} m/s, {:.3g} m in a step of {:.3g} s, more than a quarter "
                    "of the smallest "
                    "radius ({:.3g} m), and could jump over a grain; slow it down or lower time_step",
                    fastest, fastest * dt_, dt_, smallestRadius_));
}

void DemSolver::add(const std::vector<GrainSeed>& seeds) {
  const std::size_t before = grains_.size();
  grains_.resize(before + seeds.size());
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    const GrainSeed& s = seeds[k];
    const std::size_t i = before + k;
    const Species& species = scene_.species.at(s.species);
    const double mass = 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius *
                        scene_.material(species.material).density;
    grains_.place[i] = {s.position.x(), s.position.y(), s.position.z(), s.radius};
    grains_.motion[i] = {s.velocity.x(), s.velocity.y(), s.velocity.z(), 1.0 / mass};
    if (grains_.turning)
      grains_.spin[i] = {s.spin.x(), s.spin.y(), s.spin.z(), 2.5 / (mass * s.radius * s.radius)};
    grains_.id[i] = s.id;
    grains_.species[i] = static_cast<std::int16_t>(s.species);
    grains_.material[i] = static_cast<std::uint8_t>(materialIndex(scene_, species.material));
    for (std::size_t q = 0; q < s.quantities.size(); ++q)
      grains_.quantities.at(q)[i] = s.quantities[q];
    nextId_ = std::max(nextId_, s.id + 1);
    lives_.entered(s.id, s.life, time());
    (s.life > 0 ? flow_.massRecycled : flow_.massEntered) += mass;
    ++(s.life > 0 ? flow_.grainsRecycled : flow_.grainsEntered);
    smallestRadius_ = std::min(smallestRadius_, s.radius);
  }
  stale_ = stale_ || !seeds.empty();
  checkPromisedSizes();
}

void DemSolver::checkPromisedSizes() {
  for (std::size_t i = 0; i < grains_.size(); ++i)
    if (!laws_.asPromised(grains_.material[i], grains_.motion[i].w)) return laws_.allowAnySize(scene_);
}

void DemSolver::removeWall(const std::string& name) {
  for (SolverWall& w : walls_)
    if (w.name == name) {
      w.active = false;
      stale_ = true;
      return;
    }
  throw InputError(fmt::format("there is no wall '{}' to remove", name));
}

void DemSolver::beginStage(const std::string& name) {
  markStage(walls_, name, time());
  placeWalls(walls_, time(), 0.0);
}

void DemSolver::rebuild(const std::vector<std::uint8_t>& drop) {
  // A fast grain may go further before the list is too old: a stream that falls beside a bed at rest would
  // otherwise have the whole bed listed anew every few steps.
  const double look = stepsOfFlight * dt_, most = 0.25 * meanDiameter_;
  for (std::size_t i = 0; i < grains_.size(); ++i)
    grains_.listed[i].w = 0.5 * skin_ + std::min(look * grains_.motion[i].vec().norm(), most);
  list_.build(grains_, laws_.range(), parallel_, drop);
  allowTravel(walls_, dt_, skin_, meanDiameter_, wallRadius_);
  wallContacts_.build(grains_, walls_, laws_.range(), parallel_);
  ++rebuilds_;
}

void DemSolver::prepare() {
  if (!stale_) return;
  rebuild();
  forces(0.0); // histories stand still; new grains get their first force
  stale_ = false;
}

void DemSolver::advance(std::int64_t steps) {
  prepare();
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
                         slow(grains_.motion[i]);
                         if (grains_.turning) slow(grains_.spin[i]);
                       }
                     });
}

void DemSolver::stepOnce() {
  const bool old = drift();
  placeWalls(walls_, static_cast<double>(step_ + 1) * dt_, dt_);
  if (old || wallsTravelledTooFar(walls_, wallRadius_)) {
    checkEscapes();
    rebuild();
  }
  forces(dt_);
  kick();
  if (drag_ > 0) damp();
  ++step_;
  if (step_ % stepsBetweenOutletChecks == 0) discharge();
}

bool DemSolver::drift() {
  const double half = 0.5 * dt_;
  const double tooFast = 0.0625 * smallestRadius_ * smallestRadius_ / (dt_ * dt_); // a quarter radius a step
  std::atomic<bool> old{false}, bad{false};
  parallel_.forRange(static_cast<std::int64_t>(grains_.size()), grainsPerPiece,
                     [&](std::int64_t first, std::int64_t last) {
                       bool late = false, wrong = false;
                       for (std::int64_t i = first; i < last; ++i) {
                         Quad &x = grains_.place[i], &v = grains_.motion[i];
                         const Quad &f = grains_.force[i], &l = grains_.listed[i];
                         halfKick(v, f, half);
                         x.x += dt_ * v.x;
                         x.y += dt_ * v.y;
                         x.z += dt_ * v.z;
                         const double dx = x.x - l.x, dy = x.y - l.y, dz = x.z - l.z;
                         late = late || dx * dx + dy * dy + dz * dz > l.w * l.w;
                         wrong = wrong || !(v.x * v.x + v.y * v.y + v.z * v.z <= tooFast); // catches NaN too
                       }
                       if (grains_.turning)
                         for (std::int64_t i = first; i < last; ++i) {
                           Quad& w = grains_.spin[i];
                           const Quad& t = grains_.torque[i];
                           halfKick(w, t, half);
                         }
                       if (late) old = true;
                       if (wrong) bad = true;
                     });
  if (bad) reportBadMotion();
  return old;
}

void DemSolver::forces(double dt) {
  std::vector<PairEvent> events;
  DeepestOverlap deepest;
  pairForces_.step(grains_, list_, dt, parallel_, events, deepest);
  wallContacts_.step(grains_, walls_, dt, parallel_, deepest);
  wallContacts_.tally(grains_, walls_, dt);
  if (!events.empty()) applyEvents(events);
  const Vec3 g = scene_.gravity;
  parallel_.forRange(static_cast<std::int64_t>(grains_.size()), grainsPerPiece,
                     [&](std::int64_t first, std::int64_t last) {
                       for (std::int64_t i = first; i < last; ++i) {
                         const double m = 1.0 / grains_.motion[i].w;
                         grains_.force[i] = {m * g.x(), m * g.y(), m * g.z(), 0.0};
                         if (grains_.turning) grains_.torque[i] = {};
                       }
                       gatherPairForces(grains_, list_, laws_, first, last);
                       wallContacts_.gather(grains_, first, last);
                     });
  checkOverlap(deepest);
}

void DemSolver::kick() {
  const double half = 0.5 * dt_;
  parallel_.forRange(static_cast<std::int64_t>(grains_.size()), grainsPerPiece,
                     [&](std::int64_t first, std::int64_t last) {
                       for (std::int64_t i = first; i < last; ++i) {
                         Quad& v = grains_.motion[i];
                         const Quad& f = grains_.force[i];
                         halfKick(v, f, half);
                         if (!grains_.turning) continue;
                         Quad& w = grains_.spin[i];
                         const Quad& t = grains_.torque[i];
                         halfKick(w, t, half);
                       }
                     });
}

void DemSolver::applyEvents(std::vector<PairEvent>& events) {
  std::sort(events.begin(), events.end(), [](const PairEvent& s, const PairEvent& t) {
    return std::tie(s.idA, s.idB, s.imageKey, s.law) < std::tie(t.idA, t.idB, t.imageKey, t.law);
  });
  for (const PairEvent& e : events) {
    const auto& entry = laws_.entries()[e.law];
    const auto [i, j] = list_.pairs()[e.pair];
    EventGrains grains;
    for (int q : entry.quantities) {
      grains.a.push_back(&grains_.quantities[q][i]);
      grains.b.push_back(&grains_.quantities[q][j]);
    }
    entry.law->onEvent(e.event, list_.history(e.pair) + entry.firstHistory, grains);
  }
  for (const PairEvent& e : events)
    if (e.torn) std::fill_n(list_.history(e.pair), list_.historySize(), 0.0);
}

void DemSolver::discharge() {
  if (scene_.outlets.empty()) return;
  std::vector<std::uint8_t> drop;
  for (const OutletSpec& outlet : scene_.outlets) {
    const Vec3 n = outlet.normal.normalized();
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      if ((grains_.place[i].vec() - outlet.point).dot(n) <= 0.0) continue;
      if (drop.empty()) drop.assign(grains_.size(), 0);
      drop[i] = 1;
    }
  }
  if (drop.empty()) return;
  if (laws_.hasEvents()) { // conserved quantities of live pairs go back to their owners first
    std::vector<PairEvent> events;
    for (std::size_t p = 0; p < list_.size(); ++p) {
      const auto [i, j] = list_.pairs()[p];
      if (!list_.live()[p] || !(drop[i] || drop[j])) continue;
      for (std::size_t l = 0; l < laws_.entries().size(); ++l)
        if (laws_.entries()[l].role == LawRole::gap)
          events.push_back({grains_.id[i], grains_.id[j], list_.imageKey(p), static_cast<std::int32_t>(p),
                            static_cast<std::int16_t>(l), deathEvent, true});
    }
    applyEvents(events);
  }
  for (std::int32_t i : idOrder()) {
    if (!drop[i]) continue;
    ++flow_.grainsDischarged;
    flow_.massDischarged += grains_.mass(i);
    const Vec3 x = grains_.place[i].vec();
    const auto through = std::find_if(scene_.outlets.begin(), scene_.outlets.end(), [&](const OutletSpec& o) {
      return (x - o.point).dot(o.normal.normalized()) > 0.0; // the first that it is beyond
    });
    if (!through->recycle && !through->record) continue;
    GrainSeed seed = seedOf(i);
    for (const auto& values : grains_.quantities)
      seed.quantities.push_back(values[i]);
    left_.push_back({std::move(seed), static_cast<int>(through - scene_.outlets.begin()), time(),
                     time() - lives_.enteredAt(grains_.id[i])});
  }
  flow_.lastDischarge = time();
  rebuild(drop);
}

std::vector<double> DemSolver::quantity(const std::string& name) const {
  const auto& names = grains_.quantityNames;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw InputError(fmt::format("no law of this scene keeps a grain quantity '{}'", name));
  std::vector<double> values;
  for (std::int32_t i : idOrder())
    values.push_back(grains_.quantities[at - names.begin()][i]);
  return values;
}

void DemSolver::setQuantity(const std::string& name, const std::vector<double>& values) {
  const auto& names = grains_.quantityNames;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw InputError(fmt::format("no law of this scene keeps a grain quantity '{}'", name));
  if (values.size() != grains_.size())
    throw InputError(
        fmt::format("{} values of '{}' were given for {} grains", values.size(), name, grains_.size()));
  const auto order = idOrder();
  for (std::size_t k = 0; k < order.size(); ++k)
    grains_.quantities[at - names.begin()][order[k]] = values[k];
}

std::vector<std::int32_t> DemSolver::idOrder() const {
  std::vector<std::int32_t> order(grains_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return grains_.id[a] < grains_.id[b]; });
  return order;
}

double DemSolver::bytesPerGrain() const {
  if (grains_.size() == 0) return static_cast<double>(grains_.bytesPerGrain());
  return static_cast<double>(grains_.bytesPerGrain()) +
         static_cast<double>(list_.bytes()) / static_cast<double>(grains_.size());
}

} // namespace sandglass
